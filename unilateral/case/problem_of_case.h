// Case -> ProblemStatement: the one place where the texts of functions become functions.
#pragma once

#include "unilateral/case/case.h"

namespace unilateral
{
  /// The problem that the case states, its functions compiled and its files of data read.
  /// Adds everything that is wrong with them to @p diagnostics; the functions concerned are zero then.
  ProblemStatement problem_of(const Case &request, Diagnostics &diagnostics);

  /// The same of a case whose functions have been checked. Throws InputError.
  ProblemStatement problem_of(const Case &request);
} // namespace unilateral
