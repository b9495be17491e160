// What the functions of expressions make of sets of numbers.
#pragma once

#include "unilateral/functions/interval.h"

#include <string>

namespace unilateral
{
  /// Contains every value of a function for arguments in @p a, n of them; empty where it has none. Which of the arguments have no value
  /// somewhere counts with the result, see ExpressionCode::range().
  using IntervalFunction = Interval (*)(const Interval *a, unsigned n);

  /// That of the function or comparison called @p name; nullptr: not known.
  IntervalFunction find_interval_function(const std::string &name);

  /// a^n.
  Interval power(const Interval &a, int n);
} // namespace unilateral
