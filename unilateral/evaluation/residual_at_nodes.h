// The residual of a discrete solution, by other means than those of its solver.
#pragma once

#include "unilateral/constraints/constraint_set.h"
#include "unilateral/discretisation/problem.h"
#include "unilateral/inequality/discrete_problem.h"

namespace unilateral
{
  /// (sum of r_i^2 / A_ii)^1/2 over the nodes that no support holds, r = A u + B'W lambda - f: up to a factor of order 1 at most the energy
  /// norm of A^-1 r; entries that rounding explains count as zero. From the forms on each cell, without the operators of the solver. For
  /// forms with one component. Collective.
  template <int dim>
  double residual_at_nodes(const Problem<dim> &problem, const ConstraintSet<dim> &constraint_set, const Vector &u, const Vector &lambda);
} // namespace unilateral
