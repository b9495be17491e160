#include "unilateral/mesh/part_description.h"

#include "unilateral/base/sort_unique.h"

#include <algorithm>
#include <utility>

namespace unilateral
{
  using namespace dealii;

  namespace
  {
    template <int dim>
    void describe_surroundings(const PartDescription<dim> &description, Subdomain<dim> &subdomain)
    {
      // Cells around are numbered as in the whole, without the gaps, so that lists of them stay in order.
      auto known = description.cells_at;
      sort_unique(known);
      const auto number_of = [&](const std::uint32_t cell)
      { return unsigned(std::lower_bound(known.begin(), known.end(), cell) - known.begin()); };
      subdomain.division.owner.resize(known.size());
      subdomain.cells_at_vertex.resize(description.vertices.size());
      std::size_t at = 0;
      for (unsigned v = 0; v < description.vertices.size(); ++v)
      {
        subdomain.number_of_vertex.emplace(description.vertices[v], v);
        for (std::uint32_t k = 0; k < description.n_cells_at[v]; ++k, ++at)
        {
          const unsigned number = number_of(description.cells_at[at]);
          subdomain.cells_at_vertex[v].push_back(number);
          subdomain.division.owner[number] = description.owners[at];
        }
      }
      for (const auto cell : description.cells)
        subdomain.own_cells.push_back(number_of(cell));
      subdomain.ids_of_cells = description.cells;
      subdomain.own_active_cells = subdomain.own_cells;
      subdomain.vertex = description.corners;
      subdomain.ids_of_vertices = description.vertices;
    }
  } // namespace

  template <int dim>
  ReceivedPart<dim> make_part(PartDescription<dim> description, const Processes &processes)
  {
    ReceivedPart<dim> part;
    part.subdomain = std::make_unique<Subdomain<dim>>();
    auto &subdomain = *part.subdomain;
    subdomain.processes = processes;
    subdomain.some_point = point_at<dim>(description.some_point);
    subdomain.whole.simplex = description.simplex;
    describe_surroundings(description, subdomain);

    Mesh<dim> &mesh = part.mesh;
    mesh.part_names = std::move(description.part_names);
    const types::boundary_id cut = mesh.part_names.size();
    mesh.part_names.push_back("");
    mesh.region_names = std::move(description.region_names);
    mesh.warnings = std::move(description.warnings);
    mesh.approximates_curves = description.approximates_curves;
    mesh.simplex = description.simplex;
    mesh.curved = description.curved;

    std::vector<Point<dim>> points;
    for (const auto &x : description.points)
      points.push_back(point_at<dim>(x));
    const auto number_of = [&](const std::uint32_t vertex)
    { return unsigned(std::lower_bound(description.vertices.begin(), description.vertices.end(), vertex) - description.vertices.begin()); };
    std::vector<CellData<dim>> cells;
    for (std::size_t k = 0; k < description.cells.size(); ++k)
    {
      auto &cell = cells.emplace_back(description.vertices_per_cell);
      for (unsigned v = 0; v < description.vertices_per_cell; ++v)
        cell.vertices[v] = number_of(description.corners[k * description.vertices_per_cell + v]);
      cell.material_id = description.regions[k];
    }
    mesh.triangulation = std::make_unique<Triangulation<dim>>();
    mesh.triangulation->create_triangulation(points, cells, SubCellData());
    for (const auto &cell : mesh.triangulation->active_cell_iterators())
      for (const auto face : cell->face_indices())
        if (cell->at_boundary(face))
        {
          const auto id = description.boundaries[cell->active_cell_index() * description.faces_per_cell + face];
          cell->face(face)->set_boundary_id(id == on_cut ? cut : id);
        }
    if (description.has_curved_cells)
    {
      PointsByVertices<dim> nodes;
      for (std::size_t k = 0; k < description.curved_at.size(); ++k)
      {
        std::vector<unsigned> around;
        for (const auto vertex : description.curved_at[k])
          around.push_back(number_of(vertex));
        std::sort(around.begin(), around.end());
        nodes.emplace(std::move(around), point_at<dim>(description.curved_points[k]));
      }
      mesh.curved_cells = std::make_shared<CurvedCells<dim>>(*mesh.triangulation, nodes);
    }
    return part;
  }

#define INSTANTIATE(dim) template ReceivedPart<dim> make_part(PartDescription<dim>, const Processes &);
  INSTANTIATE(2)
  INSTANTIATE(3)
#undef INSTANTIATE
} // namespace unilateral
