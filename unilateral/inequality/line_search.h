// The least energy along a direction.
#pragma once

#include "unilateral/inequality/discrete_problem.h"

namespace unilateral
{
  /// The zero t > 0 of the increasing, piecewise linear  slope + t curvature + sum_i c_i (g_i + t b_i)^+ b_i,
  /// the derivative of the energy along a descent direction. Exact up to round-off. The sum runs over the points of all @p processes, those
  /// that others count having c = 0.
  double
  exact_line_search(double slope, double curvature, const Vector &c, const Vector &g, const Vector &b, const Processes &processes = {});
} // namespace unilateral
