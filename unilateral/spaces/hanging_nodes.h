// What continuity asks of functions where coarse cells meet finer ones.
#pragma once

#include <deal.II/dofs/dof_handler.h>
#include <deal.II/lac/affine_constraints.h>

namespace unilateral
{
  /// The unknowns at hanging nodes in terms of those that are free, closed; no lines on a mesh without such nodes.
  template <int dim>
  dealii::AffineConstraints<double> constraints_at_hanging_nodes(const dealii::DoFHandler<dim> &dof_handler);
} // namespace unilateral
