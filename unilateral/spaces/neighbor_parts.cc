#include "unilateral/spaces/neighbor_parts.h"

#include <algorithm>
#include <cstddef>
#include <stdexcept>

namespace unilateral
{
  using namespace dealii;

  template <int dim>
  NeighborParts find_neighbor_parts(const DoFHandler<dim> &linear, const SharedUnknowns &shared, const std::vector<unsigned> &owner)
  {
    const auto         &mesh = linear.get_triangulation();
    const auto          number = shared.numbers_by_owner(linear.n_dofs());
    const std::uint64_t n_before = shared.processes().sum_of_lower_ranks(mesh.n_active_cells());
    if (shared.processes().sum(std::uint64_t(std::max<std::size_t>(linear.n_dofs(), mesh.n_active_cells()))) >
        numbers::invalid_unsigned_int)
      throw std::runtime_error("the mesh that is divided has more vertices or cells than numbers of 32 bits can count");
    NeighborParts         neighbors;
    std::vector<unsigned> vertex(linear.n_dofs());
    neighbors.vertex_ids.assign(mesh.n_vertices(), numbers::invalid_unsigned_int);

    std::vector<std::pair<unsigned, NeighborParts::Cell>> cells_at;
    for (const auto &cell : linear.active_cell_iterators())
      for (const unsigned v : cell->vertex_indices())
      {
        const auto dof = cell->vertex_dof_index(v, 0);
        vertex[dof] = cell->vertex_index(v);
        neighbors.vertex_ids[vertex[dof]] = std::uint32_t(number[dof]);
        if (shared.shares(dof))
          cells_at.push_back({dof, {n_before + cell->active_cell_index(), owner[cell->active_cell_index()]}});
      }
    shared.share(cells_at);
    for (const auto &[dof, cell] : cells_at)
      if (cell.id < n_before || cell.id >= n_before + mesh.n_active_cells())
        neighbors.cells.push_back({vertex[dof], cell});
    return neighbors;
  }

#define INSTANTIATE(dim)                                                                                                                   \
  template NeighborParts find_neighbor_parts(const DoFHandler<dim> &, const SharedUnknowns &, const std::vector<unsigned> &);
  INSTANTIATE(2)
  INSTANTIATE(3)
#undef INSTANTIATE
} // namespace unilateral
