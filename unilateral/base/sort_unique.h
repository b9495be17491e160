// Lists in which nothing occurs twice.
#pragma once

#include <algorithm>
#include <vector>

namespace unilateral
{
  /// Sorts @p values and drops repeated ones.
  template <typename T>
  void sort_unique(std::vector<T> &values)
  {
    std::sort(values.begin(), values.end());
    values.erase(std::unique(values.begin(), values.end()), values.end());
  }
} // namespace unilateral
