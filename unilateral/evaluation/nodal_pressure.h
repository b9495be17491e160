// The contact pressure as a function of V_h.
#pragma once

#include "unilateral/algebra/vector.h"
#include "unilateral/discretisation/problem.h"

namespace unilateral
{
  /// The contact pressure lives at the points of I_G; its average sum_i w_i |B_ij| lambda_i / sum_i w_i |B_ij| over the points that a
  /// shape function sees lives in V_h, whatever the rule; vertices of P2, which no midpoint sees, get the mean of those around. For a
  /// vector-valued V_h: the average of lambda n, whose value at a point times n there is the pressure.
  template <int dim>
  Vector
  nodal_pressure(const Problem<dim> &problem, const ConstraintSet<dim> &constraint_set, const ConstraintBlock &block, const Vector &lambda);
} // namespace unilateral
