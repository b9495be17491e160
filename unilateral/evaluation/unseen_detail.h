// Where data have values of which the points that a cell looks at show nothing.
#pragma once

#include "unilateral/algebra/vector.h"
#include "unilateral/discretisation/problem.h"
#include "unilateral/evaluation/run_result.h"

#include <vector>

namespace unilateral
{
  /// Stiffness, reaction, load and bounds that are expressions, and what acts on the boundary, are searched cell by cell: where interval
  /// arithmetic cannot show that all values on a part of a cell lie near those at the points of its rules, the function is evaluated there,
  /// and the part halved, down to a 250th of the cell (in space a 32nd), in some hundred steps a cell. One entry for each cell in which a
  /// value was found that is off by more than 5 % of the largest one (of bounds: of the largest u) and half of the range seen, and, of
  /// bounds, on the side of u. Where the search ends before, in cells that a function oscillates or jumps in, nothing is said. @p u with
  /// its prescribed values. Reference: R. E. Moore, R. B. Kearfott, M. J. Cloud, Introduction to Interval Analysis, SIAM 2009.
  template <int dim>
  std::vector<UnseenDetail> unseen_details(const Problem<dim> &problem, const Vector &u);
} // namespace unilateral
