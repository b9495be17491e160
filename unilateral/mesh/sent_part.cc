#include "unilateral/mesh/sent_part.h"

#include "unilateral/base/byte_archive.h"
#include "unilateral/base/sort_unique.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <functional>
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
    void take_curved_nodes(const CurvedCells<dim>                           &cells,
                           const typename Triangulation<dim>::cell_iterator &cell,
                           const std::function<std::uint32_t(unsigned)>     &id_of,
                           Message<dim>                                     &message)
    {
      const auto  nodes = cells.nodes(cell);
      const auto &unit_nodes = cells.unit_nodes();
      for (unsigned i = 0; i < nodes.size(); ++i)
        if (const auto around = vertices_around<dim>(cell, unit_nodes[i]); around.size() > 1)
        {
          auto &ids = message.curved_at.emplace_back();
          for (const unsigned vertex : around)
            ids.push_back(id_of(vertex));
          message.curved_points.push_back(coordinates(nodes[i]));
        }
    }
  } // namespace

  template <int dim>
  bool can_be_sent(const Mesh<dim> &mesh)
  {
    const auto ids = mesh.triangulation->get_manifold_ids();
    return std::all_of(ids.begin(), ids.end(), [](const auto id) { return id == numbers::flat_manifold_id; }) &&
           !(mesh.curved_cells && mesh.curved_cells->follows_drawing());
  }

  template <int dim>
  PartsToSend<dim>::PartsToSend(const Mesh<dim> &whole, const Division &division)
    : mesh(whole), cut(on_cut), owner(division.owner), some_point(whole.triangulation->begin_active()->center())
  {
    const auto cells_at_vertex = find_cells_at_vertices(*whole.triangulation, division.base_level);
    for (const auto &cells_here : cells_at_vertex)
    {
      auto &around = cells_around.emplace_back();
      for (const unsigned cell : cells_here)
        around.push_back({cell, owner[cell]});
    }
    sort_by_owner();
  }

  template <int dim>
  PartsToSend<dim>::PartsToSend(const Mesh<dim>      &part,
                                const Subdomain<dim> &subdomain,
                                const std::uint64_t   first_cell,
                                std::vector<unsigned> owner_of_cell,
                                const NeighborParts  &neighbors)
    : mesh(part), cut(part.part_names.size() - 1), first_cell(first_cell), owner(std::move(owner_of_cell)),
      vertex_ids(neighbors.vertex_ids), some_point(subdomain.some_point)
  {
    const auto cells_at_vertex = find_cells_at_vertices(*part.triangulation, 0);
    for (const auto &cells_here : cells_at_vertex)
    {
      auto &around = cells_around.emplace_back();
      for (const unsigned cell : cells_here)
        around.push_back({std::uint32_t(first_cell + cell), owner[cell]});
    }
    for (const auto &[vertex, cell] : neighbors.cells)
      cells_around[vertex].push_back({std::uint32_t(cell.id), cell.owner});
    for (auto &around : cells_around)
      std::sort(around.begin(), around.end(), [](const CellAround &a, const CellAround &b) { return a.id < b.id; });
    sort_by_owner();
  }

  template <int dim>
  void PartsToSend<dim>::sort_by_owner()
  {
    for (unsigned cell = 0; cell < owner.size(); ++cell)
    {
      if (owner[cell] >= cells.size())
        cells.resize(owner[cell] + 1);
      cells[owner[cell]].push_back(cell);
    }
  }

  template <int dim>
  const std::vector<unsigned> &PartsToSend<dim>::cells_for(const unsigned rank) const
  {
    static const std::vector<unsigned> none;
    return rank < cells.size() ? cells[rank] : none;
  }

  template <int dim>
  std::vector<char> PartsToSend<dim>::bytes_for(const unsigned rank) const
  {
    if (cells_for(rank).empty())
      return {};
    const auto   id_of = [&](const unsigned vertex) { return vertex_ids.empty() ? vertex : vertex_ids[vertex]; };
    const auto  &triangulation = *mesh.triangulation;
    Message<dim> message;
    message.part_names = mesh.part_names;
    if (cut != on_cut)
      message.part_names.pop_back();
    message.region_names = mesh.region_names;
    message.warnings = mesh.warnings;
    message.approximates_curves = mesh.approximates_curves;
    message.simplex = mesh.simplex;
    message.curved = mesh.curved;
    message.has_curved_cells = bool(mesh.curved_cells);
    message.some_point = coordinates(some_point);
    message.vertices_per_cell = triangulation.begin_active()->n_vertices();
    message.faces_per_cell = triangulation.begin_active()->n_faces();
    std::vector<std::pair<std::uint32_t, unsigned>> vertices; // id, number
    for (const unsigned k : cells_for(rank))
    {
      const typename Triangulation<dim>::active_cell_iterator cell(&triangulation, 0, k);
      message.cells.push_back(first_cell + k);
      message.regions.push_back(cell->material_id());
      for (const unsigned v : cell->vertex_indices())
      {
        message.corners.push_back(id_of(cell->vertex_index(v)));
        vertices.emplace_back(message.corners.back(), cell->vertex_index(v));
      }
      for (const auto face : cell->face_indices())
      {
        const auto id = cell->at_boundary(face) ? cell->face(face)->boundary_id() : on_cut;
        message.boundaries.push_back(id == cut ? on_cut : id);
      }
      if (mesh.curved_cells)
        take_curved_nodes<dim>(*mesh.curved_cells, cell, id_of, message);
    }
    sort_unique(vertices);
    for (const auto &[id, vertex] : vertices)
    {
      message.vertices.push_back(id);
      message.points.push_back(coordinates(triangulation.get_vertices()[vertex]));
      message.n_cells_at.push_back(cells_around[vertex].size());
      for (const CellAround &cell : cells_around[vertex])
      {
        message.cells_at.push_back(cell.id);
        message.owners.push_back(cell.owner);
      }
    }
    ByteWriter writer;
    message.archive(writer);
    return std::move(writer.bytes);
  }

  namespace
  {
    template <typename T>
    void append(std::vector<T> &to, const std::vector<T> &more)
    {
      to.insert(to.end(), more.begin(), more.end());
    }

    /// A vertex that several send is the same for all of them.
    template <int dim>
    Message<dim> merge(std::vector<Message<dim>> messages)
    {
      if (messages.size() == 1)
        return std::move(messages.front());
      struct Vertex
      {
        std::uint32_t id;
        std::size_t   message, place, first_cell; ///< where it stands, and its first entry in cells_at
      };
      std::vector<Vertex> vertices;
      for (std::size_t m = 0; m < messages.size(); ++m)
      {
        std::size_t first_cell = 0;
        for (std::size_t k = 0; k < messages[m].vertices.size(); ++k)
        {
          vertices.push_back({messages[m].vertices[k], m, k, first_cell});
          first_cell += messages[m].n_cells_at[k];
        }
      }
      std::stable_sort(vertices.begin(), vertices.end(), [](const Vertex &a, const Vertex &b) { return a.id < b.id; });
      Message<dim> of_vertices;
      for (const Vertex &vertex : vertices)
        if (of_vertices.vertices.empty() || of_vertices.vertices.back() != vertex.id)
        {
          const auto         &from = messages[vertex.message];
          const std::uint32_t n = from.n_cells_at[vertex.place];
          of_vertices.vertices.push_back(vertex.id);
          of_vertices.points.push_back(from.points[vertex.place]);
          of_vertices.n_cells_at.push_back(n);
          const auto append_entries = [&](auto &to, const auto &entries)
          { to.insert(to.end(), entries.begin() + vertex.first_cell, entries.begin() + vertex.first_cell + n); };
          append_entries(of_vertices.cells_at, from.cells_at);
          append_entries(of_vertices.owners, from.owners);
        }
      Message<dim> all = std::move(messages.front());
      for (std::size_t m = 1; m < messages.size(); ++m)
      {
        append(all.cells, messages[m].cells);
        append(all.corners, messages[m].corners);
        append(all.boundaries, messages[m].boundaries);
        append(all.regions, messages[m].regions);
        append(all.curved_at, messages[m].curved_at);
        append(all.curved_points, messages[m].curved_points);
      }
      all.vertices = std::move(of_vertices.vertices);
      all.points = std::move(of_vertices.points);
      all.n_cells_at = std::move(of_vertices.n_cells_at);
      all.cells_at = std::move(of_vertices.cells_at);
      all.owners = std::move(of_vertices.owners);
      return all;
    }

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
      subdomain.ids_of_cells = message.cells;
      subdomain.own_active_cells = subdomain.own_cells;
      subdomain.vertex = message.corners;
      subdomain.ids_of_vertices = message.vertices;
    }
  } // namespace

  template <int dim>
  ReceivedPart<dim> unpack_part(const std::vector<std::vector<char>> &bytes_of_each, const Processes &processes)
  {
    std::vector<Message<dim>> messages;
    for (const auto &bytes : bytes_of_each)
      if (!bytes.empty())
      {
        ByteReader reader(bytes);
        messages.emplace_back().archive(reader);
      }
    Message<dim> message = merge(std::move(messages));

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
        std::sort(around.begin(), around.end());
        nodes.emplace(std::move(around), point_at<dim>(message.curved_points[k]));
      }
      mesh.curved_cells = std::make_shared<CurvedCells<dim>>(*mesh.triangulation, nodes);
    }
    return part;
  }

#define INSTANTIATE(dim)                                                                                                                   \
  template bool can_be_sent(const Mesh<dim> &);                                                                                            \
  template class PartsToSend<dim>;                                                                                                         \
  template ReceivedPart<dim> unpack_part(const std::vector<std::vector<char>> &, const Processes &);
  INSTANTIATE(2)
  INSTANTIATE(3)
#undef INSTANTIATE
} // namespace unilateral
