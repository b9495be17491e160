// What stiff springs on the boundary make of the error on cells that do not resolve the layers beside them.
#pragma once

#include "unilateral/algebra/vector.h"
#include "unilateral/discretisation/problem.h"

#include <vector>

namespace unilateral
{
  /// Adds to @p cell_squares, by active cell, (1 - 1/rho) int r^2/s over its faces on the boundary, for each component with springs of a
  /// stiffness s where rho = s h/k exceeds 1, k that of the material; r = load - s u_h - flux of u_h is what the boundary condition is
  /// short of. There a layer of width k/s lies within a cell, and the gradient of u_h, which is what the recovered flux looks at, shows
  /// nothing of it. Springs that are so stiff that they hold u_h leave r^2/s small. Parts with contact are left out. Returns the root of
  /// the sum over all processes. Membranes and elastic bodies; @p u with its prescribed values. Collective. Reference: M. Juntunen, R.
  /// Stenberg, Math. Comp. 78 (2009) 1353-1374: residuals of Robin conditions with the factor h/(k + s h).
  template <int dim>
  double add_unresolved_springs(const Problem<dim> &problem, const Vector &u, std::vector<double> &cell_squares);
} // namespace unilateral
