// Which points of neighbouring cells are one.
#pragma once

#include <deal.II/base/point.h>
#include <deal.II/base/types.h>

#include <algorithm>
#include <unordered_map>
#include <utility>
#include <vector>

namespace unilateral
{
  /// Finds points that cells share. Two points are one when the same shape functions live there and they coincide in space: that
  /// holds for every continuous element, and keeps apart the two sides of a slit.
  template <int dim>
  class SharedPoints
  {
  public:
    explicit SharedPoints(std::size_t n_dofs) : by_single_dof(n_dofs, none) {}

    /// Index of the point known under (@p dofs, @p x), or registers @p fresh there and returns it.
    std::size_t find_or_insert(const std::vector<dealii::types::global_dof_index> &dofs,
                               const dealii::Point<dim>                           &x,
                               const double                                        tolerance,
                               const std::size_t                                   fresh)
    {
      if (dofs.size() == 1)
      {
        std::size_t &index = by_single_dof[dofs[0]];
        return index == none ? (index = fresh) : index;
      }
      auto sorted = dofs;
      std::sort(sorted.begin(), sorted.end());
      auto &bucket = by_dofs[sorted];
      for (const auto &[y, index] : bucket)
        if (x.distance(y) < tolerance)
          return index;
      bucket.emplace_back(x, fresh);
      return fresh;
    }

  private:
    static constexpr std::size_t none = static_cast<std::size_t>(-1);

    using Key = std::vector<dealii::types::global_dof_index>;
    struct Hash
    {
      std::size_t operator()(const Key &dofs) const
      {
        std::size_t hash = 1469598103934665603ull;
        for (const auto dof : dofs)
          hash = (hash ^ dof) * 1099511628211ull;
        return hash;
      }
    };
    std::vector<std::size_t>                                                               by_single_dof;
    std::unordered_map<Key, std::vector<std::pair<dealii::Point<dim>, std::size_t>>, Hash> by_dofs;
  };
} // namespace unilateral
