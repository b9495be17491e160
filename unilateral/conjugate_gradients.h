// Preconditioned conjugate gradients.
#pragma once

#include "unilateral/discrete_problem.h"

#include <functional>

namespace unilateral
{
  /// y = T x.
  using LinearMap = std::function<void(Vector &y, const Vector &x)>;

  /// The method and its vectors, which are kept from one system to the next.
  class ConjugateGradients
  {
  public:
    /// Solves T x = rhs, T and @p precondition symmetric and positive definite, starting from what x holds.
    LinearSolve solve(const LinearMap      &T,
                      const LinearMap      &precondition,
                      const Vector         &rhs,
                      const SolveTolerance &tolerance,
                      unsigned              max_iterations,
                      Vector               &x,
                      Vector               *Tx = nullptr);

  private:
    Vector r, z, p, Tp;
  };
} // namespace unilateral
