#include "unilateral/spaces/unknowns_on_cuts.h"

#include "unilateral/base/sort_unique.h"
#include "unilateral/spaces/nodes_on_cuts.h"

#include <deal.II/fe/fe.h>

#include <algorithm>
#include <array>
#include <utility>
#include <vector>

namespace unilateral
{
  using namespace dealii;

  namespace
  {
    /// Processes with a cell that has all these vertices, of the whole that was divided or of neighbour parts.
    template <int dim>
    std::vector<unsigned> processes_at(const Subdomain<dim> &subdomain, const NodeName &name)
    {
      std::vector<unsigned> cells = subdomain.cells_at(name.vertex[0]), common, ranks;
      for (unsigned k = 1; k < 4 && name.weight[k] > 0; ++k)
      {
        const auto &more = subdomain.cells_at(name.vertex[k]);
        common.clear();
        std::set_intersection(cells.begin(), cells.end(), more.begin(), more.end(), std::back_inserter(common));
        cells.swap(common);
      }
      for (const unsigned cell : cells)
        ranks.push_back(subdomain.owner(cell));
      sort_unique(ranks);
      return ranks;
    }
  } // namespace

  template <int dim>
  SharedUnknowns
  unknowns_on_cuts(const Subdomain<dim> &subdomain, const DoFHandler<dim> &dof_handler, const std::vector<CutLines> &lines_cut_since)
  {
    std::map<std::array<std::uint32_t, 5>, std::vector<unsigned>> known; // processes by the vertices of an edge or face
    std::vector<SharedUnknowns::Entry>                            entries;
    for (const auto &[name, dof] : subdomain.whole.simplex ? simplex_nodes_on_cuts(subdomain, dof_handler, lines_cut_since)
                                                           : hypercube_nodes_on_cuts(subdomain, dof_handler))
    {
      const std::uint32_t n = std::count_if(name.weight.begin(), name.weight.end(), [](const auto weight) { return weight > 0; });
      const auto [entry, is_new] = known.try_emplace({name.vertex[0], name.vertex[1], name.vertex[2], name.vertex[3], n});
      if (is_new)
        entry->second = processes_at(subdomain, name);
      if (entry->second.size() > 1)
        entries.push_back({dof, entry->second});
    }
    return SharedUnknowns(subdomain.processes, dof_handler.n_dofs(), entries);
  }

  template <int dim>
  std::map<types::global_dof_index, std::array<types::global_dof_index, dim>>
  unknowns_of_nodes(const DoFHandler<dim> &dof_handler, const std::set<types::global_dof_index> &first)
  {
    std::map<types::global_dof_index, std::array<types::global_dof_index, dim>> result;
    if (first.empty())
      return result;
    const auto                          &fe = dof_handler.get_fe();
    std::vector<types::global_dof_index> dofs(fe.n_dofs_per_cell());
    for (const auto &cell : dof_handler.active_cell_iterators())
    {
      cell->get_dof_indices(dofs);
      for (unsigned i = 0; i < dofs.size(); ++i)
        if (const auto [component, shape] = fe.system_to_component_index(i); component == 0 && first.count(dofs[i]))
        {
          auto &node = result[dofs[i]];
          for (unsigned c = 0; c < fe.n_components(); ++c)
            node[c] = dofs[fe.component_to_system_index(c, shape)];
        }
    }
    return result;
  }

#define INSTANTIATE(dim)                                                                                                                   \
  template SharedUnknowns unknowns_on_cuts(const Subdomain<dim> &, const DoFHandler<dim> &, const std::vector<CutLines> &);
  INSTANTIATE(2)
  INSTANTIATE(3)
#undef INSTANTIATE

#define INSTANTIATE(dim)                                                                                                                   \
  template std::map<types::global_dof_index, std::array<types::global_dof_index, dim>> unknowns_of_nodes<dim>(                             \
    const DoFHandler<dim> &, const std::set<types::global_dof_index> &);
  INSTANTIATE(1)
  INSTANTIATE(2)
  INSTANTIATE(3)
#undef INSTANTIATE
} // namespace unilateral
