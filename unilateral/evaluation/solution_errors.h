// Errors of a discrete solution against an exact one.
#pragma once

#include "unilateral/discretisation/problem.h"
#include "unilateral/evaluation/run_result.h"

#include <deal.II/lac/la_parallel_vector.h>

namespace unilateral
{
  /// Errors against [exact]: L2 and H1 seminorm (of order 4 the H2 seminorm too) by quadrature with p + 3 points a direction, max and mean
  /// over all nodes of V_h and the components of u, pressure in I_G(.^2)^(1/2) over the points of the first constraint.
  template <int dim>
  Errors solution_errors(const Problem<dim>                                       &problem,
                         const ConstraintSet<dim>                                 &constraint_set,
                         const dealii::LinearAlgebra::distributed::Vector<double> &u,
                         const dealii::LinearAlgebra::distributed::Vector<double> &contact_pressure);
} // namespace unilateral
