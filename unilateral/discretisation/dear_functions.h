// Functions of which each call is dear, as those of an interpreted language, are computed at many points at once.
#pragma once

#include "unilateral/discretisation/problem.h"

namespace unilateral
{
  /// Where the statement has functions that are dear to call (FieldFunction::dear_to_call()), their values on the current mesh:
  /// coefficients at the points of the rules of a, f and the energy norm, bounds at the points of I_G and the nodes. Without such functions
  /// nothing.
  template <int dim>
  void prepare_dear_functions(const Problem<dim> &problem);
} // namespace unilateral
