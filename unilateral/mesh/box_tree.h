// Boxes in space, and which of them meet another one.
#pragma once

#include <deal.II/base/point.h>

#include <algorithm>
#include <array>
#include <numeric>
#include <utility>
#include <vector>

namespace unilateral
{
  /// A binary tree of boxes around boxes: n log n to build, log n to ask where few meet.
  template <int dim>
  class BoxTree
  {
  public:
    using Box = std::pair<dealii::Point<dim>, dealii::Point<dim>>; ///< the lower and the upper corner; both belong to it

    explicit BoxTree(const std::vector<Box> &boxes) : order(boxes.size())
    {
      std::iota(order.begin(), order.end(), 0u);
      if (!boxes.empty())
        build(boxes, 0, boxes.size());
      in_order.reserve(boxes.size());
      for (const unsigned k : order)
        in_order.push_back(boxes[k]);
    }

    /// Calls @p visit with the number of every box that meets @p box until it returns true; returns whether it did.
    template <typename Visit>
    bool any(const Box &box, const Visit &visit) const
    {
      if (nodes.empty())
        return false;
      std::array<std::size_t, 64> open{}; // halves of halves: two for each of at most 32 levels
      unsigned                    n_open = 1;
      while (n_open > 0)
      {
        const Node &node = nodes[open[--n_open]];
        if (!meet(node.box, box))
          continue;
        if (node.left == 0)
        {
          for (std::size_t k = node.begin; k < node.end; ++k)
            if (meet(in_order[k], box) && visit(order[k]))
              return true;
          continue;
        }
        open[n_open++] = node.left;
        open[n_open++] = node.right;
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

    std::size_t build(const std::vector<Box> &boxes, const std::size_t begin, const std::size_t end)
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
      const std::size_t left = build(boxes, begin, middle), right = build(boxes, middle, end);
      nodes[index].left = left;
      nodes[index].right = right;
      return index;
    }

    std::vector<unsigned> order;
    std::vector<Box>      in_order;
    std::vector<Node>     nodes;
  };
} // namespace unilateral
