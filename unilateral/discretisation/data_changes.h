// Which data of a problem differ from those of another on the same mesh.
#pragma once

#include "unilateral/discretisation/problem_statement.h"

namespace unilateral
{
  /// The form a, and with it the matrix A, is certainly the same in both: all that differs are loads, bounds, prescribed values and the
  /// method. Functions count as the same where one is a copy of the other (FieldFunction::same_as()). False for forms of a program's own,
  /// which cannot be compared.
  bool same_form(const ProblemStatement &a, const ProblemStatement &b);
} // namespace unilateral
