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
    template <int dim, typename Archive>
    void archive(Archive &archive, PartDescription<dim> &part)
    {
      for (auto *const names : {&part.part_names, &part.region_names, &part.warnings})
        archive(*names);
      for (bool *const flag : {&part.approximates_curves, &part.simplex, &part.curved, &part.has_curved_cells})
        archive(*flag);
      archive(part.some_point);
      archive(part.vertices);
      archive(part.points);
      archive(part.cells);
      archive(part.vertices_per_cell);
      archive(part.faces_per_cell);
      archive(part.corners);
      archive(part.boundaries);
      archive(part.regions);
      archive(part.n_cells_at);
      archive(part.cells_at);
      archive(part.owners);
      std::size_t n = part.curved_at.size();
      archive(n);
      part.curved_at.resize(n);
      for (auto &around : part.curved_at)
        archive(around);
      archive(part.curved_points);
    }

    /// Nodes of own cells that are no vertices.
    template <int dim>
    void take_curved_nodes(const CurvedCells<dim>                           &cells,
                           const typename Triangulation<dim>::cell_iterator &cell,
                           const std::function<std::uint32_t(unsigned)>     &id_of,
                           PartDescription<dim>                             &message)
    {
      const auto  nodes = cells.nodes(cell);
      const auto &unit_nodes = cells.unit_nodes();
      for (unsigned i = 0; i < nodes.size(); ++i)
        if (const auto around = vertices_around<dim>(cell, unit_nodes[i]); around.size() > 1)
        {
          auto &ids = message.curved_at.emplace_back();
          for (const unsigned vertex : around)
            ids.push_back(id_of(vertex));
          message.curved_points.push_back(array_of(nodes[i]));
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
    const auto           id_of = [&](const unsigned vertex) { return vertex_ids.empty() ? vertex : vertex_ids[vertex]; };
    const auto          &triangulation = *mesh.triangulation;
    PartDescription<dim> message;
    message.part_names = mesh.part_names;
    if (cut != on_cut)
      message.part_names.pop_back();
    message.region_names = mesh.region_names;
    message.warnings = mesh.warnings;
    message.approximates_curves = mesh.approximates_curves;
    message.simplex = mesh.simplex;
    message.curved = mesh.curved;
    message.has_curved_cells = bool(mesh.curved_cells);
    message.some_point = array_of(some_point);
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
      message.points.push_back(array_of(triangulation.get_vertices()[vertex]));
      message.n_cells_at.push_back(cells_around[vertex].size());
      for (const CellAround &cell : cells_around[vertex])
      {
        message.cells_at.push_back(cell.id);
        message.owners.push_back(cell.owner);
      }
    }
    ByteWriter writer;
    archive(writer, message);
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
    PartDescription<dim> merge(std::vector<PartDescription<dim>> messages)
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
      PartDescription<dim> of_vertices;
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
      PartDescription<dim> all = std::move(messages.front());
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
  } // namespace

  template <int dim>
  ReceivedPart<dim> unpack_part(const std::vector<std::vector<char>> &bytes_of_each, const Processes &processes)
  {
    std::vector<PartDescription<dim>> messages;
    for (const auto &bytes : bytes_of_each)
      if (!bytes.empty())
      {
        ByteReader reader(bytes);
        archive(reader, messages.emplace_back());
      }
    return make_part(merge(std::move(messages)), processes);
  }

#define INSTANTIATE(dim)                                                                                                                   \
  template bool can_be_sent(const Mesh<dim> &);                                                                                            \
  template class PartsToSend<dim>;                                                                                                         \
  template ReceivedPart<dim> unpack_part(const std::vector<std::vector<char>> &, const Processes &);
  INSTANTIATE(2)
  INSTANTIATE(3)
#undef INSTANTIATE
} // namespace unilateral
