// Preconditioned GMRES, for systems that are not symmetric.
#pragma once

#include "unilateral/algebra/conjugate_gradients.h"

namespace unilateral
{
  /// Solves T x = rhs, starting from what x holds, by flexible GMRES (Y. Saad, SIAM J. Sci. Comput. 14 (1993)) with @p basis vectors
  /// between restarts, twice as many in memory. The Euclidean residual, by the product @p dot, stands for that of LinearSolve, scaled by
  /// how @p precondition sees the start. Step k after a restart takes k + 1 products.
  LinearSolve gmres(const LinearMap      &T,
                    const LinearMap      &precondition,
                    const Vector         &rhs,
                    const ScalarProduct  &dot,
                    const SolveTolerance &tolerance,
                    unsigned              max_iterations,
                    unsigned              basis,
                    Vector               &x);
} // namespace unilateral
