// The nodes of a part of the boundary.
#pragma once

#include <deal.II/base/point.h>
#include <deal.II/base/types.h>
#include <deal.II/dofs/dof_handler.h>
#include <deal.II/fe/mapping.h>

#include <array>
#include <vector>

namespace unilateral
{
  template <int dim>
  struct PartNode
  {
    dealii::Point<dim>                               x;
    std::array<dealii::types::global_dof_index, dim> dofs{}; ///< an entry per component of u: one or dim
    bool                                             at_vertex = false;
  };

  /// The nodes on the faces of @p part, each once, in the order of their first unknown; of Lagrange elements.
  template <int dim>
  std::vector<PartNode<dim>>
  nodes_of_part(dealii::types::boundary_id part, const dealii::Mapping<dim> &mapping, const dealii::DoFHandler<dim> &dof_handler);
} // namespace unilateral
