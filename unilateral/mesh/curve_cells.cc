#include "unilateral/mesh/curve_cells.h"

#include "unilateral/base/point_text.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

namespace unilateral
{
  using dealii::Point;

  namespace
  {
    /// The list's cells of higher degree, with their nodes in the order of the reference cells of the coarse mesh.
    template <int dim>
    DrawnCells<dim> drawn_cells(const dealii::Triangulation<dim> &coarse, const CellList &list)
    {
      const auto sorted = [](std::vector<unsigned> vertices)
      {
        std::sort(vertices.begin(), vertices.end());
        return vertices;
      };
      std::map<std::vector<unsigned>, std::size_t> entry_of_vertices;
      for (std::size_t k = 0; k < list.drawn_cells.size(); ++k)
        entry_of_vertices.try_emplace(sorted(list.cells[list.drawn_cells[k]]), k);
      const bool                                     simplex = is_simplex(list.kind);
      const auto                                     lattice = equidistant_points(simplex, dim, list.drawn_degree);
      std::map<std::array<unsigned, 3>, std::size_t> number;
      for (std::size_t n = 0; n < lattice.size(); ++n)
        number[lattice[n]] = n;
      DrawnCells<dim> drawn(simplex, list.drawn_degree);
      for (const auto &cell : coarse.active_cell_iterators())
      {
        std::vector<unsigned> vertices;
        for (const unsigned v : cell->vertex_indices())
          vertices.push_back(cell->vertex_index(v));
        const auto found = entry_of_vertices.find(sorted(vertices));
        if (found == entry_of_vertices.end())
          continue;
        // Where the list's reference cell has the origin of this one and the ends of its unit vectors.
        const auto                     &in_list = list.cells[list.drawn_cells[found->second]];
        std::array<Point<dim>, dim + 1> corners;
        for (unsigned d = 0; d <= dim; ++d)
        {
          const unsigned vertex = vertices[d == 0 ? 0 : simplex ? d : 1u << (d - 1)];
          corners[d] = cell->reference_cell().template vertex<dim>(std::find(in_list.begin(), in_list.end(), vertex) - in_list.begin());
        }
        std::vector<Point<dim>> nodes;
        for (const Point<dim> &unit : drawn.unit_nodes())
        {
          Point<dim> there = corners[0];
          for (unsigned d = 0; d < dim; ++d)
            there += unit[d] * (corners[d + 1] - corners[0]);
          std::array<unsigned, 3> i{};
          for (unsigned d = 0; d < dim; ++d)
            i[d] = static_cast<unsigned>(std::lround(there[d] * list.drawn_degree));
          nodes.emplace_back();
          for (unsigned d = 0; d < dim; ++d)
            nodes.back()[d] = list.drawn_points[found->second * lattice.size() + number.at(i)][d];
        }
        drawn.add(cell->index(), std::move(nodes));
      }
      return drawn;
    }
  } // namespace

  template <int dim>
  void curve_cells(Mesh<dim> &mesh, const CellList &list, const SourceLocation &where)
  {
    if (dim == 1 || list.middle_points.empty())
      return;
    PointsByVertices<dim> points;
    for (std::size_t k = 0; k < list.middle_points.size(); ++k)
    {
      std::vector<unsigned> vertices = list.middle_vertices[k];
      std::sort(vertices.begin(), vertices.end());
      Point<dim> &x = points[vertices];
      for (unsigned d = 0; d < dim; ++d)
        x[d] = list.middle_points[k][d];
    }
    auto        curved = std::make_shared<CurvedCells<dim>>(*mesh.triangulation, points);
    std::size_t n_straightened = 0;
    Point<dim>  first;
    for (auto folded = curved->folded_cells(*mesh.triangulation); !folded.empty(); folded = curved->folded_cells(*mesh.triangulation))
    {
      first = n_straightened == 0 ? folded.front()->center() : first;
      n_straightened += folded.size();
      std::size_t n_removed = 0;
      for (const auto &cell : folded)
        for (const Point<dim> &unit_node : curved->unit_nodes())
          n_removed += points.erase(vertices_around<dim>(cell, unit_node));
      if (n_removed == 0)
        throw InputError(where,
                         fmt::format("the mesh has a cell that is folded over itself near {}; make the mesh anew, finer or with "
                                     "another algorithm",
                                     point_text(folded.front()->center())),
                         MessageName("mesh-damaged"));
      *curved = CurvedCells<dim>(*mesh.triangulation, points);
    }
    if (n_straightened > 0)
      mesh.warnings.push_back(
        fmt::format("{} folded over {} near {}: the Jacobian of the map is not positive everywhere; taken as straight "
                    "there (let Gmsh make finer cells, or optimise them: Mesh.HighOrderOptimize = 2)",
                    n_straightened == 1 ? "a curved cell is" : fmt::format("{} curved cells are", n_straightened),
                    n_straightened == 1 ? "itself" : "themselves, the first", point_text(first)));
    if (curved->straight() && list.drawn_cells.empty())
      return;
    if (n_straightened == 0 && !list.drawn_cells.empty())
      curved->follow_drawing(*mesh.triangulation, drawn_cells<dim>(*mesh.triangulation, list));
    mesh.curved_cells = std::move(curved);
    mesh.curved = true;
  }

  template void curve_cells<1>(Mesh<1> &, const CellList &, const SourceLocation &);
  template void curve_cells<2>(Mesh<2> &, const CellList &, const SourceLocation &);
  template void curve_cells<3>(Mesh<3> &, const CellList &, const SourceLocation &);
} // namespace unilateral
