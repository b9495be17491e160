#include "unilateral/spaces/nodes_on_cuts.h"

#include <deal.II/fe/fe.h>

#include <algorithm>
#include <cmath>

namespace unilateral
{
  using namespace dealii;

  namespace
  {
    /// Another process has a cell at the vertex with this @p id.
    template <int dim>
    bool others_have(const Subdomain<dim> &subdomain, const std::uint32_t id)
    {
      const auto &cells = subdomain.cells_at(id);
      return std::any_of(cells.begin(), cells.end(),
                         [&](const unsigned cell) { return subdomain.owner(cell) != subdomain.processes.rank(); });
    }

    void sort_by_name(NamedUnknowns &named)
    {
      std::sort(named.begin(), named.end());
      named.erase(std::unique(named.begin(), named.end(), [](const auto &a, const auto &b) { return a.second == b.second; }), named.end());
    }

    template <int dim>
    class HypercubeNodes
    {
    public:
      HypercubeNodes(const Subdomain<dim> &subdomain, const DoFHandler<dim> &dof_handler)
        : subdomain(subdomain), dof_handler(dof_handler), fe(dof_handler.get_fe()), n_dofs_per_cell(fe.n_dofs_per_cell()),
          degree(fe.has_support_points() ? fe.degree : 1),
          n_intervals(std::int64_t(degree) << (dof_handler.get_triangulation().n_levels() - 1)), position(positions_on_cell())
      {
      }

      NamedUnknowns by_name()
      {
        cell_dofs.resize(n_dofs_per_cell);
        for (auto cell = dof_handler.begin(0); cell != dof_handler.end(0); ++cell)
          if (is_on_cut(vertices_of(cell)))
            visit(cell, vertices_of(cell), Cube{}, n_intervals);
        sort_by_name(named);
        return std::move(named);
      }

    private:
      using CellIterator = typename DoFHandler<dim>::cell_iterator;
      using Cube = std::array<std::int64_t, dim>; ///< its lower corner
      static constexpr unsigned n_vertices = GeometryInfo<dim>::vertices_per_cell;

      /// Of each unknown of a cell, by direction.
      std::vector<std::array<unsigned, dim>> positions_on_cell() const
      {
        std::vector<std::array<unsigned, dim>> positions(n_dofs_per_cell);
        if (!fe.has_support_points()) // values and derivatives at the vertices
        {
          for (unsigned i = 0; i < n_dofs_per_cell; ++i)
            for (unsigned d = 0; d < dim; ++d)
              positions[i][d] = i / fe.n_dofs_per_vertex() >> d & 1u;
          return positions;
        }
        std::vector<double> nodes;
        for (unsigned i = 0; i < n_dofs_per_cell; ++i)
          nodes.push_back(fe.unit_support_point(i)[0]);
        std::sort(nodes.begin(), nodes.end());
        nodes.erase(std::unique(nodes.begin(), nodes.end(), [](const double a, const double b) { return b - a < 1e-8; }), nodes.end());
        for (unsigned i = 0; i < n_dofs_per_cell; ++i)
          for (unsigned d = 0; d < dim; ++d)
            positions[i][d] = std::lower_bound(nodes.begin(), nodes.end(), fe.unit_support_point(i)[d] - 1e-8) - nodes.begin();
        return positions;
      }

      const std::uint32_t *vertices_of(const CellIterator &coarse) const { return subdomain.vertex.data() + coarse->index() * n_vertices; }

      bool is_on_cut(const std::uint32_t *const vertices) const
      {
        return std::any_of(vertices, vertices + n_vertices, [&](const std::uint32_t v) { return others_have(subdomain, v); });
      }

      /// @p cell lies in the coarse cell with these @p vertices, at @p corner, and is @p width intervals wide.
      void visit(const CellIterator &cell, const std::uint32_t *const vertices, const Cube &corner, const std::int64_t width)
      {
        bool inside = true;
        for (unsigned d = 0; d < dim; ++d)
          inside &= corner[d] > 0 && corner[d] + width < n_intervals;
        if (inside)
          return;
        if (!cell->has_children())
        {
          name_nodes(cell, vertices, corner, width / std::int64_t(degree));
          return;
        }
        for (unsigned c = 0; c < cell->n_children(); ++c)
        {
          Cube child = corner;
          for (unsigned d = 0; d < dim; ++d)
            child[d] += (c >> d & 1u) * (width / 2);
          visit(cell->child(c), vertices, child, width / 2);
        }
      }

      /// @p spacing: of the nodes, in intervals.
      void name_nodes(const CellIterator &cell, const std::uint32_t *const vertices, const Cube &corner, const std::int64_t spacing)
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
              const std::int64_t at = corner[d] + spacing * position[i][d], share = v >> d & 1u ? at : n_intervals - at;
              weight *= share == n_intervals ? 1 : share; // a common factor of all weights, which would overflow on deep levels
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
          name.component = fe.has_support_points() ? fe.system_to_component_index(i).first : i % fe.n_dofs_per_vertex();
          named.emplace_back(name, cell_dofs[i]);
        }
      }

      const Subdomain<dim>                                &subdomain;
      const DoFHandler<dim>                               &dof_handler;
      const FiniteElement<dim>                            &fe;
      const unsigned                                       n_dofs_per_cell;
      const unsigned                                       degree;      ///< intervals between nodes on an edge of a cell
      const std::int64_t                                   n_intervals; ///< between nodes on an edge of a coarse cell
      const std::vector<std::array<unsigned, dim>>         position;
      NamedUnknowns                                        named;
      std::vector<types::global_dof_index>                 cell_dofs;
      std::vector<std::pair<std::uint32_t, std::uint64_t>> weights;
    };

    /// A point by its weights at vertices of the mesh that was cut, of those at which another process has a cell. It has none where it
    /// lies inside a cell, since no other process can have it then.
    template <int dim>
    class PointOnCut
    {
    public:
      PointOnCut() = default;
      explicit PointOnCut(const std::uint32_t vertex) : entries{{{vertex, 1}}}, n(1) {}

      bool inside() const { return n == 0; }

      /// This one becomes a combination with @p other, whose weights count @p factor times.
      void add(const PointOnCut &other, const std::uint64_t factor)
      {
        has_part_inside = has_part_inside || other.inside();
        for (unsigned k = 0; k < other.n && !has_part_inside; ++k)
        {
          const auto end = entries.begin() + n;
          const auto here = std::find_if(entries.begin(), end, [&](const Entry &entry) { return entry.vertex == other.entries[k].vertex; });
          if (here != end)
            here->weight += factor * other.entries[k].weight;
          else if (n < dim)
            entries[n++] = {other.entries[k].vertex, factor * other.entries[k].weight};
          else
            has_part_inside = true; // it has more vertices than a face
        }
        if (has_part_inside)
          n = 0;
      }

      void scale(const std::uint64_t factor)
      {
        for (unsigned k = 0; k < n; ++k)
          entries[k].weight *= factor;
      }

      NodeName name(const std::uint32_t component) const
      {
        auto sorted = entries;
        std::sort(sorted.begin(), sorted.begin() + n, [](const Entry &a, const Entry &b) { return a.vertex < b.vertex; });
        NodeName result;
        for (unsigned k = 0; k < n; ++k)
        {
          result.vertex[k] = sorted[k].vertex;
          result.weight[k] = sorted[k].weight;
        }
        result.component = component;
        return result;
      }

    private:
      struct Entry
      {
        std::uint32_t vertex = 0;
        std::uint64_t weight = 0;
      };
      std::array<Entry, dim> entries{};
      unsigned               n = 0;
      bool                   has_part_inside = false;
    };

    /// The vertices of the refined part. The weights of each add up to 2^n after n refinements.
    template <int dim>
    std::vector<PointOnCut<dim>> vertices_on_cuts(const Subdomain<dim> &subdomain, const std::vector<CutLines> &lines_cut)
    {
      std::vector<PointOnCut<dim>> points;
      for (const std::uint32_t id : subdomain.ids_of_vertices)
        points.push_back(others_have(subdomain, id) ? PointOnCut<dim>(id) : PointOnCut<dim>());
      for (const CutLines &lines : lines_cut)
      {
        const std::size_t n_before = points.size();
        for (const auto &[a, b] : lines)
        {
          PointOnCut<dim> middle;
          middle.add(points[a], 1);
          middle.add(points[b], 1);
          points.push_back(middle);
        }
        for (std::size_t k = 0; k < n_before; ++k)
          points[k].scale(2);
      }
      return points;
    }
  } // namespace

  template <int dim>
  NamedUnknowns hypercube_nodes_on_cuts(const Subdomain<dim> &subdomain, const DoFHandler<dim> &dof_handler)
  {
    return HypercubeNodes<dim>(subdomain, dof_handler).by_name();
  }

  template <int dim>
  NamedUnknowns
  simplex_nodes_on_cuts(const Subdomain<dim> &subdomain, const DoFHandler<dim> &dof_handler, const std::vector<CutLines> &lines_cut)
  {
    const auto                          &fe = dof_handler.get_fe();
    const unsigned                       n_dofs_per_cell = fe.n_dofs_per_cell();
    const auto                           vertices = vertices_on_cuts(subdomain, lines_cut);
    std::vector<types::global_dof_index> cell_dofs(n_dofs_per_cell);
    std::vector<unsigned>                weights; // [unknown of a cell][vertex], in parts of the degree
    for (unsigned i = 0; i < n_dofs_per_cell; ++i)
      for (unsigned v = 0; v <= dim; ++v)
        weights.push_back(std::lround(fe.degree * fe.reference_cell().d_linear_shape_function(fe.unit_support_point(i), v)));

    NamedUnknowns named;
    for (const auto &cell : dof_handler.active_cell_iterators())
    {
      const auto indices = cell->vertex_indices();
      if (std::all_of(indices.begin(), indices.end(), [&](const unsigned v) { return vertices[cell->vertex_index(v)].inside(); }))
        continue;
      cell->get_dof_indices(cell_dofs);
      for (unsigned i = 0; i < n_dofs_per_cell; ++i)
      {
        PointOnCut<dim> node;
        for (unsigned v = 0; v <= dim; ++v)
          if (const unsigned weight = weights[i * (dim + 1) + v]; weight > 0)
            node.add(vertices[cell->vertex_index(v)], weight);
        if (!node.inside())
          named.emplace_back(node.name(fe.system_to_component_index(i).first), cell_dofs[i]);
      }
    }
    sort_by_name(named);
    return named;
  }

#define INSTANTIATE(dim)                                                                                                                   \
  template NamedUnknowns hypercube_nodes_on_cuts(const Subdomain<dim> &, const DoFHandler<dim> &);                                         \
  template NamedUnknowns simplex_nodes_on_cuts(const Subdomain<dim> &, const DoFHandler<dim> &, const std::vector<CutLines> &);
  INSTANTIATE(2)
  INSTANTIATE(3)
#undef INSTANTIATE
} // namespace unilateral
