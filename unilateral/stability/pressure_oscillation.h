// Does a contact pressure oscillate from point to point?
#pragma once

#include "unilateral/constraints/constraint_set.h"
#include "unilateral/discretisation/problem.h"
#include "unilateral/inequality/discrete_problem.h"

#include <optional>

namespace unilateral
{
  /// The oscillation index of the pressure of one block,
  ///     ( sum_i w_i (lambda_i - l_i(x_i))^2 / sum_i w_i lambda_i^2 )^1/2,
  /// l_i the linear function that fits lambda best at the other points of the patch of i: the cells (faces) that hold the point, and their
  /// neighbours by a vertex where only one holds it. Over the points inside the contact zone, single cells without pressure included,
  /// three rings of cells next to the free boundary left out. A smooth pressure gives O(h^2), a checkerboard of full amplitude about 1.
  /// Nothing when no point lies so deep.
  template <int dim>
  std::optional<double> pressure_oscillation(const Problem<dim>       &problem,
                                             const ConstraintSet<dim> &constraint_set,
                                             std::size_t               block,
                                             const Vector             &contact_pressure);
} // namespace unilateral
