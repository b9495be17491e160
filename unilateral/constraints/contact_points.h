// Where an elastic body may touch: the points of I_G on a boundary part, their normals, weights, and the trace v.n there.
#pragma once

#include "unilateral/base/shared_unknowns.h"
#include "unilateral/constraints/quadrature_rule.h"
#include "unilateral/constraints/round_surface.h"
#include "unilateral/constraints/trace_row.h"
#include "unilateral/forms/bilinear_form.h"

#include <deal.II/dofs/dof_handler.h>
#include <deal.II/fe/mapping.h>

#include <optional>
#include <vector>

namespace unilateral
{
  template <int dim>
  struct ContactPoint
  {
    dealii::Point<dim>     x;
    dealii::Tensor<1, dim> direction;          ///< unit vector; the body may move along it by the gap
    double                 weight = 0;         ///< > 0
    TraceRow               row;                ///< v(x).direction
    bool                   at_node = false;    ///< one shape function lives there
    bool                   owned = true;       ///< by this process: others may have the same node
    bool                   faces_away = false; ///< from the given direction: no point of contact

    /// Of a node: how far, at most, the normals of its faces are from the mean normals at the nodes of these faces. The direction is known
    /// to about that: at the rim of a curved part, where faces lie on one side only, it is half a face's turn off.
    double direction_error = 0;
  };

  /// The points of @p rule on the faces of @p part, the condition being v.n <= gap, or v.d <= gap when @p given = d (a unit vector), or,
  /// where that is nothing and the part is @p round, with the normal of what its facets stand for; where the surface does not face d the
  /// point says so.
  /// A node that faces share is one point, its normal the mean of theirs weighted with area, its weight the sum of theirs; where the part
  /// has an edge of more than 50 degrees it is a point for each side, with the side's own normal and weight: pressure on one side of an
  /// edge does not push the other.
  /// A hanging node hands its normals and weights over to the nodes that decide where it moves.
  /// A node on a cut between subdomains is a point on every process that has the node (@p shared), the same on each.
  /// Points at the vertices of faces (nodal rule of Q1 and P1, trapezoid) have the weight int l dS, l the linear function of the vertex:
  /// on a parallelogram the trapezoidal rule, elsewhere what makes a constant pressure exact. Weights include the form's measure; points
  /// without weight, on the axis of a body of revolution, are left out.
  template <int dim>
  std::vector<ContactPoint<dim>> contact_points(dealii::types::boundary_id                   part,
                                                const RuleName                              &rule,
                                                const std::optional<dealii::Tensor<1, dim>> &given,
                                                const std::optional<RoundSurface>           &round,
                                                const ElementName                           &element,
                                                const dealii::Mapping<dim>                  &mapping,
                                                const dealii::DoFHandler<dim>               &dof_handler,
                                                const dealii::AffineConstraints<double>     &hanging_nodes,
                                                const BilinearForm<dim>                     &form,
                                                const SharedUnknowns                        &shared);
} // namespace unilateral
