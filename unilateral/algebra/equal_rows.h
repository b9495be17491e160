// Rows of a symmetric matrix that couple with the same others.
#pragma once

#include <deal.II/lac/sparse_matrix.h>

#include <cstddef>
#include <cstdint>
#include <vector>

namespace unilateral
{
  /// Groups of rows with entries in the same columns, their own among them: the components of one node, the coefficients of one cell. An
  /// order of elimination may keep a group together without more fill (indistinguishable nodes; George and Liu, Computer Solution of Large
  /// Sparse Positive Definite Systems, 1981, section 5.4), and is found several times faster among groups than among rows.
  struct EqualRows
  {
    /// Of the rows that are @p kept and what they have in common. A row that is @p decoupled counts as one with a diagonal only.
    EqualRows(const dealii::SparseMatrix<double> &matrix, const std::vector<bool> &kept, const std::vector<bool> &decoupled);

    std::size_t n() const { return starts.size() - 1; }

    std::vector<std::size_t>  starts, rows; ///< rows[starts[g]] to rows[starts[g + 1] - 1] are those of group g
    std::vector<std::size_t>  column_starts;
    std::vector<std::int64_t> columns; ///< by group, those groups up to itself that it couples with, in rising order
  };
} // namespace unilateral
