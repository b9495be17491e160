// Prescribed values and slopes of Hermite functions: clamped, supported and guided edges, and supports inside a beam.
#pragma once

#include "unilateral/base/shared_unknowns.h"
#include "unilateral/spaces/boundary_condition.h"

#include <deal.II/dofs/dof_handler.h>
#include <deal.II/lac/affine_constraints.h>

#include <vector>

namespace unilateral
{
  /// On an edge with u = g the derivatives of g along it are prescribed with it, on one with du/dn = s those of s. n is the outer normal;
  /// in 1-D the slope is u' along x, at either end. Named parts come before `all`, later parts before earlier ones. Inner @p supports
  /// are nodes of the mesh. @p shared: the unknowns on cuts, where faces of other processes may prescribe values.
  /// Throws InputError where one is not.
  template <int dim>
  dealii::AffineConstraints<double> make_hermite_dirichlet_conditions(const std::vector<PartCondition> &conditions,
                                                                      const std::vector<InnerSupport>  &supports,
                                                                      const dealii::DoFHandler<dim>    &dof_handler,
                                                                      const SharedUnknowns             &shared = SharedUnknowns());
} // namespace unilateral
