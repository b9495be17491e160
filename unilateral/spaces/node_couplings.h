// Nodes that do not move by themselves: images of others on periodic parts, and those of rigid platens.
#pragma once

#include "unilateral/base/processes.h"
#include "unilateral/spaces/periodic_nodes.h"
#include "unilateral/spaces/rigid_part.h"

#include <string>
#include <vector>

namespace unilateral
{
  template <int dim>
  struct NodeCouplings
  {
    PeriodicNodes<dim>          periodic;
    std::vector<RigidPart<dim>> rigid_parts;
    std::vector<TiedUnknown>    ties; ///< of both, in terms of unknowns that no tie has; by make_dirichlet_conditions()

    bool empty() const { return periodic.empty() && rigid_parts.empty(); }
  };

  /// The couplings of a space of Lagrange elements; without `ties`. Throws InputError where periodic meshes do not match, where two rigid
  /// parts have a node in common, and where a node of a rigid part is the image of one that is not. Of several @p processes one has all
  /// cells at such parts, see divide().
  template <int dim>
  NodeCouplings<dim> make_node_couplings(const std::vector<PartCondition>        &conditions,
                                         const std::vector<PeriodicPair>         &pairs,
                                         const dealii::Mapping<dim>              &mapping,
                                         const dealii::DoFHandler<dim>           &dof_handler,
                                         const dealii::AffineConstraints<double> &hanging_nodes,
                                         const Processes                         &processes);
} // namespace unilateral
