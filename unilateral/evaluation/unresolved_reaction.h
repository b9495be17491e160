// What a strong reaction makes of the error of a membrane on cells that do not resolve its layers.
#pragma once

#include "unilateral/algebra/vector.h"
#include "unilateral/discretisation/problem.h"

#include <vector>

namespace unilateral
{
  /// Adds to @p cell_squares, by active cell, (1 - 1/rho) int r^2/c where rho = c h^2/k exceeds 1, c the reaction, k the largest stiffness,
  /// r = f - c u_h - b . grad u_h + div(k grad u_h) + contact pressure, k as if it were constant. There a layer of width (k/c)^1/2 lies
  /// within a cell, and the gradient of u_h, which is what the recovered flux looks at, shows nothing of it; where c outweighs the rest
  /// r/c is u - u_h. Returns the root of the sum over all processes; 0 for other forms. @p u with its prescribed values. Collective.
  /// Reference: R. Verfuerth, Numer. Math. 78 (1998) 479-493: residuals with the factor min(h k^-1/2, c^-1/2).
  template <int dim>
  double add_unresolved_reaction(const Problem<dim>       &problem,
                                 const ConstraintSet<dim> &constraint_set,
                                 const Vector             &u,
                                 const Vector             &lambda,
                                 std::vector<double>      &cell_squares);
} // namespace unilateral
