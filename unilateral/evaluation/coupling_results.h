// What rigid platens and periodic parts do: motions, and the forces that pass through them.
#pragma once

#include "unilateral/constraints/constraint_set.h"
#include "unilateral/discretisation/problem.h"
#include "unilateral/evaluation/run_result.h"
#include "unilateral/inequality/discrete_problem.h"

#include <vector>

namespace unilateral
{
  /// Motions of the platens, from u at their nodes, and the forces by which they move the body: what is missing in A u + B'W lambda = f
  /// without the loads on the parts themselves.
  template <int dim>
  std::vector<PlatenResult>
  platen_results(const Problem<dim> &problem, const ConstraintSet<dim> &constraint_set, const Vector &u, const Vector &lambda);

  /// The forces, fluxes of a scalar u, by which the next period acts on second parts.
  template <int dim>
  std::vector<PeriodicResult>
  periodic_results(const Problem<dim> &problem, const ConstraintSet<dim> &constraint_set, const Vector &u, const Vector &lambda);
} // namespace unilateral
