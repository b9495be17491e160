#include "unilateral/algebra/symmetric_block_matrix.h"

#include "unilateral/base/sort_unique.h"

#include <algorithm>
#include <utility>

namespace unilateral
{
  using namespace dealii;

  SymmetricBlockMatrix::SymmetricBlockMatrix(const SparseMatrix<double> &A, const unsigned block_size) : b(block_size)
  {
    Assert(A.m() % b == 0, ExcDimensionMismatch(A.m() % b, 0));
    const std::uint32_t        n_nodes = A.m() / b;
    std::vector<std::size_t>   start = {0};
    std::vector<std::uint32_t> lower, of_row;
    lower.reserve(A.n_nonzero_elements() / (2 * b * b));
    for (std::uint32_t node = 0; node < n_nodes; ++node)
    {
      of_row.clear();
      for (std::size_t row = std::size_t(node) * b; row < std::size_t(node + 1) * b; ++row)
        for (auto entry = A.begin(row); entry != A.end(row); ++entry)
          if (const std::uint32_t column = entry->column() / b; column < node && (of_row.empty() || of_row.back() != column))
            of_row.push_back(column);
      sort_unique(of_row);
      lower.insert(lower.end(), of_row.begin(), of_row.end());
      start.push_back(lower.size());
    }
    set_pattern(std::move(start), std::move(lower));
    const std::size_t size = std::size_t(b) * b;
    for (std::uint32_t node = 0; node < n_nodes; ++node)
      for (unsigned i = 0; i < b; ++i)
      {
        const std::size_t row = std::size_t(node) * b + i;
        std::size_t       k = row_start[node];
        for (auto entry = A.begin(row); entry != A.end(row); ++entry)
        {
          const std::uint32_t column = entry->column() / b;
          if (column > node)
            continue;
          double *block = diagonal.data() + node * size;
          if (column < node)
          {
            k = columns[k] == column ? k : lower_block(node, column); // ascending but for the diagonal entry, the first of a row
            block = blocks.data() + k * size;
          }
          block[entry->column() % b * b + i] = entry->value();
        }
      }
  }

  SymmetricBlockMatrix::SymmetricBlockMatrix(const unsigned                    block_size,
                                             const std::size_t                 n_nodes,
                                             const std::vector<std::size_t>   &start,
                                             const std::vector<std::uint32_t> &groups)
    : b(block_size)
  {
    const RowsOfColumns        groups_of_node(start, groups, n_nodes);
    std::vector<std::size_t>   first = {0};
    std::vector<std::uint32_t> lower, seen_from(n_nodes, std::uint32_t(-1));
    first.reserve(n_nodes + 1);
    lower.reserve(2 * groups.size());
    for (std::uint32_t node = 0; node < n_nodes; ++node)
    {
      for (std::size_t k = groups_of_node.start[node]; k < groups_of_node.start[node + 1]; ++k)
        for (std::size_t j = start[groups_of_node.rows[k]]; j < start[groups_of_node.rows[k] + 1]; ++j)
          if (const std::uint32_t other = groups[j]; other < node && seen_from[other] != node)
          {
            seen_from[other] = node;
            lower.push_back(other);
          }
      std::sort(lower.begin() + first.back(), lower.end());
      first.push_back(lower.size());
    }
    set_pattern(std::move(first), std::move(lower));
  }

  void SymmetricBlockMatrix::set_pattern(std::vector<std::size_t> start, std::vector<std::uint32_t> lower)
  {
    Assert(b == 1 || b == 2 || b == 3 || b == 6, ExcMessage("there are no loops for such blocks"));
    row_start = std::move(start);
    columns = std::move(lower);
    columns.shrink_to_fit();
    blocks.resize(columns.size() * b * b + 4);
    diagonal.resize(n_nodes() * b * b);
    below = RowsOfColumns(row_start, columns, n_nodes());
  }

  void SymmetricBlockMatrix::add(const std::vector<std::uint32_t> &unknowns, const double *const M)
  {
    const std::size_t n = unknowns.size();
    const auto        end_of_node = [&](std::size_t i)
    {
      const std::uint32_t node = unknowns[i] / b;
      while (++i < n && unknowns[i] / b == node)
      {
      }
      return i;
    };
    for (std::size_t i = 0, next_i = 0; i < n; i = next_i)
    {
      next_i = end_of_node(i);
      const std::uint32_t row = unknowns[i] / b;
      for (std::size_t j = 0, next_j = 0; j < n; j = next_j)
      {
        next_j = end_of_node(j);
        const std::uint32_t column = unknowns[j] / b;
        if (column > row)
          continue;
        double *const block = column < row ? blocks.data() + lower_block(row, column) * b * b : diagonal.data() + std::size_t(row) * b * b;
        for (std::size_t r = i; r < next_i; ++r)
          for (std::size_t c = j; c < next_j; ++c)
            block[unknowns[c] % b * b + unknowns[r] % b] += M[r * n + c];
      }
    }
  }

  std::size_t SymmetricBlockMatrix::lower_block(const std::uint32_t row, const std::uint32_t column) const
  {
    return std::lower_bound(columns.begin() + row_start[row], columns.begin() + row_start[row + 1], column) - columns.begin();
  }

  void SymmetricBlockMatrix::copy_to(SparsityPattern &pattern, SparseMatrix<double> &A) const
  {
    std::vector<unsigned> length(m());
    for (std::size_t row = 0; row < m(); ++row)
    {
      const std::size_t node = row / b;
      length[row] = b * (row_start[node + 1] - row_start[node] + 1 + below.start[node + 1] - below.start[node]);
    }
    A.clear();
    pattern.reinit(m(), m(), length);
    for (std::size_t row = 0; row < m(); ++row)
      for_each_in_row(row, [&](const std::size_t column, double) { pattern.add(row, column); });
    pattern.compress();
    A.reinit(pattern);
    for (std::size_t row = 0; row < m(); ++row)
      for_each_in_row(row, [&](const std::size_t column, const double value) { A.set(row, column, value); });
  }
} // namespace unilateral
