// A part of the boundary of a body that is bonded to a rigid platen.
#pragma once

#include "unilateral/spaces/boundary_condition.h"
#include "unilateral/spaces/part_nodes.h"
#include "unilateral/spaces/rigid_motion.h"

#include <deal.II/lac/affine_constraints.h>

#include <optional>
#include <utility>
#include <vector>

namespace unilateral
{
  /// An unknown that follows others: of a function of V_h whose prescribed values are zero it is the sum of factor * (other unknown).
  struct TiedUnknown
  {
    dealii::types::global_dof_index                                 dof;
    std::vector<std::pair<dealii::types::global_dof_index, double>> entries;
  };

  /// u(x) = t + theta x (x - reference) at the nodes.
  template <int dim>
  struct RigidPart
  {
    dealii::types::boundary_id         part = 0;
    dealii::Point<dim>                 reference;
    double                             length = 0; ///< largest distance of a node from there
    std::vector<PartNode<dim>>         nodes;      ///< but hanging ones, which follow their neighbours
    std::vector<std::optional<double>> translation, rotation;

    bool restrained = false; ///< something holds one of its motions; by add_rigid_lines()

    bool prescribes_motion() const; ///< or a part of it
  };

  /// The part of the boundary that @p condition is for. @p centroid: of the part.
  template <int dim>
  RigidPart<dim> make_rigid_part(dealii::types::boundary_id               part,
                                 const PartCondition                     &condition,
                                 const dealii::Point<dim>                &centroid,
                                 const dealii::Mapping<dim>              &mapping,
                                 const dealii::DoFHandler<dim>           &dof_handler,
                                 const dealii::AffineConstraints<double> &hanging_nodes);

  /// An equation for the motion of a platen: n.(u(x) - u(other)) = g, or n.u(x) = g.
  template <int dim>
  struct PlatenEquation
  {
    dealii::Tensor<1, dim>            n;
    double                            g = 0;
    dealii::Point<dim>                x;
    std::optional<dealii::Point<dim>> other = {};
    int                               rank = 0;
  };

  /// The lines that make the nodes move as a rigid body. Of its motions those count that the prescribed ones and @p equations, in this
  /// order, leave possible; as many unknowns, chosen where they determine them best, stay free, and all others follow them. Adds those to
  /// @p ties as well. Returns the equations that others contradict, and by how much.
  template <int dim>
  std::vector<std::pair<PlatenEquation<dim>, double>> add_rigid_lines(RigidPart<dim>                         &platen,
                                                                      const std::vector<PlatenEquation<dim>> &equations,
                                                                      dealii::AffineConstraints<double>      &lines,
                                                                      std::vector<TiedUnknown>               &ties);
} // namespace unilateral
