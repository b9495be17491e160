#include "unilateral/mesh/sent_part.h"

#include "unilateral/base/byte_archive.h"
#include "unilateral/base/sort_unique.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <string>
#include <utility>

namespace unilateral
{
  using namespace dealii;

  namespace
  {
    constexpr types::boundary_id on_cut = numbers::internal_face_boundary_id;

    template <typename Archive>
    void archive_names(Archive &archive, std::vector<std::string> &names)
    {
      std::size_t n = names.size();
      archive(n);
      names.resize(n);
      for (std::string &name : names)
        archive(name);
    }

    /// What is sent; vertices and cells by their numbers in the whole.
    template <int dim>
    struct Message
    {
      std::vector<std::string>                part_names, region_names, warnings;
      bool                                    approximates_curves = false, simplex = false, curved = false, has_curved_cells = false;
      std::array<double, dim>                 some_point{};
      std::vector<std::uint32_t>              vertices; ///< ascending
      std::vector<std::array<double, dim>>    points;   ///< of these
      std::vector<std::uint32_t>              cells;    ///< own ones
      unsigned                                vertices_per_cell = 0, faces_per_cell = 0;
      std::vector<std::uint32_t>              corners;          ///< [own cell][vertex]
      std::vector<types::boundary_id>         boundaries;       ///< [own cell][face]; `on_cut` where it is none of the whole
      std::vector<types::material_id>         regions;          ///< [own cell]
      std::vector<std::uint32_t>              n_cells_at;       ///< [vertex]
      std::vector<std::uint32_t>              cells_at, owners; ///< all cells around the vertices, own ones among them, and their processes
      std::vector<std::vector<std::uint32_t>> curved_at;        ///< vertices around nodes of curved cells
      std::vector<std::array<double, dim>>    curved_points;    ///< these nodes

      template <typename Archive>
      void archive(Archive &archive)
      {
        for (auto *const names : {&part_names, &region_names, &warnings})
          archive_names(archive, *names);
        for (bool *const flag : {&approximates_curves, &simplex, &curved, &has_curved_cells})
          archive(*flag);
        archive(some_point);
        archive(vertices);
        archive(points);
        archive(cells);
        archive(vertices_per_cell);
        archive(faces_per_cell);
        archive(corners);
        archive(boundaries);
        archive(regions);
        archive(n_cells_at);
        archive(cells_at);
        archive(owners);
        std::size_t n = curved_at.size();
        archive(n);
        curved_at.resize(n);
        for (auto &around : curved_at)
          archive(around);
        archive(curved_points);
      }
    };

    template <int dim>
    std::array<double, dim> coordinates(const Point<dim> &x)
    {
      std::array<double, dim> result;
      for (unsigned d = 0; d < dim; ++d)
        result[d] = x[d];
      return result;
    }

    template <int dim>
    Point<dim> point_at(const std::array<double, dim> &coordinates)
    {
      Point<dim> x;
      for (unsigned d = 0; d < dim; ++d)
        x[d] = coordinates[d];
      return x;
    }

    /// Nodes of own cells that are no vertices.
    template <int dim>
    void take_curved_nodes(const CurvedCells<dim> &cells, const typename Triangulation<dim>::cell_iterator &cell, Message<dim> &message)
    {
      const auto  nodes = cells.nodes(cell);
      const auto &unit_nodes = cells.unit_nodes();
      for (unsigned i = 0; i < nodes.size(); ++i)
        if (const auto around = vertices_around<dim>(cell, unit_nodes[i]); around.size() > 1)
        {
          message.curved_at.emplace_back(around.begin(), around.end());
          message.curved_points.push_back(coordinates(nodes[i]));
        }
    }
  } // namespace

  template <int dim>
  bool can_be_sent(const Mesh<dim> &whole)
  {
    const auto ids = whole.triangulation->get_manifold_ids();
    return std::all_of(ids.begin(), ids.end(), [](const auto id) { return id == numbers::flat_manifold_id; }) &&
           !(whole.curved_cells && whole.curved_cells->follows_drawing());
  }

  template <int dim>
  std::vector<char> pack_part(const Mesh<dim>                          &whole,
                              const Division                           &division,
                              const std::vector<std::vector<unsigned>> &cells_at_vertex,
                              const unsigned                            rank)
  {
    const auto  &mesh = *whole.triangulation;
    Message<dim> message;
    message.part_names = whole.part_names;
    message.region_names = whole.region_names;
    message.warnings = whole.warnings;
    message.approximates_curves = whole.approximates_curves;
    message.simplex = whole.simplex;
    message.curved = whole.curved;
    message.has_curved_cells = bool(whole.curved_cells);
    message.some_point = coordinates(Point<dim>(mesh.begin_active()->center()));
    message.vertices_per_cell = mesh.begin_active()->n_vertices();
    message.faces_per_cell = mesh.begin_active()->n_faces();
    for (unsigned k = 0; k < division.owner.size(); ++k)
      if (division.owner[k] == rank)
      {
        const typename Triangulation<dim>::active_cell_iterator cell(&mesh, 0, k); // of a mesh that nobody has refined
        message.cells.push_back(k);
        message.regions.push_back(cell->material_id());
        for (const unsigned v : cell->vertex_indices())
        {
          message.corners.push_back(cell->vertex_index(v));
          message.vertices.push_back(cell->vertex_index(v));
        }
        for (const auto face : cell->face_indices())
          message.boundaries.push_back(cell->at_boundary(face) ? cell->face(face)->boundary_id() : on_cut);
        if (whole.curved_cells)
          take_curved_nodes<dim>(*whole.curved_cells, cell, message);
      }
    sort_unique(message.vertices);
    for (const auto vertex : message.vertices)
    {
      message.points.push_back(coordinates(mesh.get_vertices()[vertex]));
      const auto &cells = cells_at_vertex[vertex];
      message.n_cells_at.push_back(cells.size());
      for (const unsigned cell : cells)
      {
        message.cells_at.push_back(cell);
        message.owners.push_back(division.owner[cell]);
      }
    }
    ByteWriter writer;
    message.archive(writer);
    return std::move(writer.bytes);
  }

  namespace
  {
    template <int dim>
    void describe_surroundings(const Message<dim> &message, Subdomain<dim> &subdomain)
    {
      // Cells around are numbered as in the whole, without the gaps, so that lists of them stay in order.
      auto known = message.cells_at;
      sort_unique(known);
      const auto number_of = [&](const std::uint32_t cell)
      { return unsigned(std::lower_bound(known.begin(), known.end(), cell) - known.begin()); };
      subdomain.division.owner.resize(known.size());
      subdomain.cells_at_vertex.resize(message.vertices.size());
      std::size_t at = 0;
      for (unsigned v = 0; v < message.vertices.size(); ++v)
      {
        subdomain.number_of_vertex.emplace(message.vertices[v], v);
        for (std::uint32_t k = 0; k < message.n_cells_at[v]; ++k, ++at)
        {
          const unsigned number = number_of(message.cells_at[at]);
          subdomain.cells_at_vertex[v].push_back(number);
          subdomain.division.owner[number] = message.owners[at];
        }
      }
      for (const auto cell : message.cells)
        subdomain.own_cells.push_back(number_of(cell));
      subdomain.own_active_cells = subdomain.own_cells;
      subdomain.vertex = message.corners;
      subdomain.ids_of_vertices = message.vertices;
    }
  } // namespace

  template <int dim>
  ReceivedPart<dim> unpack_part(const std::vector<char> &bytes, const Processes &processes)
  {
    Message<dim> message;
    ByteReader   reader(bytes);
    message.archive(reader);

    ReceivedPart<dim> part;
    part.subdomain = std::make_unique<Subdomain<dim>>();
    auto &subdomain = *part.subdomain;
    subdomain.processes = processes;
    subdomain.some_point = point_at<dim>(message.some_point);
    subdomain.whole.simplex = message.simplex;
    describe_surroundings(message, subdomain);

    Mesh<dim> &mesh = part.mesh;
    mesh.part_names = std::move(message.part_names);
    const types::boundary_id cut = mesh.part_names.size();
    mesh.part_names.push_back("");
    mesh.region_names = std::move(message.region_names);
    mesh.warnings = std::move(message.warnings);
    mesh.approximates_curves = message.approximates_curves;
    mesh.simplex = message.simplex;
    mesh.curved = message.curved;

    std::vector<Point<dim>> points;
    for (const auto &x : message.points)
      points.push_back(point_at<dim>(x));
    const auto number_of = [&](const std::uint32_t vertex)
    { return unsigned(std::lower_bound(message.vertices.begin(), message.vertices.end(), vertex) - message.vertices.begin()); };
    std::vector<CellData<dim>> cells;
    for (std::size_t k = 0; k < message.cells.size(); ++k)
    {
      auto &cell = cells.emplace_back(message.vertices_per_cell);
      for (unsigned v = 0; v < message.vertices_per_cell; ++v)
        cell.vertices[v] = number_of(message.corners[k * message.vertices_per_cell + v]);
      cell.material_id = message.regions[k];
    }
    mesh.triangulation = std::make_unique<Triangulation<dim>>();
    mesh.triangulation->create_triangulation(points, cells, SubCellData());
    for (const auto &cell : mesh.triangulation->active_cell_iterators())
      for (const auto face : cell->face_indices())
        if (cell->at_boundary(face))
        {
          const auto id = message.boundaries[cell->active_cell_index() * message.faces_per_cell + face];
          cell->face(face)->set_boundary_id(id == on_cut ? cut : id);
        }
    if (message.has_curved_cells)
    {
      PointsByVertices<dim> nodes;
      for (std::size_t k = 0; k < message.curved_at.size(); ++k)
      {
        std::vector<unsigned> around;
        for (const auto vertex : message.curved_at[k])
          around.push_back(number_of(vertex));
        nodes.emplace(std::move(around), point_at<dim>(message.curved_points[k]));
      }
      mesh.curved_cells = std::make_shared<CurvedCells<dim>>(*mesh.triangulation, nodes);
    }
    return part;
  }

#define INSTANTIATE(dim)                                                                                                                   \
  template bool              can_be_sent(const Mesh<dim> &);                                                                               \
  template std::vector<char> pack_part(const Mesh<dim> &, const Division &, const std::vector<std::vector<unsigned>> &, unsigned);         \
  template ReceivedPart<dim> unpack_part(const std::vector<char> &, const Processes &);
  INSTANTIATE(2)
  INSTANTIATE(3)
#undef INSTANTIATE
} // namespace unilateral
