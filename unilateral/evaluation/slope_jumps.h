// What jumps of the slope tell of the error of C0 interior penalty methods.
#pragma once

#include "unilateral/algebra/vector.h"
#include "unilateral/discretisation/problem.h"

#include <vector>

namespace unilateral
{
  /// Adds to @p cell_squares, by active cell, half of
  ///     int_F {1/h} D [du/dn]^2
  /// of each face F between two cells, of which the other has the other half: what u_h is not in H^2. Zero for other forms than those with
  /// terms on such faces. Returns the root of the sum. @p u with its prescribed values. Reference: S. C. Brenner, J. Gedicke, L.-Y. Sung,
  /// Y. Zhang, SIAM J. Numer. Anal. 55 (2017) 87-108.
  template <int dim>
  double add_slope_jumps(const Problem<dim> &problem, const Vector &u, std::vector<double> &cell_squares);
} // namespace unilateral
