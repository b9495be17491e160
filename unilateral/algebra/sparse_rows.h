// Sparse matrices that are no more than their rows.
#pragma once

#include "unilateral/algebra/vector.h"

#include <deal.II/base/types.h>
#include <deal.II/lac/sparse_matrix.h>

#include <cstddef>
#include <cstdint>
#include <vector>

namespace unilateral
{
  /// Compressed rows that somebody else keeps: the entries of row i are those from row_start[i] to row_start[i + 1].
  struct SparseRows
  {
    const std::vector<std::size_t>                     &row_start; ///< N + 1
    const std::vector<dealii::types::global_dof_index> &columns;
    const std::vector<double>                          &values;

    std::size_t size() const { return row_start.size() - 1; }
  };

  /// The same with its own entries.
  struct OwnSparseRows
  {
    std::vector<std::size_t>                     row_start = {0};
    std::vector<dealii::types::global_dof_index> columns;
    std::vector<double>                          values;
    std::size_t                                  n_columns = 0;

    std::size_t size() const { return row_start.size() - 1; }
    SparseRows  rows() const { return {row_start, columns, values}; }
  };

  /// The rows that have an entry in each column, ascending: those of column c are rows[start[c]], ..., rows[start[c + 1] - 1].
  struct RowsOfColumns
  {
    RowsOfColumns() = default;
    /// Of a pattern in compressed rows.
    RowsOfColumns(const std::vector<std::size_t> &row_start, const std::vector<std::uint32_t> &columns, std::size_t n_columns);

    std::vector<std::size_t>   start = {0};
    std::vector<std::uint32_t> rows;
  };

  /// T <- T + B' D B, D = diag(@p d). It must stay inside the pattern of T, as it does where the unknowns that see a point belong to one
  /// cell.
  void add_penalty(dealii::SparseMatrix<double> &T, const SparseRows &B, const Vector &d);
} // namespace unilateral
