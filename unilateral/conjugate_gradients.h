// Preconditioned conjugate gradients.
#pragma once

#include "unilateral/linear_map.h"

namespace unilateral
{
  /// The Euclidean product of two vectors, of all processes that share them.
  using ScalarProduct = std::function<double(const Vector &, const Vector &)>;

  /// The method and its vectors, which are kept from one system to the next.
  class ConjugateGradients
  {
  public:
    /// Solves T x = rhs, T and @p precondition symmetric and positive definite, starting from what x holds.
    LinearSolve solve(const LinearMap      &T,
                      const LinearMap      &precondition,
                      const Vector         &rhs,
                      const ScalarProduct  &dot,
                      const SolveTolerance &tolerance,
                      unsigned              max_iterations,
                      Vector               &x,
                      Vector               *Tx = nullptr);

  private:
    Vector r, z, p, Tp;
  };
} // namespace unilateral
