// `run` of a case with steps.
#pragma once

#include "cli/console.h"
#include "cli/options.h"

#include "unilateral/case/case.h"

namespace unilateral
{
  /// Solves the steps one after the other and writes the results: a folder for each step as soon as it is solved, in the end those of the
  /// whole. A step that does not converge is the last one. Returns the exit code, which is that of the worst step. When it is interrupted
  /// the steps that were solved are there. Throws what the solution of a step throws, but for Interrupted.
  template <int dim>
  int run_history(const Options &options, const Case &request, Console &console);
} // namespace unilateral
