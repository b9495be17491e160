// Case -> ProblemStatement: the one place where the texts of functions become functions.
#pragma once

#include "unilateral/case/case.h"
#include "unilateral/case/solution_fields.h"

namespace unilateral
{
  /// The problem that the case states, its functions compiled and its files of data read.
  /// Adds everything that is wrong with them to @p diagnostics; the functions concerned are zero then.
  ProblemStatement problem_of(const Case &request, Diagnostics &diagnostics);

  /// The same for a step of a load history; @p fields has what comes from other solutions and what the step before has compiled, and takes
  /// what this one compiles.
  ProblemStatement problem_of(const Case &request, Diagnostics &diagnostics, StepFields &fields);

  /// The same of a case whose functions have been checked; of a case with steps the first one. Throws InputError.
  ProblemStatement problem_of(const Case &request);
} // namespace unilateral
