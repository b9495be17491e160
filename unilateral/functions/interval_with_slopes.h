// Values and slopes of a function on a box.
#pragma once

#include "unilateral/functions/interval.h"

#include <array>

namespace unilateral
{
  /// The values of a function on a box, and slopes s with f(b) - f(a) = s.(b - a) for points a, b of the box, each in its interval: they
  /// contain the derivatives of a function that is Lipschitz continuous, at corners those of all sides (Clarke's), and everything where it
  /// may jump or has no value somewhere.
  struct IntervalWithSlopes
  {
    Interval                value;
    std::array<Interval, 3> slopes{};
  };
} // namespace unilateral
