// Faces between two cells, hanging ones among them.
#pragma once

#include "unilateral/spaces/function_space.h"

#include <deal.II/fe/fe_interface_values.h>

namespace unilateral
{
  /// Calls visit(values, dofs) for each face between two cells once, from the side of the cell with the smaller index, or of the finer one.
  template <int dim, typename Visit>
  void for_each_interior_face(const FunctionSpace<dim> &space, const dealii::Quadrature<dim - 1> &rule, const Visit &visit)
  {
    using namespace dealii;
    if constexpr (dim > 1)
    {
      FEInterfaceValues<dim> values(*space.mapping, *space.fe, rule,
                                    update_gradients | update_hessians | update_normal_vectors | update_quadrature_points |
                                      update_JxW_values);
      for (const auto &cell : space.dof_handler.active_cell_iterators())
        for (const auto face : cell->face_indices())
        {
          if (cell->at_boundary(face))
            continue;
          const auto neighbor = cell->neighbor(face);
          if (neighbor->has_children() || (cell->level() == neighbor->level() && !(cell->index() < neighbor->index())))
            continue;
          if (cell->neighbor_is_coarser(face))
          {
            const auto [other_face, subface] = cell->neighbor_of_coarser_neighbor(face);
            values.reinit(cell, face, numbers::invalid_unsigned_int, neighbor, other_face, subface);
          }
          else
            values.reinit(cell, face, numbers::invalid_unsigned_int, neighbor, cell->neighbor_of_neighbor(face),
                          numbers::invalid_unsigned_int);
          visit(values, values.get_interface_dof_indices());
        }
    }
  }
} // namespace unilateral
