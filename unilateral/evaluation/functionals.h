// Integrals of expressions of the solution over the domain, a region, a part of the boundary or the constraint points.
#pragma once

#include "unilateral/discretisation/problem.h"
#include "unilateral/evaluation/estimator.h"
#include "unilateral/evaluation/run_result.h"

#include <vector>

namespace unilateral
{
  /// Throws InputError where functionals ask for what there is not: an unknown part or region, a quantity that this problem does not have,
  /// one of the boundary in the domain, pressure and gap without a constraint, or together with what only cells know.
  template <int dim>
  void check_functionals(const Problem<dim> &problem);

  /// The functionals of the statement: int g(x, u, ...) dx with the measure of the form (2 pi r dx where axisymmetric), by Gauss rules on
  /// cells or faces; where g uses the pressure or the gap, I_G(g) = sum_i w_i g(x_i, ...) over the constraint points on the part. Fluxes
  /// and stresses are the recovered ones, see RecoveredFlux. @p u with its prescribed values.
  template <int dim>
  std::vector<FunctionalResult> functional_values(const Problem<dim>       &problem,
                                                  const ConstraintSet<dim> &constraint_set,
                                                  const Vector             &u,
                                                  const Vector             &lambda,
                                                  const RecoveredFlux<dim> &flux);
} // namespace unilateral
