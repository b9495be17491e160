#include "unilateral/spaces/interpolation_to_finer_mesh.h"

#include "unilateral/spaces/hanging_nodes.h"
#include "unilateral/spaces/interpolation_to_refined_cells.h"

#include <deal.II/grid/cell_id.h>

#include <map>
#include <stdexcept>
#include <vector>

namespace unilateral
{
  using namespace dealii;

  namespace
  {
    using NodalValues = LinearAlgebra::distributed::Vector<double>;

    template <int dim>
    using CellsById = std::map<CellId, typename DoFHandler<dim>::active_cell_iterator>;

    template <int dim>
    CellsById<dim> cells_by_id(const DoFHandler<dim> &dof_handler)
    {
      CellsById<dim> cells;
      for (const auto &cell : dof_handler.active_cell_iterators())
        cells[cell->id()] = cell;
      return cells;
    }

    /// The same function where the same cells have other numbers.
    template <int dim>
    NodalValues renumbered(const DoFHandler<dim> &from, const NodalValues &u, const DoFHandler<dim> &to)
    {
      const CellsById<dim>                 cells = cells_by_id(to);
      NodalValues                          result(to.n_dofs());
      std::vector<types::global_dof_index> old_dofs(from.get_fe().n_dofs_per_cell()), new_dofs(old_dofs.size());
      for (const auto &cell : from.active_cell_iterators())
      {
        cell->get_dof_indices(old_dofs);
        cells.at(cell->id())->get_dof_indices(new_dofs);
        for (std::size_t i = 0; i < old_dofs.size(); ++i)
          result(new_dofs[i]) = u(old_dofs[i]);
      }
      return result;
    }
  } // namespace

  template <int dim>
  NodalValues on_finer_mesh(const DoFHandler<dim> &coarse, const NodalValues &u, const DoFHandler<dim> &fine)
  {
    Triangulation<dim> mesh;
    mesh.copy_triangulation(coarse.get_triangulation());
    DoFHandler<dim> dof_handler(mesh);
    dof_handler.distribute_dofs(coarse.get_fe());
    std::vector<NodalValues> functions = {renumbered(coarse, u, dof_handler)};
    const CellsById<dim>     wanted = cells_by_id(fine);
    while (true)
    {
      bool any = false;
      for (const auto &cell : mesh.active_cell_iterators())
        if (wanted.count(cell->id()) == 0)
        {
          cell->set_refine_flag();
          any = true;
        }
      if (!any)
        return renumbered(dof_handler, functions[0], fine);
      if (mesh.n_levels() > fine.get_triangulation().n_levels())
        throw std::invalid_argument("one mesh is no refinement of the other");
      const InterpolationToRefinedCells<dim> carried(dof_handler, functions, /*smoothly=*/false);
      mesh.execute_coarsening_and_refinement();
      dof_handler.distribute_dofs(coarse.get_fe());
      carried.interpolate(dof_handler, functions);
      constraints_at_hanging_nodes(dof_handler).distribute(functions[0]);
    }
  }

  template NodalValues on_finer_mesh(const DoFHandler<1> &, const NodalValues &, const DoFHandler<1> &);
  template NodalValues on_finer_mesh(const DoFHandler<2> &, const NodalValues &, const DoFHandler<2> &);
  template NodalValues on_finer_mesh(const DoFHandler<3> &, const NodalValues &, const DoFHandler<3> &);
} // namespace unilateral
