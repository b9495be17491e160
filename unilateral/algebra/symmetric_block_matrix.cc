#include "unilateral/algebra/symmetric_block_matrix.h"

#include "unilateral/base/sort_unique.h"

#include <algorithm>

namespace unilateral
{
  using namespace dealii;

  SymmetricBlockMatrix::SymmetricBlockMatrix(const SparseMatrix<double> &A, const unsigned block_size) : b(block_size)
  {
    Assert((b == 1 || b == 2 || b == 3 || b == 6) && A.m() % b == 0, ExcMessage("there are no loops for such blocks"));
    const std::uint32_t        n_nodes = A.m() / b;
    std::vector<std::uint32_t> of_row;
    row_start.reserve(n_nodes + 1);
    columns.reserve(A.n_nonzero_elements() / (2 * b * b));
    for (std::uint32_t node = 0; node < n_nodes; ++node)
    {
      of_row.clear();
      for (std::size_t row = std::size_t(node) * b; row < std::size_t(node + 1) * b; ++row)
        for (auto entry = A.begin(row); entry != A.end(row); ++entry)
          if (const std::uint32_t column = entry->column() / b; column < node && (of_row.empty() || of_row.back() != column))
            of_row.push_back(column);
      sort_unique(of_row);
      columns.insert(columns.end(), of_row.begin(), of_row.end());
      row_start.push_back(columns.size());
    }
    columns.shrink_to_fit();
    const std::size_t size = std::size_t(b) * b;
    blocks.resize(columns.size() * size + 4);
    diagonal.resize(n_nodes * size);
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
    below = RowsOfColumns(row_start, columns, n_nodes);
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
