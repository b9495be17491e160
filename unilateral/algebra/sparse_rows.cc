#include "unilateral/algebra/sparse_rows.h"

namespace unilateral
{
  RowsOfColumns::RowsOfColumns(const std::vector<std::size_t>   &row_start,
                               const std::vector<std::uint32_t> &columns,
                               const std::size_t                 n_columns)
    : start(n_columns + 1, 0), rows(columns.size())
  {
    for (const std::uint32_t column : columns)
      ++start[column + 1];
    for (std::size_t c = 0; c < n_columns; ++c)
      start[c + 1] += start[c];
    auto next = start;
    for (std::size_t row = 0; row + 1 < row_start.size(); ++row)
      for (std::size_t k = row_start[row]; k < row_start[row + 1]; ++k)
        rows[next[columns[k]]++] = row;
  }

  void add_penalty(dealii::SparseMatrix<double> &T, const SparseRows &B, const Vector &d)
  {
    for (std::size_t i = 0; i < B.size(); ++i)
      if (d(i) != 0)
        for (std::size_t k = B.row_start[i]; k < B.row_start[i + 1]; ++k)
          for (std::size_t l = B.row_start[i]; l < B.row_start[i + 1]; ++l)
            T.add(B.columns[k], B.columns[l], d(i) * B.values[k] * B.values[l]);
  }
} // namespace unilateral
