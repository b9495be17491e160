// The loops of Gauss-Seidel by nodes.
#pragma once

#include <cstddef>
#include <cstdint>

namespace unilateral
{
  /// A matrix L + D + U in blocks of b x b numbers, which lie column by column, with the inverses of D.
  struct MatrixOfBlocks
  {
    std::size_t          n_nodes;
    const std::size_t   *row_start; ///< of the blocks in a row of nodes
    const std::size_t   *diagonal;  ///< where the diagonal block of a row is
    const std::uint32_t *columns;   ///< nodes, ascending in a row
    const float         *blocks;    ///< behind the last one, four numbers that do not matter
    const float         *inverse_diagonal;
  };

  /// x = (L + D)^-1 r and @p rest = r - (L + D + U) x = -U x. @p b: 1, 2, 3 or 6.
  void sweep_forward_from_zero(const MatrixOfBlocks &matrix, unsigned b, const float *r, float *x, float *rest);

  /// x + (D + U)^-1 (r - (L + D + U) x).
  void sweep_backward(const MatrixOfBlocks &matrix, unsigned b, const float *r, float *x);
} // namespace unilateral
