#include "unilateral/mesh/overlapping_cells.h"

#include <deal.II/base/tensor.h>
#include <deal.II/grid/reference_cell.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <numeric>
#include <unordered_map>

namespace unilateral
{
  using namespace dealii;

  namespace
  {
    template <int dim>
    class CellsInSpace
    {
    public:
      CellsInSpace(const std::vector<Point<dim>> &points, const std::vector<std::vector<unsigned>> &cells, const bool simplex)
        : points(points), cells(cells), simplex(simplex),
          reference(dim == 2 ? (simplex ? ReferenceCells::Triangle : ReferenceCells::Quadrilateral)
                             : (simplex ? ReferenceCells::Tetrahedron : ReferenceCells::Hexahedron)),
          n_corners(reference.n_vertices()), faces(faces_of_reference_cell()), edges(edges_of_reference_cell())
      {
      }

      unsigned n_faces() const { return faces.size(); }

      /// The vertices of a face in ascending order; the largest number where it has less than four.
      std::array<unsigned, 4> vertices_of_face(const unsigned cell, const unsigned f) const
      {
        std::array<unsigned, 4> vertices;
        vertices.fill(std::numeric_limits<unsigned>::max());
        for (unsigned v = 0; v < faces[f].n; ++v)
          vertices[v] = cells[cell][faces[f].corners[v]];
        std::sort(vertices.begin(), vertices.end());
        return vertices;
      }

      /// The centres of the two cells lie on one side of this face of the first.
      bool on_one_side(const unsigned cell, const unsigned f, const unsigned other) const
      {
        const Corners corners_here = corners(cell, points[cells[cell][0]]), corners_there = corners(other, points[cells[cell][0]]);
        const auto &[v, n] = faces[f];
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

      /// By vertex, the sum of the angles of the simplices there: 2 pi or 4 pi where they cover a neighbourhood once. The solid angle: A.
      /// van Oosterom, J. Strackee, IEEE Trans. Biomed. Eng. 30 (1983) 125-126.
      std::vector<double> angles_around_vertices() const
      {
        std::vector<double> angles(points.size(), 0.);
        for (const auto &cell : cells)
          for (unsigned v = 0; v < n_corners; ++v)
          {
            std::array<Tensor<1, dim>, dim> to;
            for (unsigned k = 0; k < dim; ++k)
            {
              to[k] = points[cell[(v + k + 1) % n_corners]] - points[cell[v]];
              to[k] /= to[k].norm();
            }
            if constexpr (dim == 2)
              angles[cell[v]] += std::acos(std::clamp(to[0] * to[1], -1., 1.));
            else
              angles[cell[v]] +=
                2 * std::atan2(std::abs(to[0] * cross_product_3d(to[1], to[2])), 1 + to[0] * to[1] + to[1] * to[2] + to[2] * to[0]);
          }
        return angles;
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
        std::vector<Face> result(reference.n_faces());
        for (unsigned f = 0; f < result.size(); ++f)
          for (const unsigned v : reference.face_reference_cell(f).vertex_indices())
            result[f].corners[result[f].n++] = reference.face_to_cell_vertices(f, v, 1);
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
      const std::vector<std::vector<unsigned>>        &cells;
      const bool                                       simplex;
      const ReferenceCell                              reference;
      const unsigned                                   n_corners;
      const std::vector<Face>                          faces;
      const std::vector<std::pair<unsigned, unsigned>> edges;
    };

    /// Pairs of boxes that meet, by a binary tree of boxes around boxes.
    template <int dim>
    class BoxTree
    {
    public:
      using Box = std::pair<Point<dim>, Point<dim>>;

      explicit BoxTree(const std::vector<Box> &boxes) : boxes(boxes), order(boxes.size())
      {
        std::iota(order.begin(), order.end(), 0u);
        if (!boxes.empty())
          build(0, boxes.size());
        for (const unsigned k : order)
          in_order.push_back(boxes[k]);
      }

      /// All boxes, those next to each other in space one after the other.
      const std::vector<unsigned> &ordered() const { return order; }

      /// Calls @p visit with every box that meets @p box until it returns true; returns whether it did.
      template <typename Visit>
      bool any(const Box &box, const Visit &visit) const
      {
        std::vector<std::size_t> open = {0};
        while (!open.empty())
        {
          const Node &node = nodes[open.back()];
          open.pop_back();
          if (!meet(node.box, box))
            continue;
          if (node.left == 0)
          {
            for (std::size_t k = node.begin; k < node.end; ++k)
              if (meet(in_order[k], box) && visit(order[k]))
                return true;
            continue;
          }
          open.push_back(node.left);
          open.push_back(node.right);
        }
        return false;
      }

    private:
      struct Node
      {
        Box         box;
        std::size_t begin = 0, end = 0;
        std::size_t left = 0, right = 0; ///< 0: a leaf
      };

      static bool meet(const Box &a, const Box &b)
      {
        for (unsigned d = 0; d < dim; ++d)
          if (a.second[d] < b.first[d] || b.second[d] < a.first[d])
            return false;
        return true;
      }

      std::size_t build(const std::size_t begin, const std::size_t end)
      {
        Node node{boxes[order[begin]], begin, end, 0, 0};
        for (std::size_t k = begin; k < end; ++k)
          for (unsigned d = 0; d < dim; ++d)
          {
            node.box.first[d] = std::min(node.box.first[d], boxes[order[k]].first[d]);
            node.box.second[d] = std::max(node.box.second[d], boxes[order[k]].second[d]);
          }
        const std::size_t index = nodes.size();
        nodes.push_back(node);
        if (end - begin <= 8)
          return index;
        unsigned widest = 0;
        for (unsigned d = 1; d < dim; ++d)
          if (node.box.second[d] - node.box.first[d] > node.box.second[widest] - node.box.first[widest])
            widest = d;
        const std::size_t middle = begin + (end - begin) / 2;
        std::nth_element(order.begin() + begin, order.begin() + middle, order.begin() + end,
                         [&](const unsigned a, const unsigned b)
                         { return boxes[a].first[widest] + boxes[a].second[widest] < boxes[b].first[widest] + boxes[b].second[widest]; });
        const std::size_t left = build(begin, middle), right = build(middle, end);
        nodes[index].left = left;
        nodes[index].right = right;
        return index;
      }

      const std::vector<Box> &boxes;
      std::vector<unsigned>   order;
      std::vector<Box>        in_order;
      std::vector<Node>       nodes;
    };

    struct HashOfFace
    {
      std::size_t operator()(const std::array<unsigned, 4> &face) const
      {
        std::size_t hash = 0;
        for (const unsigned v : face)
          hash = hash * 1000003u + v;
        return hash;
      }
    };

    using Pair = std::optional<std::pair<unsigned, unsigned>>;

    Pair overlapping_segments(const std::vector<Point<1>> &points, const std::vector<std::vector<unsigned>> &cells)
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

    constexpr unsigned none = std::numeric_limits<unsigned>::max();

    /// The cells at each face: one or two.
    struct Sides
    {
      unsigned first, second = none;
    };
    using SidesOfFaces = std::unordered_map<std::array<unsigned, 4>, Sides, HashOfFace>;

    /// Fills @p sides until two cells on one side of a face are found.
    template <int dim>
    Pair cells_on_one_side(const CellsInSpace<dim> &space, const unsigned n_cells, const bool curved, SidesOfFaces &sides)
    {
      sides.reserve(n_cells * space.n_faces() / 2);
      for (unsigned c = 0; c < n_cells; ++c)
        for (unsigned f = 0; f < space.n_faces(); ++f)
        {
          const auto [at, is_new] = sides.try_emplace(space.vertices_of_face(c, f), Sides{c});
          if (is_new)
            continue;
          auto &[first, second] = at->second;
          if (second != none)
            return std::pair(second, c);
          second = c;
          // The straight cells of curved ones, thin ones above all, can lie on the wrong side: whether curved cells are folded is looked
          // at where they are known.
          if (!curved && space.on_one_side(c, f, first))
            return std::pair(first, c);
        }
      return {};
    }

    /// Around an inner vertex of simplices that lie on either side of their faces, the cells cover all directions equally often: once,
    /// where their angles add up to the full one. By vertex.
    template <int dim>
    std::vector<char> directions_covered_once(const CellsInSpace<dim> &space, const SidesOfFaces &sides)
    {
      const std::vector<double> angles = space.angles_around_vertices();
      std::vector<char>         once(angles.size());
      for (std::size_t v = 0; v < angles.size(); ++v)
        once[v] = angles[v] < 1.5 * (dim == 2 ? 2 : 4) * std::numbers::pi;
      for (const auto &[face, cells_at] : sides)
        for (const unsigned v : face)
          if (cells_at.second == none && v != none)
            once[v] = false;
      return once;
    }
  } // namespace

  template <int dim>
  std::optional<std::pair<unsigned, unsigned>> overlapping_cells(const std::vector<Point<dim>>            &points,
                                                                 const std::vector<std::vector<unsigned>> &cells,
                                                                 const bool                                simplex,
                                                                 const bool                                curved)
  {
    if constexpr (dim == 1)
      return overlapping_segments(points, cells);
    else
    {
      const CellsInSpace<dim> space(points, cells, simplex);
      SidesOfFaces            sides;
      if (const Pair folded = cells_on_one_side(space, cells.size(), curved, sides))
        return folded;
      const auto covered_once = simplex && !curved ? directions_covered_once(space, sides) : std::vector<char>(points.size(), false);

      std::vector<std::pair<Point<dim>, Point<dim>>> boxes;
      for (unsigned c = 0; c < cells.size(); ++c)
        boxes.push_back(space.box(c));
      const BoxTree<dim> tree(boxes);
      for (const unsigned c : tree.ordered())
      {
        unsigned   other = 0;
        const auto overlaps = [&](const unsigned candidate)
        {
          other = candidate;
          if (candidate <= c)
            return false;
          bool neighbours = false;
          for (const unsigned v : cells[c])
            if (std::find(cells[candidate].begin(), cells[candidate].end(), v) != cells[candidate].end())
            {
              neighbours = true;
              if (covered_once[v])
                return false;
            }
          if (neighbours && (curved || (dim == 3 && !simplex)))
            return false;
          return space.overlap(c, candidate, curved ? 0.3 : neighbours ? 1e-3 : 0.05);
        };
        if (tree.any(boxes[c], overlaps))
          return std::pair(c, other);
      }
    }
    return {};
  }

  template std::optional<std::pair<unsigned, unsigned>>
  overlapping_cells(const std::vector<Point<1>> &, const std::vector<std::vector<unsigned>> &, bool, bool);
  template std::optional<std::pair<unsigned, unsigned>>
  overlapping_cells(const std::vector<Point<2>> &, const std::vector<std::vector<unsigned>> &, bool, bool);
  template std::optional<std::pair<unsigned, unsigned>>
  overlapping_cells(const std::vector<Point<3>> &, const std::vector<std::vector<unsigned>> &, bool, bool);
} // namespace unilateral
