// Data that are known at samples only.
#pragma once

#include "unilateral/discretisation/problem_statement.h"

#include <string>

namespace unilateral
{
  /// What of the coefficients and the boundary data is known at samples (a raster, a profile, the solution of another run, or an expression
  /// that uses one): no rule integrates it with a known error, so that nothing is guaranteed. Empty: nothing. Bounds are not looked at.
  std::string data_known_at_samples(const ProblemStatement &statement);
} // namespace unilateral
