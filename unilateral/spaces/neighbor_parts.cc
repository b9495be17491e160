#include "unilateral/spaces/neighbor_parts.h"

#include <numeric>

namespace unilateral
{
  using namespace dealii;

  namespace
  {
    /// How many there are on the processes before this one.
    std::uint64_t count_before(const std::uint64_t n, const Processes &processes)
    {
      const auto counts = processes.gather(std::vector<std::uint64_t>(1, n));
      return std::accumulate(counts.begin(), counts.begin() + processes.rank(), std::uint64_t(0));
    }

    /// For each unknown a number that it has on all processes.
    std::vector<double> common_numbers(const std::size_t n_dofs, const SharedUnknowns &shared)
    {
      std::vector<double> number(n_dofs, 0);
      std::uint64_t       next = count_before(n_dofs - shared.n_not_owned(), shared.processes());
      for (std::size_t dof = 0; dof < n_dofs; ++dof)
        if (shared.owns(dof))
          number[dof] = next++;
      shared.take_from_owner(number.data());
      return number;
    }
  } // namespace

  template <int dim>
  NeighborParts find_neighbor_parts(const DoFHandler<dim> &linear, const SharedUnknowns &shared, const std::vector<unsigned> &owner)
  {
    const auto           &mesh = linear.get_triangulation();
    const auto            number = common_numbers(linear.n_dofs(), shared);
    const std::uint64_t   n_before = count_before(mesh.n_active_cells(), shared.processes());
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
