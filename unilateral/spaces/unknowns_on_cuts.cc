#include "unilateral/spaces/unknowns_on_cuts.h"

#include "unilateral/base/sort_unique.h"

#include <deal.II/fe/fe.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <numeric>
#include <tuple>
#include <utility>
#include <vector>

namespace unilateral
{
  using namespace dealii;

  namespace
  {
    /// A node on an edge or face of a coarse cell: its weights at the vertices there, in an order of their own.
    struct NodeName
    {
      std::array<std::uint32_t, 4> vertex{};
      std::array<std::uint64_t, 4> weight{}; ///< 0: no vertex
      std::uint32_t                component = 0;

      bool operator<(const NodeName &other) const
      {
        return std::tie(vertex, weight, component) < std::tie(other.vertex, other.weight, other.component);
      }
    };

    /// Processes with a cell of the whole mesh that has all these vertices.
    template <int dim>
    std::vector<unsigned> processes_at(const Subdomain<dim> &subdomain, const NodeName &name)
    {
      std::vector<unsigned> cells = subdomain.cells_at_vertex[name.vertex[0]], common, ranks;
      for (unsigned k = 1; k < 4 && name.weight[k] > 0; ++k)
      {
        const auto &more = subdomain.cells_at_vertex[name.vertex[k]];
        common.clear();
        std::set_intersection(cells.begin(), cells.end(), more.begin(), more.end(), std::back_inserter(common));
        cells.swap(common);
      }
      for (const unsigned cell : cells)
        ranks.push_back(subdomain.owner[cell]);
      sort_unique(ranks);
      return ranks;
    }

    /// Names of the nodes on edges and faces of coarse cells at which another process may have a cell.
    template <int dim>
    class NodesOnCuts
    {
    public:
      using Named = std::vector<std::pair<NodeName, std::uint32_t>>;

      NodesOnCuts(const Subdomain<dim> &subdomain, const DoFHandler<dim> &dof_handler)
        : subdomain(subdomain), dof_handler(dof_handler), fe(dof_handler.get_fe()), n_dofs_per_cell(fe.n_dofs_per_cell()),
          n_intervals(std::int64_t(fe.degree) << (dof_handler.get_triangulation().n_levels() - 1)), position(positions_on_cell())
      {
      }

      /// With their unknowns, each unknown once, in the order of the names, which is the same on all processes.
      Named by_name()
      {
        cell_dofs.resize(n_dofs_per_cell);
        for (auto cell = dof_handler.begin(0); cell != dof_handler.end(0); ++cell)
          if (is_on_cut(vertices_of(cell)))
            visit(cell, vertices_of(cell), Corner{}, n_intervals);
        std::sort(named.begin(), named.end());
        named.erase(std::unique(named.begin(), named.end(), [](const auto &a, const auto &b) { return a.second == b.second; }),
                    named.end());
        return std::move(named);
      }

    private:
      using CellIterator = typename DoFHandler<dim>::cell_iterator;
      using Corner = std::array<std::int64_t, dim>;
      static constexpr unsigned n_vertices = GeometryInfo<dim>::vertices_per_cell;

      /// Of each unknown of a cell, by direction.
      std::vector<std::array<unsigned, dim>> positions_on_cell() const
      {
        std::vector<double> nodes;
        for (unsigned i = 0; i < n_dofs_per_cell; ++i)
          nodes.push_back(fe.unit_support_point(i)[0]);
        std::sort(nodes.begin(), nodes.end());
        nodes.erase(std::unique(nodes.begin(), nodes.end(), [](const double a, const double b) { return b - a < 1e-8; }), nodes.end());
        std::vector<std::array<unsigned, dim>> positions(n_dofs_per_cell);
        for (unsigned i = 0; i < n_dofs_per_cell; ++i)
          for (unsigned d = 0; d < dim; ++d)
            positions[i][d] = std::lower_bound(nodes.begin(), nodes.end(), fe.unit_support_point(i)[d] - 1e-8) - nodes.begin();
        return positions;
      }

      const unsigned *vertices_of(const CellIterator &coarse) const { return subdomain.vertex.data() + coarse->index() * n_vertices; }

      bool is_on_cut(const unsigned *const vertices) const
      {
        for (unsigned v = 0; v < n_vertices; ++v)
          for (const unsigned other : subdomain.cells_at_vertex[vertices[v]])
            if (subdomain.owner[other] != subdomain.processes.rank())
              return true;
        return false;
      }

      /// @p cell lies in the coarse cell with these @p vertices, at @p corner, and is @p width intervals wide.
      void visit(const CellIterator &cell, const unsigned *const vertices, const Corner &corner, const std::int64_t width)
      {
        bool inside = true;
        for (unsigned d = 0; d < dim; ++d)
          inside &= corner[d] > 0 && corner[d] + width < n_intervals;
        if (inside)
          return;
        if (!cell->has_children())
        {
          name_nodes(cell, vertices, corner);
          return;
        }
        for (unsigned c = 0; c < cell->n_children(); ++c)
        {
          Corner child = corner;
          for (unsigned d = 0; d < dim; ++d)
            child[d] += (c >> d & 1u) * (width / 2);
          visit(cell->child(c), vertices, child, width / 2);
        }
      }

      void name_nodes(const CellIterator &cell, const unsigned *const vertices, const Corner &corner)
      {
        cell->get_dof_indices(cell_dofs);
        for (unsigned i = 0; i < n_dofs_per_cell; ++i)
        {
          weights.clear();
          for (unsigned v = 0; v < n_vertices; ++v)
          {
            std::uint64_t weight = 1;
            for (unsigned d = 0; d < dim; ++d)
            {
              const std::int64_t at = corner[d] + position[i][d];
              weight *= v >> d & 1u ? at : n_intervals - at;
            }
            if (weight > 0)
              weights.emplace_back(vertices[v], weight);
          }
          if (weights.size() == n_vertices)
            continue; // inside the coarse cell
          std::sort(weights.begin(), weights.end());
          NodeName name;
          for (unsigned k = 0; k < weights.size(); ++k)
          {
            name.vertex[k] = weights[k].first;
            name.weight[k] = weights[k].second;
          }
          name.component = fe.system_to_component_index(i).first;
          named.emplace_back(name, cell_dofs[i]);
        }
      }

      const Subdomain<dim>                                &subdomain;
      const DoFHandler<dim>                               &dof_handler;
      const FiniteElement<dim>                            &fe;
      const unsigned                                       n_dofs_per_cell;
      const std::int64_t                                   n_intervals; ///< between nodes on an edge of a coarse cell
      const std::vector<std::array<unsigned, dim>>         position;
      Named                                                named;
      std::vector<types::global_dof_index>                 cell_dofs;
      std::vector<std::pair<std::uint32_t, std::uint64_t>> weights;
    };
  } // namespace

  template <int dim>
  SharedUnknowns unknowns_on_cuts(const Subdomain<dim> &subdomain, const DoFHandler<dim> &dof_handler)
  {
    std::map<std::array<std::uint32_t, 5>, std::vector<unsigned>> known; // processes by the vertices of an edge or face
    std::vector<SharedUnknowns::Entry>                            entries;
    for (const auto &[name, dof] : NodesOnCuts<dim>(subdomain, dof_handler).by_name())
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

#define INSTANTIATE(dim) template SharedUnknowns unknowns_on_cuts(const Subdomain<dim> &, const DoFHandler<dim> &);
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
