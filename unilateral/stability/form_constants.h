// The constants m and M of hypothesis (3) for a(.,.) on V_h.
#pragma once

#include "unilateral/stability/multiplier_pairing.h"

namespace unilateral
{
  /// a(v, v) >= m ||v||_m^2 and |a(u, v)| <= M ||u||_m ||v||_m on V_h, both sharp.
  struct FormConstants
  {
    double m = 0; ///< <= 0 when a is not coercive on V_h
    double M = 0;
  };

  /// The extreme eigenvalues of A against H; where A is not symmetric, m from its symmetric part and M = ||H^-1/2 A H^-1/2||. By Lanczos
  /// iterations with sparse factorisations, relative accuracy 1e-4 or better (m too large, M too small by so much).
  /// @p stiffness, @p gram: A and H on the free unknowns (n x n).
  /// Throws std::runtime_error when a factorisation or the iteration fails.
  FormConstants form_constants(const SparseMatrixd &stiffness, const SparseMatrixd &gram, bool symmetric);
} // namespace unilateral
