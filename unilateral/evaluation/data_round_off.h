// How well a constraint is known where coordinates are large.
#pragma once

#include "unilateral/constraints/constraint_set.h"
#include "unilateral/discretisation/problem.h"
#include "unilateral/inequality/discrete_problem.h"

namespace unilateral
{
  /// The complementarity that rounding of the coordinates leaves, in the norm that the method of multipliers stops on:
  ///     ( sum_i w_i delta_i^2 / tau_i )^1/2,   delta_i = |s(x_i + eta) - s(x_i - eta)|, eta a last digit of the largest coordinate.
  /// Points of one cell then have bounds that no function of V_h fits better. Zero where the mesh lies no farther than a hundred times its
  /// size from the origin: it is below every tolerance that can be asked for there.
  template <int dim>
  double data_round_off(const Problem<dim> &problem, const ConstraintSet<dim> &set, const DiscreteProblem &discrete);
} // namespace unilateral
