// Where data have values of which the points that a cell looks at show nothing.
#pragma once

#include "unilateral/algebra/vector.h"
#include "unilateral/discretisation/problem.h"
#include "unilateral/evaluation/run_result.h"

#include <vector>

namespace unilateral
{
  /// Stiffness, reaction, Young's modulus, Poisson's ratio and load that are expressions, and the bounds and gaps that are, are searched
  /// cell by cell, on boundary parts face by face: where interval arithmetic cannot show that all values on a part of a cell lie near those
  /// at the points of its rules, the function is evaluated there, and the part halved, down to a 250th of the cell (in space a 32nd), in
  /// 400 steps at most. One entry for each cell in which a value was found that is off by more than 5 % of the largest one (of loads: five
  /// times it) (of bounds: of the largest u) and half of the range seen, and, of bounds, on the side of u. Where the search ends before, as
  /// in cells that a function oscillates or jumps in, nothing is said. Problems of second order on straight cells; obstacles that are
  /// surfaces, velocities and what else acts on the boundary are not searched. @p u with its prescribed values. Collective. Reference: R.
  /// E. Moore, R. B. Kearfott, M. J. Cloud, Introduction to Interval Analysis, SIAM 2009.
  template <int dim>
  std::vector<UnseenDetail> unseen_details(const Problem<dim> &problem, const Vector &u);
} // namespace unilateral
