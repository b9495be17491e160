// The normal of a triangle in space.
#pragma once

#include <array>
#include <cmath>

namespace unilateral
{
  /// Of length 1, or 0 for a triangle without area; it points to where the corners @p x are seen to turn counterclockwise.
  inline std::array<double, 3> unit_normal(const std::array<std::array<double, 3>, 3> &x)
  {
    std::array<double, 3> a{}, b{};
    for (unsigned d = 0; d < 3; ++d)
    {
      a[d] = x[1][d] - x[0][d];
      b[d] = x[2][d] - x[0][d];
    }
    std::array<double, 3> n = {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
    const double          size = std::hypot(n[0], n[1], n[2]);
    for (double &component : n)
      component /= size > 0 ? size : 1;
    return n;
  }
} // namespace unilateral
