// Gauss-Seidel iteration by nodes, in single precision: a smoother for assembled matrices.
#pragma once

#include "unilateral/algebra/sparse_rows.h"
#include "unilateral/algebra/vector.h"
#include "unilateral/multigrid/gauss_seidel_sweeps.h"

#include <deal.II/lac/sparse_matrix.h>

#include <cstddef>
#include <cstdint>
#include <vector>

namespace unilateral
{
  /// T = A + B'DB in blocks of the unknowns at one node, T = L + D_T + U, with sweeps over the nodes in both directions. The matrix is
  /// divided by scale(), so that its largest diagonal entry is one: single precision has a small range. B'DB must stay inside the pattern
  /// of A.
  class BlockGaussSeidel
  {
  public:
    /// Unknowns i block_size, ..., (i + 1) block_size - 1 belong to one node. @p block_size: 1, 2, 3 or 6. Keeps references to A and B.
    BlockGaussSeidel(const dealii::SparseMatrix<double> &A, const SparseRows &B, unsigned block_size);

    /// For D = diag(@p d), d >= 0. It takes a time in proportion to the rows that points of B see.
    void set_diagonal(const Vector &d);

    double scale() const { return largest_diagonal; }

    /// x = (L + D_T)^-1 r, the first sweep from zero, and @p rest = r - T x, which costs the other half of a product with T. n numbers
    /// each.
    void first_sweep(const float *r, float *x, float *rest) const;
    /// One more sweep through the nodes in the other direction, x + (D_T + U)^-1 (r - T x).
    void backward_sweep(const float *r, float *x) const;

  private:
    MatrixOfBlocks matrix_of_blocks() const;

    void        copy_rows_of(std::uint32_t node);
    void        invert_diagonal_block(std::uint32_t node);
    std::size_t entry(std::uint32_t row, std::uint32_t column) const;

    const dealii::SparseMatrix<double> &A;
    const SparseRows                    B;
    const unsigned                      block_size;
    double                              largest_diagonal = 1;
    std::vector<std::size_t>            row_start;        ///< of the blocks in a row of nodes
    std::vector<std::size_t>            diagonal;         ///< where the diagonal block of a row is
    std::vector<std::uint32_t>          columns;          ///< nodes, ascending
    std::vector<float>                  blocks;           ///< column by column; behind the last one some that are never used
    std::vector<double>                 diagonal_blocks;  ///< likewise, what single precision would lose: lambda may be far above mu
    std::vector<float>                  inverse_diagonal; ///< likewise
    std::vector<std::uint32_t>          seen_by_points;   ///< nodes
  };
} // namespace unilateral
