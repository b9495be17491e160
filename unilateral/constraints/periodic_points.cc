#include "unilateral/constraints/periodic_points.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>
#include <vector>

namespace unilateral
{
  using namespace dealii;

  namespace
  {
    /// The point that a point is the image of.
    template <int dim>
    struct OriginalPoint
    {
      std::vector<types::global_dof_index> dofs; ///< in the order of the image's
      Point<dim>                           x;
      double                               jump = 0; ///< of its trace
      double                               size = 0; ///< of the shift
      const PeriodicImage<dim>            *node = nullptr;
    };

    /// None where not all of its unknowns are images.
    template <int dim>
    OriginalPoint<dim> original_of(const ConstraintSet<dim> &set, const std::size_t i, const PeriodicNodes<dim> &periodic)
    {
      OriginalPoint<dim> original;
      const auto         row = set.trace[i];
      original.x = set.points[i].x;
      for (std::size_t k = 0; k < row.dofs.size(); ++k)
      {
        const auto [image, component] = periodic.image_with(row.dofs[k]);
        if (!image)
          return {};
        if (k == 0)
        {
          original.node = image;
          original.x -= image->node.x - image->original.x;
          original.size = image->node.x.distance(image->original.x);
        }
        original.dofs.push_back(image->original.dofs[component]);
        original.jump += row.values[k] * image->jump[component];
      }
      return original;
    }

    /// Unknowns of a row in an order of their own.
    std::vector<types::global_dof_index> sorted(std::vector<types::global_dof_index> dofs)
    {
      std::sort(dofs.begin(), dofs.end());
      return dofs;
    }

    TraceRow copy_of(const TraceRowView &row)
    {
      return {{row.dofs.begin(), row.dofs.end()}, {row.values.begin(), row.values.end()}, {row.direction.begin(), row.direction.end()}};
    }

    template <int dim>
    TraceRow row_at_node(const PartNode<dim> &node, const Tensor<1, dim> &direction)
    {
      TraceRow row;
      for (unsigned c = 0; c < dim; ++c)
        if (std::abs(direction[c]) > 1e-12)
        {
          row.dofs.push_back(node.dofs[c]);
          row.values.push_back(direction[c]);
          row.direction.push_back(direction[c]);
        }
      return row;
    }
  } // namespace

  namespace
  {
    /// The point of a block that takes a point over, and how.
    template <int dim>
    class BlockMerger
    {
    public:
      BlockMerger(ConstraintSet<dim> &set, const ConstraintBlock &block, const PeriodicNodes<dim> &periodic, std::vector<bool> &leaves)
        : set(set), periodic(periodic), vectors(!set.directions.empty()), leaves(leaves)
      {
        for (std::size_t i = block.begin; i < block.end; ++i)
          for (const auto dof : set.trace[i].dofs)
            by_dof[dof].push_back(i);
        for (std::size_t i = block.begin; i < block.end; ++i)
          if (const auto original = original_of(set, i, periodic); original.node)
            merge(i, original);
      }

      std::map<std::size_t, TraceRow> changed_rows;

    private:
      void merge(const std::size_t i, const OriginalPoint<dim> &original)
      {
        const bool at_node =
          vectors && set.trace[i].dofs.size() <= dim && original.node->node.x.distance(set.points[i].x) <= 1e-9 * original.size;
        const std::size_t found = point_at(original, i, at_node);
        if (found == set.size())
          return;
        auto &point = set.points[found];
        if (vectors && set.directions[i] * set.directions[found] <= parallel)
        {
          Tensor<1, dim> mean = point.weight * set.directions[found] + set.points[i].weight * set.directions[i];
          mean /= mean.norm();
          set.directions[found] = mean;
          changed_rows[found] = row_at_node(original.node->original, mean);
        }
        const double bound = set.points[i].bound - original.jump;
        point.bound = point.sign > 0 ? std::min(point.bound, bound) : std::max(point.bound, bound);
        point.weight += set.points[i].weight;
        leaves[i] = true;
        set.images.push_back(
          {found, set.points[i].weight, at_node ? row_at_node(original.node->node, set.directions[found]) : copy_of(set.trace[i])});
      }

      /// set.size(): there is none.
      std::size_t point_at(const OriginalPoint<dim> &original, const std::size_t image, const bool at_node) const
      {
        for (const auto dof : original.dofs)
          if (const auto it = by_dof.find(dof); it != by_dof.end())
            for (const std::size_t j : it->second)
            {
              if (leaves[j] || set.points[j].x.distance(original.x) > 1e-8 * original.size)
                continue;
              const auto   row = set.trace[j];
              const double cosine = vectors ? set.directions[image] * set.directions[j] : 1.;
              if ((at_node && cosine > 0.5) || (cosine > parallel && sorted({row.dofs.begin(), row.dofs.end()}) == sorted(original.dofs)))
                return j;
            }
        return set.size();
      }

      static constexpr double parallel = 1 - 1e-10; ///< cosine of two directions that are one

      ConstraintSet<dim>                                         &set;
      const PeriodicNodes<dim>                                   &periodic;
      const bool                                                  vectors; ///< u is one
      std::vector<bool>                                          &leaves;
      std::map<types::global_dof_index, std::vector<std::size_t>> by_dof; ///< the points of the block with an unknown
    };
  } // namespace

  template <int dim>
  void merge_periodic_points(ConstraintSet<dim> &set, const PeriodicNodes<dim> &periodic)
  {
    if (periodic.empty())
      return;
    std::vector<bool>               leaves(set.size(), false);
    std::map<std::size_t, TraceRow> changed_rows;
    for (const auto &block : set.blocks)
      changed_rows.merge(BlockMerger<dim>(set, block, periodic, leaves).changed_rows);
    if (!changed_rows.empty())
    {
      TraceRows rows;
      for (std::size_t i = 0; i < set.size(); ++i)
        if (const auto it = changed_rows.find(i); it != changed_rows.end())
          rows.push_back(it->second);
        else
          rows.push_back(set.trace[i]);
      set.trace = std::move(rows);
    }
    std::vector<std::size_t> n_before(set.size() + 1, 0); // of the points that stay
    for (std::size_t i = 0; i < set.size(); ++i)
      n_before[i + 1] = n_before[i] + !leaves[i];
    for (auto &image : set.images)
      image.point = n_before[image.point];
    for (auto &block : set.blocks)
    {
      block.begin = n_before[block.begin];
      block.end = n_before[block.end];
    }
    set.remove(leaves);
  }

#define INSTANTIATE(dim) template void merge_periodic_points(ConstraintSet<dim> &, const PeriodicNodes<dim> &);
  INSTANTIATE(1)
  INSTANTIATE(2)
  INSTANTIATE(3)
#undef INSTANTIATE
} // namespace unilateral
