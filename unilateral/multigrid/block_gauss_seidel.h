// Gauss-Seidel iteration by nodes, in single precision: a smoother for assembled matrices.
#pragma once

#include "unilateral/algebra/sparse_rows.h"
#include "unilateral/algebra/symmetric_block_matrix.h"
#include "unilateral/algebra/vector.h"
#include "unilateral/multigrid/gauss_seidel_sweeps.h"

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

namespace unilateral
{
  /// T = A + B'DB in blocks of the unknowns at one node, T = L + D_T + L', with sweeps over the nodes in both directions. The matrix is
  /// divided by scale(), so that its largest diagonal entry is one: single precision has a small range. B'DB must stay inside the pattern
  /// of A.
  class BlockGaussSeidel
  {
  public:
    /// Keeps references to A and B. Sweeps make x zero at the nodes @p left_out. @p scale: none: the largest diagonal entry.
    BlockGaussSeidel(const SymmetricBlockMatrix       &A,
                     const SparseRows                 &B,
                     const std::vector<std::uint32_t> &left_out = {},
                     std::optional<double>             scale = std::nullopt);

    /// For D = diag(@p d), d >= 0. It takes a time in proportion to the rows that points of B see.
    void set_diagonal(const Vector &d);

    double scale() const { return largest_diagonal; }

    /// T / scale(), column by column: the block of a node on the diagonal, and block k of L.
    const double *diagonal_block(const std::uint32_t node) const
    {
      return diagonal_blocks.data() + std::size_t(node) * A.block_size() * A.block_size();
    }
    const float *lower_block(const std::size_t k) const { return blocks.data() + k * A.block_size() * A.block_size(); }

    /// x = (L + D_T)^-1 r, the first sweep from zero, and @p rest = r - T x, in one pass over the matrix. n numbers each.
    void first_sweep(const float *r, float *x, float *rest) const;
    /// One more sweep through the nodes in the other direction, x + (D_T + L')^-1 (r - T x). @p scratch: n numbers.
    void backward_sweep(const float *r, float *x, float *scratch) const;

  private:
    LowerBlocks<float> lower_blocks() const;

    void copy_rows_of(std::uint32_t node);
    void invert_diagonal_block(std::uint32_t node);

    const SymmetricBlockMatrix &A;
    const SparseRows            B;
    double                      largest_diagonal = 1;
    std::vector<float>          blocks;          ///< those of T for the blocks of A; behind the last one some that are never used
    std::vector<double>         diagonal_blocks; ///< what single precision would lose: lambda may be far above mu
    std::vector<float>          inverse_diagonal;
    std::vector<std::uint32_t>  seen_by_points; ///< nodes
    std::vector<bool>           is_left_out;    ///< by node; empty: none
  };
} // namespace unilateral
