// Slopes of expressions on sets of numbers.
#pragma once

#include "unilateral/functions/interval_with_slopes.h"

#include <functional>
#include <string>

namespace unilateral
{
  using SlopeFunction = std::function<IntervalWithSlopes(const IntervalWithSlopes *a, unsigned n)>;

  /// What the function or comparison called @p name makes of its arguments, n of them; empty: not known.
  SlopeFunction find_slope_function(const std::string &name);

  IntervalWithSlopes operator-(const IntervalWithSlopes &a);
  IntervalWithSlopes operator+(const IntervalWithSlopes &a, const IntervalWithSlopes &b);
  IntervalWithSlopes operator-(const IntervalWithSlopes &a, const IntervalWithSlopes &b);
  IntervalWithSlopes operator*(const IntervalWithSlopes &a, const IntervalWithSlopes &b);
  IntervalWithSlopes operator/(const IntervalWithSlopes &a, const IntervalWithSlopes &b);

  /// a^n.
  IntervalWithSlopes power(const IntervalWithSlopes &a, int n);
} // namespace unilateral
