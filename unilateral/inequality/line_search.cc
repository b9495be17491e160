#include "unilateral/inequality/line_search.h"

#include <cmath>
#include <limits>
#include <utility>
#include <vector>

namespace unilateral
{
  double exact_line_search(
    const double slope, const double curvature, const Vector &c, const Vector &g, const Vector &b, const Processes &processes)
  {
    // Up to t = 2 the derivative is that at t = 0 but for the few points that change sides on the way: one pass over all finds them.
    struct Crossing
    {
      double c, g, b;
    };
    constexpr double      known_up_to = 2;
    std::vector<Crossing> crossings;
    double                at_0[2] = {0, 0};
    const std::size_t     n = c.locally_owned_size();
    const double *const __restrict c_of = c.begin(), *const __restrict g_of = g.begin(), *const __restrict b_of = b.begin();
    for (std::size_t i = 0; i < n; ++i)
    {
      const double gap = g_of[i], change = b_of[i];
      if (gap > 0)
      {
        at_0[0] += c_of[i] * gap * change;
        at_0[1] += c_of[i] * change * change;
      }
      if ((gap > 0) != (gap + known_up_to * change > 0))
        crossings.push_back({c_of[i], gap, change});
    }
    processes.sum(at_0, 2);
    // The derivative of the energy at t and its own.
    const auto derivative = [&](const double t)
    {
      double sums[2] = {0, 0};
      if (t <= known_up_to)
      {
        for (const auto &point : crossings)
        {
          const double gap = point.g + t * point.b;
          if ((gap > 0) == (point.g > 0))
            continue;
          const double sign = gap > 0 ? 1 : -1;
          sums[0] += sign * point.c * gap * point.b;
          sums[1] += sign * point.c * point.b * point.b;
        }
        processes.sum(sums, 2);
        return std::pair(slope + at_0[0] + t * (curvature + at_0[1]) + sums[0], curvature + at_0[1] + sums[1]);
      }
      for (std::size_t i = 0; i < n; ++i)
        if (const double gap = g_of[i] + t * b_of[i]; gap > 0)
        {
          sums[0] += c_of[i] * gap * b_of[i];
          sums[1] += c_of[i] * b_of[i] * b_of[i];
        }
      processes.sum(sums, 2);
      return std::pair(slope + t * curvature + sums[0], curvature + sums[1]);
    };
    // Newton's method on a convex-by-pieces linear function, kept inside a bracket: it ends on the right piece after a few steps.
    const double start = std::abs(slope + at_0[0]);
    double       lower = 0, upper = std::numeric_limits<double>::infinity(), t = 1;
    for (unsigned step = 0; step < 100; ++step)
    {
      const auto [value, second] = derivative(t);
      if (std::abs(value) <= 1e-8 * start)
        break;
      (value < 0 ? lower : upper) = t;
      double next = second > 0 ? t - value / second : 2 * t;
      if (!(next > lower && next < upper))
        next = std::isfinite(upper) ? 0.5 * (lower + upper) : 2 * t;
      if (std::abs(next - t) <= 1e-15 * t)
        break;
      t = next;
    }
    return t;
  }
} // namespace unilateral
