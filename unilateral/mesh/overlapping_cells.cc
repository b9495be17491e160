#include "unilateral/mesh/overlapping_cells.h"

#include "unilateral/mesh/box_tree.h"

#include <deal.II/base/tensor.h>

#include <algorithm>
#include <array>
#include <limits>
#include <numeric>

namespace unilateral
{
  using namespace dealii;

  namespace
  {
    template <int dim>
    class CellsInSpace
    {
    public:
      CellsInSpace(const std::vector<Point<dim>> &points, const CellTable &cells)
        : points(points), cells(cells), simplex(cells.reference.is_simplex()), n_corners(cells.n_corners()),
          faces(faces_of_reference_cell()), edges(edges_of_reference_cell())
      {
      }

      /// The centres of the two cells at a face lie on one side of it.
      bool on_one_side(const FaceOfCells &face) const
      {
        const auto [cell, other] = face.cells;
        const Corners corners_here = corners(cell, points[cells[cell][0]]), corners_there = corners(other, points[cells[cell][0]]);
        const auto &[v, n] = faces[face.number];
        const Tensor<1, dim> across = normal(corners_here[v[0]], corners_here[v[1]], corners_here[v[2]], corners_here[v[3]], n);
        Tensor<1, dim>       middle, here, there;
        for (unsigned k = 0; k < n; ++k)
          middle += corners_here[v[k]] / double(n);
        for (unsigned k = 0; k < n_corners; ++k)
        {
          here += corners_here[k] / double(n_corners);
          there += corners_there[k] / double(n_corners);
        }
        return (across * (here - middle)) * (across * (there - middle)) >= 0;
      }

      /// No direction shows a gap between the two, or an overlap of less than @p tolerance of the thinner one's extent.
      bool overlap(const unsigned a, const unsigned b, const double tolerance) const
      {
        // From a vertex of the first: far from the origin the products would lose their digits.
        const Point<dim> &origin = points[cells[a][0]];
        const Corners     corners_a = corners(a, origin), corners_b = corners(b, origin);
        const auto        parts = [&](const Tensor<1, dim> &axis)
        {
          if (axis.norm_square() == 0)
            return false;
          const auto [a_low, a_high] = extent(corners_a, axis);
          const auto [b_low, b_high] = extent(corners_b, axis);
          return std::min(a_high, b_high) - std::max(a_low, b_low) <= tolerance * std::min(a_high - a_low, b_high - b_low);
        };
        for (const Corners *const body : {&corners_a, &corners_b})
          for (const auto &[v, n] : faces)
            if (parts(normal((*body)[v[0]], (*body)[v[1]], (*body)[v[2]], (*body)[v[3]], n)))
              return false;
        if constexpr (dim == 3)
          for (const auto &[p, q] : edges)
            for (const auto &[r, s] : edges)
            {
              const Tensor<1, dim> u = corners_a[q] - corners_a[p], v = corners_b[s] - corners_b[r], axis = cross_product_3d(u, v);
              if (axis.norm_square() > 1e-12 * u.norm_square() * v.norm_square() && parts(axis))
                return false;
            }
        return true;
      }

      std::pair<Point<dim>, Point<dim>> box(const unsigned cell) const
      {
        Point<dim> lower = points[cells[cell][0]], upper = lower;
        for (const unsigned v : cells[cell])
          for (unsigned d = 0; d < dim; ++d)
          {
            lower[d] = std::min(lower[d], points[v][d]);
            upper[d] = std::max(upper[d], points[v][d]);
          }
        return {lower, upper};
      }

    private:
      using Corners = std::array<Tensor<1, dim>, 8>; ///< of a cell; as many as it has, the first ones

      Corners corners(const unsigned cell, const Point<dim> &origin) const
      {
        Corners result;
        for (unsigned v = 0; v < n_corners; ++v)
          result[v] = points[cells[cell][v]] - origin;
        return result;
      }

      std::pair<double, double> extent(const Corners &corners, const Tensor<1, dim> &axis) const
      {
        double low = std::numeric_limits<double>::max(), high = std::numeric_limits<double>::lowest();
        for (unsigned v = 0; v < n_corners; ++v)
        {
          const double x = axis * corners[v];
          low = std::min(low, x);
          high = std::max(high, x);
        }
        return {low, high};
      }

      /// Of a face with @p n corners.
      static Tensor<1, dim>
      normal(const Tensor<1, dim> &a, const Tensor<1, dim> &b, const Tensor<1, dim> &c, const Tensor<1, dim> &d, const unsigned n)
      {
        if constexpr (dim == 2)
          return cross_product_2d(b - a);
        else
          return n == 3 ? cross_product_3d(b - a, c - a) : cross_product_3d(d - a, c - b);
      }

      struct Face
      {
        std::array<unsigned, 4> corners = {0, 0, 0, 0};
        unsigned                n = 0;
      };

      std::vector<Face> faces_of_reference_cell() const
      {
        std::vector<Face> result;
        for (const auto &corners : corners_of_faces(cells.reference))
        {
          auto &face = result.emplace_back();
          face.n = corners.size();
          std::copy(corners.begin(), corners.end(), face.corners.begin());
        }
        return result;
      }

      std::vector<std::pair<unsigned, unsigned>> edges_of_reference_cell() const
      {
        std::vector<std::pair<unsigned, unsigned>> result;
        if (simplex)
        {
          for (unsigned i = 0; i < n_corners; ++i)
            for (unsigned j = 0; j < i; ++j)
              result.emplace_back(j, i);
          return result;
        }
        for (unsigned v = 0; v < n_corners; ++v)
          for (unsigned d = 0; d < dim; ++d)
            if (!(v >> d & 1))
              result.emplace_back(v, v | 1u << d);
        return result;
      }

      const std::vector<Point<dim>>                   &points;
      const CellTable                                 &cells;
      const bool                                       simplex;
      const unsigned                                   n_corners;
      const std::vector<Face>                          faces;
      const std::vector<std::pair<unsigned, unsigned>> edges;
    };

    using Pair = std::optional<std::pair<unsigned, unsigned>>;

    Pair overlapping_segments(const std::vector<Point<1>> &points, const CellTable &cells)
    {
      const auto end = [&](const unsigned cell, const bool upper)
      {
        const double a = points[cells[cell][0]][0], b = points[cells[cell][1]][0];
        return upper ? std::max(a, b) : std::min(a, b);
      };
      const auto            length = [&](const unsigned cell) { return end(cell, true) - end(cell, false); };
      std::vector<unsigned> order(cells.size());
      std::iota(order.begin(), order.end(), 0u);
      std::sort(order.begin(), order.end(), [&](const unsigned a, const unsigned b) { return end(a, false) < end(b, false); });
      // Of those so far the one that reaches farthest, which is the one before unless there was an overlap that is let pass.
      for (unsigned k = 1, before = order.empty() ? 0 : order[0]; k < order.size(); ++k)
      {
        const unsigned cell = order[k];
        if (end(before, true) - end(cell, false) > 1e-3 * std::min(length(before), length(cell)))
          return std::pair(std::min(before, cell), std::max(before, cell));
        if (end(cell, true) > end(before, true))
          before = cell;
      }
      return {};
    }

    /// Two cells on one side of a face that they share.
    template <int dim>
    Pair cells_on_one_side(const CellsInSpace<dim> &space, const std::vector<FaceOfCells> &faces)
    {
      for (const auto &face : faces)
        if (!face.at_boundary() && space.on_one_side(face))
          return std::pair(face.cells[0], face.cells[1]);
      return {};
    }

    /// A cell at the boundary, and one that it overlaps.
    template <int dim>
    Pair cells_over_the_boundary(const CellsInSpace<dim>        &space,
                                 const CellTable                &cells,
                                 const std::vector<FaceOfCells> &faces,
                                 const bool                      curved)
    {
      std::vector<char> at_boundary(cells.size(), false);
      for (const auto &face : faces)
        if (face.at_boundary())
          at_boundary[face.cells[0]] = true;
      std::vector<unsigned>                   cell_of_box;
      std::vector<typename BoxTree<dim>::Box> boxes;
      for (unsigned c = 0; c < cells.size(); ++c)
        if (at_boundary[c])
        {
          cell_of_box.push_back(c);
          boxes.push_back(space.box(c));
        }
      const BoxTree<dim> tree(boxes);
      const bool         neighbours_may_overlap = curved || (dim == 3 && cells.reference == ReferenceCells::Hexahedron);
      for (unsigned c = 0; c < cells.size(); ++c)
      {
        unsigned   other = 0;
        const auto overlaps = [&](const unsigned box)
        {
          other = cell_of_box[box];
          if (other == c || (at_boundary[c] && other < c)) // itself, or seen from the other one
            return false;
          const auto here = cells[c], there = cells[other];
          const bool neighbours = std::find_first_of(here.begin(), here.end(), there.begin(), there.end()) != here.end();
          return !(neighbours && neighbours_may_overlap) && space.overlap(c, other, curved ? 0.3 : neighbours ? 1e-3 : 0.05);
        };
        if (tree.any(space.box(c), overlaps))
          return std::pair(std::min(c, other), std::max(c, other));
      }
      return {};
    }
  } // namespace

  template <int dim>
  std::optional<std::pair<unsigned, unsigned>>
  overlapping_cells(const std::vector<Point<dim>> &points, const CellTable &cells, const std::vector<FaceOfCells> &faces, const bool curved)
  {
    if constexpr (dim == 1)
      return overlapping_segments(points, cells);
    else
    {
      const CellsInSpace<dim> space(points, cells);
      // The straight cells of curved ones, thin ones above all, can lie on the wrong side: whether curved cells are folded is looked at
      // where they are known.
      if (const Pair folded = curved ? Pair() : cells_on_one_side(space, faces))
        return folded;
      return cells_over_the_boundary(space, cells, faces, curved);
    }
  }

  template std::optional<std::pair<unsigned, unsigned>>
  overlapping_cells(const std::vector<Point<1>> &, const CellTable &, const std::vector<FaceOfCells> &, bool);
  template std::optional<std::pair<unsigned, unsigned>>
  overlapping_cells(const std::vector<Point<2>> &, const CellTable &, const std::vector<FaceOfCells> &, bool);
  template std::optional<std::pair<unsigned, unsigned>>
  overlapping_cells(const std::vector<Point<3>> &, const CellTable &, const std::vector<FaceOfCells> &, bool);
} // namespace unilateral
