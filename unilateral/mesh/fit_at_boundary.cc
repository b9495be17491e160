#include "unilateral/mesh/fit_at_boundary.h"

#include "unilateral/base/exchange_records.h"
#include "unilateral/mesh/hanging_node.h"
#include "unilateral/mesh/overlapping_cells.h"
#include "unilateral/mesh/part_description.h"

#include <algorithm>
#include <array>
#include <limits>
#include <unordered_map>

namespace unilateral
{
  using namespace dealii;

  namespace
  {
    /// A cell with faces on the boundary, as other processes get it.
    template <int dim>
    struct CellAtBoundary
    {
      static constexpr unsigned most_corners = 1u << dim;

      std::array<std::uint32_t, most_corners>           ids{};
      std::array<std::array<double, dim>, most_corners> points{};
      std::uint32_t                                     faces; ///< a bit for each on the boundary
    };

    /// The lower corner, then the upper one.
    template <int dim>
    using CornersOfBox = std::array<double, 2 * dim>;

    template <int dim, typename Vertices>
    CornersOfBox<dim> box_around(const Vertices &vertices, const std::vector<Point<dim>> &points)
    {
      CornersOfBox<dim> box;
      for (unsigned d = 0; d < dim; ++d)
      {
        box[d] = std::numeric_limits<double>::max();
        box[dim + d] = std::numeric_limits<double>::lowest();
      }
      for (const unsigned v : vertices)
        for (unsigned d = 0; d < dim; ++d)
        {
          box[d] = std::min(box[d], points[v][d]);
          box[dim + d] = std::max(box[dim + d], points[v][d]);
        }
      return box;
    }

    template <int dim>
    bool meet(const CornersOfBox<dim> &a, const CornersOfBox<dim> &b)
    {
      for (unsigned d = 0; d < dim; ++d)
        if (a[d] > b[dim + d] || a[dim + d] < b[d])
          return false;
      return true;
    }

    /// Around the own cells, and a little more, for vertices that hang.
    template <int dim>
    CornersOfBox<dim> box_of_part(const CellTable &cells, const std::vector<Point<dim>> &points)
    {
      auto   box = box_around<dim>(cells.vertices, points);
      double size = 0;
      for (unsigned d = 0; d < dim; ++d)
        size = std::max(size, box[dim + d] - box[d]);
      for (unsigned d = 0; d < dim; ++d)
      {
        box[d] -= 1e-6 * size;
        box[dim + d] += 1e-6 * size;
      }
      return box;
    }

    /// Those of other processes that may touch own cells. @p on_boundary: by own cell a bit for each face.
    template <int dim>
    std::vector<CellAtBoundary<dim>> cells_of_others(const std::vector<Point<dim>>    &points,
                                                     const std::vector<std::uint64_t> &ids,
                                                     const CellTable                  &cells,
                                                     const std::vector<std::uint32_t> &on_boundary,
                                                     const Processes                  &processes)
    {
      const auto boxes = processes.gather(std::vector<CornersOfBox<dim>>{box_of_part<dim>(cells, points)});
      std::vector<std::vector<CellAtBoundary<dim>>> to_each(processes.size());
      for (std::size_t k = 0; k < cells.size(); ++k)
      {
        if (on_boundary[k] == 0)
          continue;
        CellAtBoundary<dim> cell;
        cell.faces = on_boundary[k];
        for (unsigned v = 0; v < cells.n_corners(); ++v)
        {
          cell.ids[v] = ids[cells[k][v]];
          cell.points[v] = array_of(points[cells[k][v]]);
        }
        const auto box = box_around<dim>(cells[k], points);
        for (unsigned rank = 0; rank < processes.size(); ++rank)
          if (rank != processes.rank() && meet<dim>(box, boxes[rank]))
            to_each[rank].push_back(cell);
      }
      std::vector<CellAtBoundary<dim>> result;
      for (const auto &received : exchange_records(to_each, processes))
        result.insert(result.end(), received.begin(), received.end());
      return result;
    }

    /// Own cells, and behind them those of others.
    template <int dim>
    struct CellsTogether
    {
      std::vector<Point<dim>>     points;
      CellTable                   cells;
      std::vector<FaceOfCells>    faces;    ///< all but those on cuts
      std::vector<VerticesOfFace> boundary; ///< of these those on the boundary

      void add_boundary_face(const FaceOfCells &face)
      {
        faces.push_back(face);
        boundary.push_back(face.vertices);
      }
    };

    template <int dim>
    void add(const std::vector<CellAtBoundary<dim>> &others, const std::vector<std::uint64_t> &own_ids, CellsTogether<dim> &all)
    {
      std::unordered_map<std::uint32_t, unsigned> number_of_other;
      const auto                                  corners_of_face = corners_of_faces(all.cells.reference);
      for (const auto &cell : others)
      {
        std::vector<unsigned> numbers(all.cells.n_corners());
        for (unsigned v = 0; v < numbers.size(); ++v)
        {
          const auto own = std::lower_bound(own_ids.begin(), own_ids.end(), cell.ids[v]);
          if (own != own_ids.end() && *own == cell.ids[v])
          {
            numbers[v] = own - own_ids.begin();
            continue;
          }
          const auto [entry, is_new] = number_of_other.try_emplace(cell.ids[v], all.points.size());
          numbers[v] = entry->second;
          if (is_new)
            all.points.push_back(point_at<dim>(cell.points[v]));
        }
        for (unsigned f = 0; f < corners_of_face.size(); ++f)
          if (cell.faces >> f & 1)
          {
            FaceOfCells face{{}, {unsigned(all.cells.size()), no_number}, f, 1};
            face.vertices.fill(no_number);
            for (std::size_t v = 0; v < corners_of_face[f].size(); ++v)
              face.vertices[v] = numbers[corners_of_face[f][v]];
            std::sort(face.vertices.begin(), face.vertices.end());
            all.add_boundary_face(face);
          }
        all.cells.vertices.insert(all.cells.vertices.end(), numbers.begin(), numbers.end());
      }
    }
  } // namespace

  template <int dim>
  bool fits_at_boundary(const std::vector<Point<dim>>              &points,
                        const std::vector<std::uint64_t>           &ids,
                        const CellTable                            &cells,
                        const std::vector<FaceOfCells>             &faces,
                        const std::vector<FacesBetweenParts::Face> &kinds,
                        const bool                                  curved,
                        const Processes                            &processes)
  {
    CellsTogether<dim>         all{points, cells, {}, {}};
    std::vector<std::uint32_t> on_boundary(cells.size(), 0);
    auto                       kind = kinds.begin();
    for (const auto &face : faces)
      if (!face.at_boundary())
        all.faces.push_back(face);
      else if (!kind++->on_cut)
      {
        all.add_boundary_face(face);
        on_boundary[face.cells[0]] |= 1u << face.number;
      }
    add(cells_of_others<dim>(points, ids, cells, on_boundary, processes), ids, all);
    return !processes.any(hanging_node(all.boundary, all.points) || overlapping_cells(all.points, all.cells, all.faces, curved));
  }

#define INSTANTIATE(dim)                                                                                                                   \
  template bool fits_at_boundary(const std::vector<Point<dim>> &, const std::vector<std::uint64_t> &, const CellTable &,                   \
                                 const std::vector<FaceOfCells> &, const std::vector<FacesBetweenParts::Face> &, bool, const Processes &);
  INSTANTIATE(2)
  INSTANTIATE(3)
#undef INSTANTIATE
} // namespace unilateral
