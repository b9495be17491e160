// Contact that reaches nodes whose values are prescribed.
#pragma once

#include "unilateral/algebra/vector.h"
#include "unilateral/constraints/constraint_set.h"
#include "unilateral/discretisation/problem.h"

#include <vector>

namespace unilateral
{
  /// The force that condition @p b would bear at nodes whose values are fixed if the pressure there were that of its neighbours, by active
  /// cell: there is no point of I_G at such nodes, and the support bears it. Falls with h. For rules with points at nodes.
  template <int dim>
  std::vector<double> force_at_fixed_nodes(const Problem<dim> &problem, const ConstraintSet<dim> &set, std::size_t b, const Vector &lambda);
} // namespace unilateral
