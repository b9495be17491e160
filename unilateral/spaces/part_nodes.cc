#include "unilateral/spaces/part_nodes.h"

#include "unilateral/mesh/reference_face.h"
#include "unilateral/spaces/cell_points.h"

#include <deal.II/fe/fe.h>

#include <map>

namespace unilateral
{
  using namespace dealii;

  template <int dim>
  std::vector<PartNode<dim>> nodes_of_part(const types::boundary_id part, const Mapping<dim> &mapping, const DoFHandler<dim> &dof_handler)
  {
    const auto                                      &fe = dof_handler.get_fe();
    CellPoints<dim>                                  points(mapping, fe.reference_cell(), fe.get_unit_support_points());
    std::vector<types::global_dof_index>             dofs(fe.n_dofs_per_cell());
    std::map<types::global_dof_index, PartNode<dim>> nodes;
    for (const auto &cell : dof_handler.active_cell_iterators())
      for (const auto face : cell->face_indices())
      {
        if (!cell->at_boundary(face) || cell->face(face)->boundary_id() != part)
          continue;
        cell->get_dof_indices(dofs);
        const auto &x = points.on(cell);
        for (unsigned i = 0; i < dofs.size(); ++i)
        {
          const auto [component, shape] = fe.system_to_component_index(i);
          if (component != 0 || !lies_on_face<dim>(cell->reference_cell(), face, fe.unit_support_point(i)))
            continue;
          PartNode<dim> &node = nodes[dofs[i]];
          node.x = x[i];
          node.at_vertex = i < fe.n_dofs_per_vertex() * cell->n_vertices();
          for (unsigned c = 0; c < fe.n_components(); ++c)
            node.dofs[c] = dofs[fe.component_to_system_index(c, shape)];
        }
      }
    std::vector<PartNode<dim>> result;
    for (const auto &[dof, node] : nodes)
      result.push_back(node);
    return result;
  }

#define INSTANTIATE(dim)                                                                                                                   \
  template std::vector<PartNode<dim>> nodes_of_part(types::boundary_id, const Mapping<dim> &, const DoFHandler<dim> &);
  INSTANTIATE(1)
  INSTANTIATE(2)
  INSTANTIATE(3)
#undef INSTANTIATE
} // namespace unilateral
