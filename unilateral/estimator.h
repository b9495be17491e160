// An indicator of the discretisation error, to measure other errors against.
#pragma once

#include "unilateral/discrete_problem.h"
#include "unilateral/problem.h"

namespace unilateral
{
  /// eta = ( int k (G - grad u).(G - grad u) )^1/2, G the gradient averaged at the nodes of V_h with the cells' volumes as weights: an
  /// estimate of ||u - u_h||_a, asymptotically right for smooth solutions, not a bound. G is averaged within each region, so that jumps
  /// of the stiffness do not count. Units of the energy norm. u may lack its Dirichlet values: they are set.
  /// Reference: O. C. Zienkiewicz, J. Z. Zhu, Int. J. Numer. Meth. Engng 24 (1987) 337-357.
  template <int dim>
  double discretisation_indicator(const Problem<dim> &problem, const Vector &u);
} // namespace unilateral
