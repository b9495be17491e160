// What a number of a run must be.
#pragma once

#include "unilateral/base/diagnostics.h"

#include <optional>
#include <string>

namespace unilateral
{
  /// An acceptance criterion; passes when |value - expected| <= atol + rtol |expected|, and min/max hold.
  struct Expectation
  {
    std::string           quantity; ///< path into results.json, e.g. constraint.0.total_contact_force
    std::optional<double> value;
    double                rtol = 0, atol = 0;
    std::optional<double> min, max;
    SourceLocation        where;
  };

  struct ExpectationResult
  {
    Expectation asked;
    double      value = 0; ///< NaN when the quantity does not exist or is not a number
    bool        passed = false;
    std::string problem; ///< why there is no value to compare; empty when there is one
  };
} // namespace unilateral
