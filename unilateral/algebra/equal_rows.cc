#include "unilateral/algebra/equal_rows.h"

#include <algorithm>
#include <unordered_map>

namespace unilateral
{
  using namespace dealii;

  namespace
  {
    /// The finaliser of SplitMix64: sums of these tell sets of numbers apart. Two sets with the same sum would share a group, which makes
    /// an order of elimination worse and nothing wrong.
    std::uint64_t mixed(std::uint64_t x)
    {
      x += 0x9e3779b97f4a7c15u;
      x = (x ^ (x >> 30)) * 0xbf58476d1ce4e5b9u;
      x = (x ^ (x >> 27)) * 0x94d049bb133111ebu;
      return x ^ (x >> 31);
    }
  } // namespace

  EqualRows::EqualRows(const SparseMatrix<double> &matrix, const std::vector<bool> &kept, const std::vector<bool> &decoupled)
  {
    const std::size_t n_rows = matrix.m();
    const auto       &pattern = matrix.get_sparsity_pattern();
    const auto        for_each_column = [&](const std::size_t i, const auto &action)
    {
      if (decoupled[i])
        action(i);
      else
        for (auto entry = pattern.begin(i); entry != pattern.end(i); ++entry)
          if (kept[entry->column()] && !decoupled[entry->column()])
            action(entry->column());
    };
    std::vector<std::size_t>                       group(n_rows), size;
    std::unordered_map<std::uint64_t, std::size_t> known;
    known.reserve(n_rows / 2);
    for (std::size_t i = 0; i < n_rows; ++i)
    {
      if (!kept[i])
        continue;
      std::uint64_t columns_of_row = 0;
      for_each_column(i, [&](const std::size_t j) { columns_of_row += mixed(j); });
      group[i] = known.try_emplace(columns_of_row, size.size()).first->second;
      if (group[i] == size.size())
        size.push_back(0);
      ++size[group[i]];
    }

    starts.assign(size.size() + 1, 0);
    for (std::size_t g = 0; g < size.size(); ++g)
      starts[g + 1] = starts[g] + size[g];
    rows.resize(starts.back());
    std::vector<std::size_t> next(starts.begin(), starts.end() - 1);
    for (std::size_t i = 0; i < n_rows; ++i)
      if (kept[i])
        rows[next[group[i]]++] = i;

    column_starts.push_back(0);
    std::vector<std::size_t> seen_by(n(), n());
    for (std::size_t g = 0; g < n(); ++g)
    {
      for_each_column(rows[starts[g]],
                      [&](const std::size_t j)
                      {
                        if (const std::size_t other = group[j]; other <= g && seen_by[other] != g)
                        {
                          seen_by[other] = g;
                          columns.push_back(other);
                        }
                      });
      std::sort(columns.begin() + column_starts[g], columns.end());
      column_starts.push_back(columns.size());
    }
  }
} // namespace unilateral
