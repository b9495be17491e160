// Prescribed values: u = g, single components, and u.n = 0 on planes of symmetry.
#pragma once

#include "unilateral/base/shared_unknowns.h"
#include "unilateral/spaces/boundary_condition.h"
#include "unilateral/spaces/node_couplings.h"

#include <deal.II/dofs/dof_handler.h>
#include <deal.II/fe/mapping.h>
#include <deal.II/lac/affine_constraints.h>

#include <string>
#include <vector>

namespace unilateral
{
  /// A vertex of the boundary and a component of u that is zero there.
  template <int dim>
  struct Pin
  {
    dealii::Point<dim> x;
    unsigned           component = 0;
  };

  /// A value that [boundary] prescribes at a node and that is dropped, since other conditions there demand another one.
  template <int dim>
  struct DroppedValue
  {
    dealii::Point<dim> x;
    std::string        part;           ///< whose value it is
    std::string        kept_part;      ///< whose value counts
    double             difference = 0; ///< of what the part demands and what u is there
  };

  /// What the conditions by boundary_id fix of V_h, u with one component or dim. At a node every condition is an equation n.u = g; where
  /// several meet, named parts come before `all` and later parts before earlier ones, and an equation that those before it already decide
  /// is dropped, and listed in @p dropped where it demands another value. Elimination makes each of them a line of the result: u_c = g -
  /// (other components of the node). On the cuts between subdomains (@p shared) what the faces of all processes say counts. @p pins come
  /// last. @p on_axis: u_x = 0 where x = 0, as in a body of revolution. @p hanging_nodes are lines of the result, resolved; nothing else is
  /// asked of them: on the boundary they lie between nodes of the boundary. @p couplings: conditions at an image are conditions at its
  /// original, those at nodes of a platen restrict its motion; sets their `ties`.
  template <int dim>
  dealii::AffineConstraints<double>
  make_dirichlet_conditions(const std::vector<PartCondition>        &conditions,
                            const dealii::Mapping<dim>              &mapping,
                            const dealii::DoFHandler<dim>           &dof_handler,
                            const std::vector<Pin<dim>>             &pins,
                            bool                                     on_axis,
                            const dealii::AffineConstraints<double> &hanging_nodes = dealii::AffineConstraints<double>(),
                            const SharedUnknowns                    &shared = {},
                            std::vector<DroppedValue<dim>>          *dropped = nullptr,
                            NodeCouplings<dim>                      *couplings = nullptr);
} // namespace unilateral
