#include "unilateral/mesh/overlapping_cells.h"

#include <deal.II/base/tensor.h>
#include <deal.II/grid/reference_cell.h>

#include <algorithm>
#include <array>
#include <limits>
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
                             : (simplex ? ReferenceCells::Tetrahedron : ReferenceCells::Hexahedron))
      {
      }

      std::vector<unsigned> face(const unsigned cell, const unsigned f) const
      {
        std::vector<unsigned> vertices;
        for (const unsigned v : reference.face_reference_cell(f).vertex_indices())
          vertices.push_back(cells[cell][reference.face_to_cell_vertices(f, v, 1)]);
        return vertices;
      }

      unsigned n_faces() const { return reference.n_faces(); }

      Tensor<1, dim> normal(const std::vector<unsigned> &face) const
      {
        const Tensor<1, dim> first = points[face[1]] - points[face[0]];
        if constexpr (dim == 2)
          return cross_product_2d(first);
        else
          return face.size() == 3 ? cross_product_3d(first, points[face[2]] - points[face[0]])
                                  : cross_product_3d(points[face[3]] - points[face[0]], points[face[2]] - points[face[1]]);
      }

      Point<dim> centre(const std::vector<unsigned> &vertices) const
      {
        Point<dim> sum;
        for (const unsigned v : vertices)
          sum += points[v];
        return sum / double(vertices.size());
      }

      bool share_a_vertex(const unsigned a, const unsigned b) const
      {
        return std::find_first_of(cells[a].begin(), cells[a].end(), cells[b].begin(), cells[b].end()) != cells[a].end();
      }

      /// No direction shows a gap between the two, or an overlap of less than @p tolerance of the thinner one's extent.
      bool overlap(const unsigned a, const unsigned b, const double tolerance) const
      {
        const auto parts = [&](const Tensor<1, dim> &axis)
        {
          if (axis.norm_square() == 0)
            return false;
          const auto [a_low, a_high] = extent(a, axis);
          const auto [b_low, b_high] = extent(b, axis);
          return std::min(a_high, b_high) - std::max(a_low, b_low) <= tolerance * std::min(a_high - a_low, b_high - b_low);
        };
        for (const unsigned cell : {a, b})
          for (unsigned f = 0; f < n_faces(); ++f)
            if (parts(normal(face(cell, f))))
              return false;
        if constexpr (dim == 3)
          for (const auto &[p, q] : edges(a))
            for (const auto &[r, s] : edges(b))
            {
              const Tensor<1, dim> u = points[q] - points[p], v = points[s] - points[r], axis = cross_product_3d(u, v);
              if (axis.norm() > 1e-6 * u.norm() * v.norm() && parts(axis))
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
      std::pair<double, double> extent(const unsigned cell, const Tensor<1, dim> &axis) const
      {
        // From a vertex of the cell: far from the origin the products would lose their digits.
        double low = std::numeric_limits<double>::max(), high = std::numeric_limits<double>::lowest();
        for (const unsigned v : cells[cell])
        {
          const double x = axis * (points[v] - origin(cell));
          low = std::min(low, x);
          high = std::max(high, x);
        }
        const double shift = axis * (origin(cell) - points[0]);
        return {low + shift, high + shift};
      }

      const Point<dim> &origin(const unsigned cell) const { return points[cells[cell][0]]; }

      std::vector<std::pair<unsigned, unsigned>> edges(const unsigned cell) const
      {
        std::vector<std::pair<unsigned, unsigned>> result;
        if (simplex)
        {
          for (unsigned i = 0; i < cells[cell].size(); ++i)
            for (unsigned j = 0; j < i; ++j)
              result.emplace_back(cells[cell][j], cells[cell][i]);
          return result;
        }
        for (unsigned v = 0; v < cells[cell].size(); ++v)
          for (unsigned d = 0; d < dim; ++d)
            if (!(v >> d & 1))
              result.emplace_back(cells[cell][v], cells[cell][v | 1u << d]);
        return result;
      }

      const std::vector<Point<dim>>            &points;
      const std::vector<std::vector<unsigned>> &cells;
      const bool                                simplex;
      const ReferenceCell                       reference;
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
      }

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
              if (meet(boxes[order[k]], box) && visit(order[k]))
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
  } // namespace

  template <int dim>
  std::optional<std::pair<unsigned, unsigned>> overlapping_cells(const std::vector<Point<dim>>            &points,
                                                                 const std::vector<std::vector<unsigned>> &cells,
                                                                 const bool                                simplex,
                                                                 const bool                                curved)
  {
    if constexpr (dim == 1)
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
    }
    else
    {
      const CellsInSpace<dim> space(points, cells, simplex);

      std::unordered_map<std::array<unsigned, 4>, unsigned, HashOfFace> cell_at;
      for (unsigned c = 0; c < cells.size(); ++c)
        for (unsigned f = 0; f < space.n_faces(); ++f)
        {
          const auto              face = space.face(c, f);
          std::array<unsigned, 4> key;
          key.fill(std::numeric_limits<unsigned>::max());
          std::copy(face.begin(), face.end(), key.begin());
          std::sort(key.begin(), key.end());
          const auto [other, first] = cell_at.try_emplace(key, c);
          if (first)
            continue;
          const Tensor<1, dim> normal = space.normal(face);
          const Point<dim>     middle = space.centre(face);
          const double         here = normal * (space.centre(cells[c]) - middle);
          const double         there = normal * (space.centre(cells[other->second]) - middle);
          // The straight cells of curved ones, thin ones above all, can lie on the wrong side: whether curved cells are folded is looked
          // at where they are known.
          if (here * there >= 0 && !curved)
            return std::pair(other->second, c);
        }

      std::vector<std::pair<Point<dim>, Point<dim>>> boxes;
      for (unsigned c = 0; c < cells.size(); ++c)
        boxes.push_back(space.box(c));
      const BoxTree<dim> tree(boxes);
      for (unsigned c = 0; c < cells.size(); ++c)
      {
        unsigned other = 0;
        if (tree.any(boxes[c],
                     [&](const unsigned candidate)
                     {
                       other = candidate;
                       if (candidate <= c)
                         return false;
                       const bool neighbours = space.share_a_vertex(c, candidate);
                       if (neighbours && (curved || (dim == 3 && !simplex)))
                         return false;
                       return space.overlap(c, candidate, curved ? 0.3 : neighbours ? 1e-3 : 0.05);
                     }))
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
