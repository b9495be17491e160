// A symmetric sparse matrix in blocks: half the numbers, and a column number for each block.
#pragma once

#include "unilateral/algebra/lower_blocks.h"
#include "unilateral/algebra/sparse_rows.h"
#include "unilateral/algebra/vector.h"

#include <deal.II/lac/sparse_matrix.h>
#include <deal.II/lac/sparsity_pattern.h>

#include <cstddef>
#include <cstdint>
#include <vector>

namespace unilateral
{
  /// A = L + D + L' in blocks of the unknowns at one node: unknowns i b, ..., (i + 1) b - 1 belong to node i. L and D are stored.
  class SymmetricBlockMatrix
  {
  public:
    SymmetricBlockMatrix() = default;
    /// Of a symmetric @p A; its upper triangle is not read. @p block_size: 1, 2, 3 or 6.
    SymmetricBlockMatrix(const dealii::SparseMatrix<double> &A, unsigned block_size);
    /// Zero, with a block for each two nodes of a group, such as those of a cell: group g has the nodes groups[start[g]], ...,
    /// groups[start[g + 1] - 1].
    SymmetricBlockMatrix(unsigned                          block_size,
                         std::size_t                       n_nodes,
                         const std::vector<std::size_t>   &start,
                         const std::vector<std::uint32_t> &groups);

    std::size_t n_nodes() const { return row_start.size() - 1; }
    std::size_t m() const { return n_nodes() * b; }
    std::size_t n_nonzero_elements() const { return (2 * columns.size() + n_nodes()) * b * b; } ///< of L, D and L'
    unsigned    block_size() const { return b; }
    double      diagonal_entry(const std::size_t j) const { return diagonal[j * b + j % b]; }

    /// Adds a symmetric matrix @p M on a few unknowns, row by row. It must stay inside the pattern.
    void add(const std::vector<std::uint32_t> &unknowns, const double *M);
    void add_to_diagonal(const std::size_t j, const double value) { diagonal[j * b + j % b] += value; }

    /// y = A x
    void vmult(Vector &y, const Vector &x) const { multiply(lower_blocks(), b, x.begin(), y.begin()); }

    /// visit(column, k, transposed) for each block of a row of nodes but that on the diagonal: it is block k of L, or its transpose.
    /// Columns ascend.
    template <typename Visit>
    void for_each_block_in_row(std::uint32_t node, const Visit &visit) const;

    /// visit(column, value) for each entry of a row that has a block; columns ascend.
    template <typename Visit>
    void for_each_in_row(std::size_t row, const Visit &visit) const;

    /// The whole of it.
    void copy_to(dealii::SparsityPattern &pattern, dealii::SparseMatrix<double> &A) const;

    LowerBlocks<double> lower_blocks() const { return {n_nodes(), row_start.data(), columns.data(), blocks.data(), diagonal.data()}; }
    std::size_t         n_lower_blocks() const { return columns.size(); }
    /// Where the block of L in this row and column of nodes is. It has to be there.
    std::size_t lower_block(std::uint32_t row, std::uint32_t column) const;

  private:
    void set_pattern(std::vector<std::size_t> row_start, std::vector<std::uint32_t> columns);

    unsigned                   b = 1;
    std::vector<std::size_t>   row_start = {0}; ///< see LowerBlocks
    std::vector<std::uint32_t> columns;
    std::vector<double>        blocks, diagonal;
    RowsOfColumns              below; ///< the nodes of the blocks of L in a column of nodes
  };

  template <typename Visit>
  void SymmetricBlockMatrix::for_each_block_in_row(const std::uint32_t node, const Visit &visit) const
  {
    for (std::size_t k = row_start[node]; k < row_start[node + 1]; ++k)
      visit(columns[k], k, false);
    for (std::size_t k = below.start[node]; k < below.start[node + 1]; ++k)
      visit(below.rows[k], lower_block(below.rows[k], node), true);
  }

  template <typename Visit>
  void SymmetricBlockMatrix::for_each_in_row(const std::size_t row, const Visit &visit) const
  {
    const std::uint32_t node = row / b, i = row % b;
    const auto          visit_block = [&](const double *const block, const std::size_t column, const bool transposed)
    {
      for (unsigned j = 0; j < b; ++j)
        visit(column * b + j, block[transposed ? i * b + j : j * b + i]);
    };
    for (std::size_t k = row_start[node]; k < row_start[node + 1]; ++k)
      visit_block(blocks.data() + k * b * b, columns[k], false);
    visit_block(diagonal.data() + std::size_t(node) * b * b, node, false);
    for (std::size_t k = below.start[node]; k < below.start[node + 1]; ++k)
      visit_block(blocks.data() + lower_block(below.rows[k], node) * b * b, below.rows[k], true);
  }

  /// visit(column, value) for each entry of a row.
  template <typename Visit>
  void for_each_in_row(const SymmetricBlockMatrix &A, const std::size_t row, const Visit &visit)
  {
    A.for_each_in_row(row, visit);
  }

  template <typename Visit>
  void for_each_in_row(const dealii::SparseMatrix<double> &A, const std::size_t row, const Visit &visit)
  {
    for (auto entry = A.begin(row); entry != A.end(row); ++entry)
      visit(entry->column(), entry->value());
  }
} // namespace unilateral
