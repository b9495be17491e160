// Nodes that are images of others: u(x + shift) = u(x) + jump between two parts of the boundary.
#pragma once

#include "unilateral/base/diagnostics.h"
#include "unilateral/spaces/part_nodes.h"

#include <deal.II/base/tensor.h>
#include <deal.II/lac/affine_constraints.h>

#include <map>
#include <string>
#include <utility>
#include <vector>

namespace unilateral
{
  /// PeriodicParts of a mesh.
  struct PeriodicPair
  {
    dealii::types::boundary_id first, second;
    std::vector<double>        jump; ///< an entry per component of u
    std::string                first_name, second_name;
    SourceLocation             where;
  };

  /// u at `node` is u at `original` plus `jump`.
  template <int dim>
  struct PeriodicImage
  {
    PartNode<dim>          node, original;
    dealii::Tensor<1, dim> jump;
  };

  /// The images of a space. A node in a corner of several pairs is an image of the same original as the others there.
  template <int dim>
  class PeriodicNodes
  {
  public:
    PeriodicNodes() = default;

    /// The nodes of each second part have to be those of the first, shifted, to 1e-9 of the size of the parts. Throws InputError where they
    /// are not. @p is_part: of a mesh that several processes have, all cells at both parts or none.
    PeriodicNodes(const std::vector<PeriodicPair>         &pairs,
                  const dealii::Mapping<dim>              &mapping,
                  const dealii::DoFHandler<dim>           &dof_handler,
                  const dealii::AffineConstraints<double> &hanging_nodes,
                  bool                                     is_part = false);

    bool                                   empty() const { return all.empty(); }
    const std::vector<PeriodicImage<dim>> &images() const { return all; }

    /// The image whose unknown @p dof is, and the component that it is of; nullptr: of none.
    std::pair<const PeriodicImage<dim> *, unsigned> image_with(dealii::types::global_dof_index dof) const;

  private:
    std::vector<PeriodicImage<dim>>                                             all;
    std::map<dealii::types::global_dof_index, std::pair<std::size_t, unsigned>> place; ///< in `all`, and component
  };
} // namespace unilateral
