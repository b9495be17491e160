// The loops of Gauss-Seidel by nodes.
#pragma once

#include "unilateral/algebra/lower_blocks.h"

namespace unilateral
{
  /// x = (L + D)^-1 r and @p rest = r - (L + D + L') x = -L'x, for a matrix with the inverse of D as its diagonal. @p b: 1, 2, 3 or 6.
  void sweep_forward_from_zero(const LowerBlocks<float> &matrix, unsigned b, const float *r, float *x, float *rest);

  /// x + (D + L')^-1 (r - (L + D + L') x). @p scratch: as many numbers as x has.
  void sweep_backward(const LowerBlocks<float> &matrix, unsigned b, const float *r, float *x, float *scratch);
} // namespace unilateral
