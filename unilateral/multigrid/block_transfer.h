// The loops of prolongations in blocks.
#pragma once

#include <cstddef>
#include <cstdint>

namespace unilateral
{
  /// P in blocks of b x k numbers, which lie row by row.
  struct TransferOfBlocks
  {
    std::size_t          n_nodes;
    const std::size_t   *row_start; ///< of the blocks of a node
    const std::uint32_t *columns;
    const float         *blocks;
  };

  /// coarse + P' fine. @p b: 1, 2, 3 or 6; @p k: 1, 3 or 6.
  void add_restriction(const TransferOfBlocks &P, unsigned b, unsigned k, const float *fine, float *coarse);

  /// fine + factor P coarse.
  void add_prolongation(const TransferOfBlocks &P, unsigned b, unsigned k, const float *coarse, float factor, float *fine);

  /// C + M Q, for b x b and b x k numbers row by row, and C + P' M, b x k and b x k.
  void add_product(const double *M, const double *Q, unsigned b, unsigned k, double *C);
  void add_transposed_product(const double *P, const double *M, unsigned b, unsigned k, double *C);
} // namespace unilateral
