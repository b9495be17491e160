// Symmetric matrices in blocks, as loops over their numbers see them.
#pragma once

#include <cstddef>
#include <cstdint>
#include <type_traits>

namespace unilateral
{
  /// L + D + L' in blocks of b x b numbers, one for each pair of nodes, which lie column by column. Blocks of L are stored by rows.
  template <typename Number>
  struct LowerBlocks
  {
    std::size_t          n_nodes;
    const std::size_t   *row_start; ///< of the blocks of L in a row of nodes: n_nodes + 1
    const std::uint32_t *columns;   ///< nodes, ascending in a row
    const Number        *blocks;    ///< of L; behind the last one, four numbers that do not matter
    const Number        *diagonal;  ///< D or its inverse
  };

  /// loop(std::integral_constant<unsigned, b>()), @p b: 1, 2, 3 or 6.
  template <typename Loop>
  void with_block_size(const unsigned b, const Loop &loop)
  {
    switch (b)
    {
    case 1:
      return loop(std::integral_constant<unsigned, 1>());
    case 2:
      return loop(std::integral_constant<unsigned, 2>());
    case 3:
      return loop(std::integral_constant<unsigned, 3>());
    default:
      return loop(std::integral_constant<unsigned, 6>());
    }
  }

  /// y = (L + D + L') x. @p b: 1, 2, 3 or 6. Each block is read once, for its row and for its column.
  void multiply(const LowerBlocks<double> &matrix, unsigned b, const double *x, double *y);
} // namespace unilateral
