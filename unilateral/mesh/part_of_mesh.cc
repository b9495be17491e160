#include "unilateral/mesh/part_of_mesh.h"

#include "unilateral/base/byte_archive.h"
#include "unilateral/base/exchange_records.h"
#include "unilateral/base/number_of_name.h"
#include "unilateral/base/sort_unique.h"
#include "unilateral/mesh/cell_orientation.h"
#include "unilateral/mesh/cell_table.h"
#include "unilateral/mesh/faces_between_parts.h"
#include "unilateral/mesh/fit_at_boundary.h"
#include "unilateral/mesh/gmsh_order.h"
#include "unilateral/mesh/hanging_node.h"
#include "unilateral/mesh/names_of_boundary.h"
#include "unilateral/mesh/node_directory.h"
#include "unilateral/mesh/share_of_box.h"
#include "unilateral/mesh/share_of_file.h"
#include "unilateral/mesh/shared_bisection.h"

#include <deal.II/grid/grid_tools.h>

#include <boost/pending/disjoint_sets.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <exception>
#include <limits>
#include <unordered_map>
#include <utility>
#include <vector>

namespace unilateral
{
  using namespace dealii;

  namespace
  {
    /// Thrown by all processes at the same time.
    struct NotInParts
    {
    };

    struct CellAtVertex
    {
      std::uint32_t vertex, cell, owner;
    };

    template <int dim>
    class PartOfMesh
    {
    public:
      PartOfMesh(const ShareOfMesh &share, const Processes &processes) : processes(processes), share(share) {}

      ReceivedPart<dim> make(const PartsByPlace &parts, const bool simplices, const std::uint64_t least_cells)
      {
        index = agreed(share.index());
        agree(dimension(index.kind) == dim && is_simplex(index.kind) == simplices && index.n_cells >= least_cells &&
              index.n_cells < no_number);
        n_corners = index.corners_of_cell();
        {
          const NodeDirectory directory(agreed(share.nodes()), processes);
          agree(!directory.has_repeated_numbers());
          divide(agreed(share.cells()), directory);
          place_nodes(directory);
        }
        orient_cells();
        find_faces();
        check_boundary();
        describe();
        for (const auto &part : parts)
          name_part(part);
        return with_curved_cells();
      }

    private:
      void agree(const bool fine) const
      {
        if (processes.any(!fine))
          throw NotInParts();
      }

      /// What every process has.
      template <typename T>
      T agreed(std::optional<T> own) const
      {
        agree(own.has_value());
        return std::move(*own);
      }

      /// Sends the cells that were read to those who get them.
      void divide(CellsOfShare read, const NodeDirectory &directory)
      {
        const unsigned             n_nodes = index.nodes_of_cell();
        std::vector<std::uint64_t> tags;
        for (std::size_t k = 0; k < read.ids.size(); ++k)
          tags.insert(tags.end(), &read.nodes[k * n_nodes], &read.nodes[k * n_nodes] + n_corners);
        sort_unique(tags);
        bool       missing = false;
        const auto places = directory.places_of(tags, missing);
        agree(!missing);
        std::vector<Point<dim>> centers(read.ids.size());
        for (std::size_t k = 0; k < read.ids.size(); ++k)
          for (unsigned v = 0; v < n_corners; ++v)
          {
            const auto &x = places[std::lower_bound(tags.begin(), tags.end(), read.nodes[k * n_nodes + v]) - tags.begin()];
            for (unsigned d = 0; d < dim; ++d)
              centers[k][d] += x[d] / double(n_corners);
          }
        auto owner = share.owners(read.ids);
        if (!processes.any(!owner.empty()))
          owner = bisect_shared(centers, processes);
        std::vector<CellsOfShare> to_each(processes.size());
        for (std::size_t k = 0; k < read.ids.size(); ++k)
        {
          auto &cells_to = to_each[owner[k]];
          cells_to.ids.push_back(read.ids[k]);
          cells_to.regions.push_back(read.regions[k]);
          cells_to.nodes.insert(cells_to.nodes.end(), &read.nodes[k * n_nodes], &read.nodes[k * n_nodes] + n_nodes);
        }
        read = {};
        std::vector<std::vector<char>> bytes;
        for (auto &cells_to : to_each)
        {
          ByteWriter writer;
          cells_to.archive(writer);
          cells_to = {};
          bytes.push_back(std::move(writer.bytes));
        }
        for (const auto &received : processes.exchange(std::move(bytes)))
        {
          // Those who read have pieces one after the other, so cells come in the order of the file.
          CellsOfShare part;
          ByteReader   reader(received);
          part.archive(reader);
          cells.ids.insert(cells.ids.end(), part.ids.begin(), part.ids.end());
          cells.regions.insert(cells.regions.end(), part.regions.begin(), part.regions.end());
          cells.nodes.insert(cells.nodes.end(), part.nodes.begin(), part.nodes.end());
        }
        agree(!cells.ids.empty());
      }

      /// Vertices are the corners of own cells; of curved cells all nodes.
      void place_nodes(const NodeDirectory &directory)
      {
        auto tags = cells.nodes;
        sort_unique(tags);
        bool       missing = false;
        const auto places = directory.places_of(tags, missing);
        agree(!missing);
        check_plane(places);
        const unsigned n_nodes = index.nodes_of_cell();
        for (std::size_t k = 0; k < cells.ids.size(); ++k)
          vertices.insert(vertices.end(), &cells.nodes[k * n_nodes], &cells.nodes[k * n_nodes] + n_corners);
        sort_unique(vertices);
        const auto place_of = [&](const std::uint64_t tag)
        {
          const auto &x = places[std::lower_bound(tags.begin(), tags.end(), tag) - tags.begin()];
          Point<dim>  p;
          for (unsigned d = 0; d < dim; ++d)
            p[d] = x[d];
          return p;
        };
        for (const auto vertex : vertices)
          points.push_back(place_of(vertex));
        for (std::size_t k = 0; k < cells.ids.size(); ++k)
          for (unsigned i = n_corners; i < n_nodes; ++i)
            middle_points.push_back(place_of(cells.nodes[k * n_nodes + i]));
      }

      /// A mesh of triangles lies in a plane z = constant.
      void check_plane(const std::vector<std::array<double, 3>> &places) const
      {
        std::array<double, 3> lower, upper;
        double                size = 0;
        for (unsigned d = 0; d < 3; ++d)
        {
          lower[d] = std::numeric_limits<double>::max();
          upper[d] = std::numeric_limits<double>::lowest();
          for (const auto &x : places)
          {
            lower[d] = std::min(lower[d], x[d]);
            upper[d] = std::max(upper[d], x[d]);
          }
          lower[d] = processes.min(lower[d]);
          upper[d] = processes.max(upper[d]);
          size = std::max(size, upper[d] - lower[d]);
        }
        agree(dim == 3 || upper[2] - lower[2] <= 1e-9 * size);
      }

      unsigned number_of(const std::uint64_t vertex) const
      {
        return std::lower_bound(vertices.begin(), vertices.end(), vertex) - vertices.begin();
      }

      void orient_cells()
      {
        const bool simplices = is_simplex(index.kind);
        table.reference = simplices ? ReferenceCells::get_simplex<dim>() : ReferenceCells::get_hypercube<dim>();
        const unsigned        n_nodes = index.nodes_of_cell();
        std::vector<unsigned> cell(n_corners);
        bool                  fine = true;
        for (std::size_t k = 0; k < cells.ids.size(); ++k)
        {
          for (unsigned v = 0; v < n_corners; ++v)
            cell[corner_of_gmsh(index.kind, v)] = number_of(cells.nodes[k * n_nodes + v]);
          fine = fine && turn_to_positive_volume(cell, simplices, points);
          table.vertices.insert(table.vertices.end(), cell.begin(), cell.end());
        }
        agree(fine && (simplices || order_hypercubes()));
        corners_of_face = corners_of_faces(table.reference);
      }

      /// Lines and faces of neighbours in this part run alike, as deal.II wants them. False: they cannot.
      bool order_hypercubes()
      {
        std::vector<CellData<dim>> ordered(table.size(), CellData<dim>(n_corners));
        for (std::size_t k = 0; k < ordered.size(); ++k)
          std::copy(table[k].begin(), table[k].end(), ordered[k].vertices.begin());
        try
        {
          GridTools::consistently_order_cells(ordered);
        }
        catch (const std::exception &)
        {
          return false;
        }
        for (std::size_t k = 0; k < ordered.size(); ++k)
          std::copy(ordered[k].vertices.begin(), ordered[k].vertices.end(), &table.vertices[k * n_corners]);
        return true;
      }

      /// The side of a face, as the numbers of its vertices order them, on which its first cell lies. Curved cells may lie on the wrong one
      /// with their straight edges.
      int side_of(const FaceOfCells &face) const
      {
        if (index.order > 1)
          return 0;
        const auto                      cell = table[face.cells[0]];
        std::array<Tensor<1, dim>, dim> directions;
        Point<dim>                      middle;
        const auto                      of_face = vertices_of(face.vertices);
        for (const unsigned v : of_face)
          middle += points[v] / double(of_face.size());
        if (of_face.size() < 4)
          for (unsigned d = 0; d + 1 < dim; ++d)
            directions[d] = points[of_face[d + 1]] - points[of_face[0]];
        else // its diagonals, that of the first vertex before the other one
        {
          const auto                            &corners = corners_of_face[face.number];
          std::array<std::array<unsigned, 2>, 2> diagonals = {{{cell[corners[0]], cell[corners[3]]}, {cell[corners[1]], cell[corners[2]]}}};
          for (auto &diagonal : diagonals)
            std::sort(diagonal.begin(), diagonal.end());
          std::sort(diagonals.begin(), diagonals.end());
          for (unsigned d = 0; d < 2; ++d)
            directions[d] = points[diagonals[d][1]] - points[diagonals[d][0]];
        }
        directions[dim - 1] = -middle;
        for (const unsigned v : cell)
          directions[dim - 1] += points[v] / double(n_corners);
        Tensor<2, dim> volume;
        for (unsigned d = 0; d < dim; ++d)
          volume[d] = directions[d];
        return determinant(volume) > 0 ? 1 : -1;
      }

      void find_faces()
      {
        faces = faces_of(table);
        boost::disjoint_sets_with_storage<> sets(table.size());
        bool                                fine = true;
        for (const auto &face : faces)
        {
          fine = fine && face.n_cells <= 2;
          if (!face.at_boundary())
            sets.union_set(face.cells[0], face.cells[1]);
        }
        agree(fine);
        std::unordered_map<std::size_t, std::uint32_t> piece;
        for (std::size_t k = 0; k < table.size(); ++k)
          piece.try_emplace(sets.find_set(k), piece.size());
        std::vector<FaceOfPart> at_boundary;
        for (const auto &face : faces)
          if (face.at_boundary())
          {
            FaceOfPart of_part{{}, piece.at(sets.find_set(std::size_t(face.cells[0]))), side_of(face)};
            of_part.vertices.fill(no_number);
            const auto of_face = vertices_of(face.vertices);
            for (std::size_t v = 0; v < of_face.size(); ++v)
              of_part.vertices[v] = vertices[of_face[v]];
            at_boundary.push_back(of_part);
          }
        between = find_faces_between_parts(at_boundary, agreed(share.faces()), piece.size(), processes);
        agree(between.fit && between.hold_together);
      }

      /// Calls action(face, what it is) for each face of one own cell.
      template <typename Action>
      void for_faces_of_one_cell(const Action &action) const
      {
        auto what = between.faces.begin();
        for (const auto &face : faces)
          if (face.at_boundary())
            action(face, *what++);
      }

      void check_boundary() const { agree(fits_at_boundary(points, vertices, table, faces, between.faces, index.order > 1, processes)); }

      /// The cells around each vertex, those of all processes, by their ids.
      std::vector<std::vector<CellAtVertex>> cells_around() const
      {
        std::vector<std::vector<CellAtVertex>> result(vertices.size());
        for (std::size_t k = 0; k < table.size(); ++k)
          for (const unsigned v : table[k])
            result[v].push_back({std::uint32_t(vertices[v]), cells.ids[k], processes.rank()});
        // A vertex that others have, too, lies on a face of one own cell.
        std::vector<unsigned> maybe_shared;
        for_faces_of_one_cell(
          [&](const FaceOfCells &face, const auto &)
          {
            const auto of_face = vertices_of(face.vertices);
            maybe_shared.insert(maybe_shared.end(), of_face.begin(), of_face.end());
          });
        sort_unique(maybe_shared);
        std::vector<std::vector<CellAtVertex>> to_each(processes.size());
        for (const unsigned v : maybe_shared)
        {
          auto &to = to_each[vertices[v] % processes.size()];
          to.insert(to.end(), result[v].begin(), result[v].end());
        }
        std::vector<CellAtVertex> all;
        for (const auto &received : exchange_records(to_each, processes))
          all.insert(all.end(), received.begin(), received.end());
        std::sort(all.begin(), all.end(),
                  [](const CellAtVertex &a, const CellAtVertex &b)
                  { return a.vertex != b.vertex ? a.vertex < b.vertex : a.cell < b.cell; });
        to_each.assign(processes.size(), {});
        std::vector<std::uint32_t> owners;
        for (auto first = all.begin(), end = first; first != all.end(); first = end)
        {
          end = std::find_if(first, all.end(), [&](const CellAtVertex &cell) { return cell.vertex != first->vertex; });
          owners.clear();
          for (auto cell = first; cell != end; ++cell)
            owners.push_back(cell->owner);
          sort_unique(owners);
          if (owners.size() > 1)
            for (const auto owner : owners)
              to_each[owner].insert(to_each[owner].end(), first, end);
        }
        for (const auto &received : exchange_records(to_each, processes))
          for (const CellAtVertex &cell : received)
            if (cell.owner != processes.rank())
              result[number_of(cell.vertex)].push_back(cell);
        for (auto &around : result)
          std::sort(around.begin(), around.end(), [](const CellAtVertex &a, const CellAtVertex &b) { return a.cell < b.cell; });
        return result;
      }

      void describe()
      {
        description.region_names = index.region_names;
        name_faces();
        description.simplex = is_simplex(index.kind);
        Point<dim> center; // of the first cell of the file
        if (cells.ids.front() == 0)
          for (const unsigned v : table[0])
            center += points[v] / double(n_corners);
        for (unsigned d = 0; d < dim; ++d)
          description.some_point[d] = processes.sum(center[d]);
        description.vertices.assign(vertices.begin(), vertices.end());
        for (const auto &x : points)
          description.points.push_back(array_of(x));
        description.cells = cells.ids;
        description.vertices_per_cell = n_corners;
        description.faces_per_cell = corners_of_face.size();
        for (const unsigned v : table.vertices)
          description.corners.push_back(vertices[v]);
        description.regions.assign(cells.regions.begin(), cells.regions.end());
        for (const auto &around : cells_around())
        {
          description.n_cells_at.push_back(around.size());
          for (const CellAtVertex &cell : around)
          {
            description.cells_at.push_back(cell.cell);
            description.owners.push_back(cell.owner);
          }
        }
        if (index.order == 1)
          return;
        const unsigned n_nodes = index.nodes_of_cell();
        description.has_curved_cells = true;
        for (std::size_t k = 0; k < cells.ids.size(); ++k)
          for (const auto &corners : corners_around_middle_nodes(index.kind))
          {
            auto &around = description.curved_at.emplace_back();
            for (const unsigned corner : corners)
              around.push_back(cells.nodes[k * n_nodes + corner]);
            description.curved_points.push_back(array_of(middle_points[description.curved_points.size()]));
          }
      }

      void name_faces()
      {
        const std::size_t          n_names = index.part_names.size();
        std::vector<std::uint64_t> n_faces_of(n_names + 1, 0);
        for_faces_of_one_cell(
          [&](const FaceOfCells &, const auto &what)
          {
            if (!what.on_cut)
              ++n_faces_of[std::min<std::size_t>(what.name, n_names)];
          });
        processes.sum(n_faces_of.data(), n_faces_of.size());
        const auto        number = names_of_boundary(index.part_names, n_faces_of, description.part_names, description.warnings);
        const std::size_t n_faces = corners_of_face.size();
        description.boundaries.assign(table.size() * n_faces, on_cut);
        for_faces_of_one_cell(
          [&](const FaceOfCells &face, const auto &what)
          {
            if (!what.on_cut)
              description.boundaries[face.cells[0] * n_faces + face.number] = number[std::min<std::size_t>(what.name, n_names)];
          });
      }

      /// See name_parts().
      void name_part(const PartByPlace<FieldFunction> &part)
      {
        const dealii::types::boundary_id id = number_of_name(part.name, description.part_names);
        const std::size_t                n_faces = corners_of_face.size();
        std::array<std::uint64_t, 2>     n_belonging_and_cut{};
        bool                             has_values = true;
        for_faces_of_one_cell(
          [&](const FaceOfCells &face, const auto &what)
          {
            if (what.on_cut)
              return;
            std::vector<Point<dim>> corners;
            for (const unsigned v : vertices_of(face.vertices))
              corners.push_back(points[v]);
            PlaceOfFace place;
            try
            {
              place = place_of_face(corners, part.where);
            }
            catch (const std::exception &) // here alone
            {
              has_values = false;
            }
            n_belonging_and_cut[0] += place.belongs;
            n_belonging_and_cut[1] += place.cut;
            if (place.belongs)
              description.boundaries[face.cells[0] * n_faces + face.number] = id;
          });
        agree(has_values);
        processes.sum(n_belonging_and_cut.data(), n_belonging_and_cut.size());
        agree(n_belonging_and_cut[0] > 0 && n_belonging_and_cut[1] == 0);
      }

      ReceivedPart<dim> with_curved_cells()
      {
        ReceivedPart<dim> part;
        bool              fine = true;
        try
        {
          part = make_part(std::move(description), processes);
        }
        catch (const std::exception &) // cells that do not fit together
        {
          fine = false;
        }
        agree(fine);
        if (index.order > 1)
        {
          agree(part.mesh.curved_cells->folded_cells(*part.mesh.triangulation).empty());
          part.mesh.curved = processes.any(!part.mesh.curved_cells->straight());
          if (!part.mesh.curved)
            part.mesh.curved_cells.reset();
        }
        return part;
      }

      const Processes                    processes;
      const ShareOfMesh                 &share;
      MshIndex                           index;
      unsigned                           n_corners = 0;   ///< of a cell
      CellsOfShare                       cells;           ///< own ones
      std::vector<std::uint64_t>         vertices;        ///< of these, ascending: their numbers in the file
      std::vector<Point<dim>>            points;          ///< of these
      std::vector<Point<dim>>            middle_points;   ///< [own cell][node of order 2 that is no corner]
      CellTable                          table;           ///< own cells, by places in `vertices`
      std::vector<std::vector<unsigned>> corners_of_face; ///< of a cell
      std::vector<FaceOfCells>           faces;
      FacesBetweenParts                  between; ///< of those with one own cell
      PartDescription<dim>               description;
    };

    template <int dim>
    std::optional<ReceivedPart<dim>> part_of(const ShareOfMesh  &share,
                                             const PartsByPlace &parts,
                                             const bool          simplices,
                                             const Processes    &processes,
                                             const std::uint64_t least_cells)
    {
      try
      {
        return PartOfMesh<dim>(share, processes).make(parts, simplices, least_cells);
      }
      catch (const NotInParts &)
      {
        return std::nullopt;
      }
    }
  } // namespace

  template <int dim>
  std::optional<ReceivedPart<dim>> part_of_mesh(const MeshDescription &spec,
                                                const bool             simplices,
                                                const Processes       &processes,
                                                const std::uint64_t    least_cells,
                                                const PartsByPlace    &parts)
  {
    if (spec.source == MeshDescription::Source::box)
      return part_of<dim>(ShareOfBox<dim>(spec, simplices, processes), parts, simplices, processes, least_cells);
    return part_of<dim>(ShareOfFile(spec.file, processes), parts, simplices, processes, least_cells);
  }

  template std::optional<ReceivedPart<2>>
  part_of_mesh(const MeshDescription &, bool, const Processes &, std::uint64_t, const PartsByPlace &);
  template std::optional<ReceivedPart<3>>
  part_of_mesh(const MeshDescription &, bool, const Processes &, std::uint64_t, const PartsByPlace &);
} // namespace unilateral
