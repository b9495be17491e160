// Preconditioned conjugate gradients.
#pragma once

#include "unilateral/algebra/linear_map.h"
#include "unilateral/algebra/linear_solve.h"

namespace unilateral
{
  /// The Euclidean product of two vectors, of all processes that share them.
  using ScalarProduct = std::function<double(const Vector &, const Vector &)>;

  /// The method and its vectors, which are kept from one system to the next.
  class ConjugateGradients
  {
  public:
    /// Solves T x = rhs, T and @p precondition P^-1 symmetric and positive definite, starting from what x holds.
    ///
    /// The residual of the result is (r'P^-1 r / theta)^1/2, theta <= 1 the smallest Ritz value of P^-1 T that the iteration has met: close
    /// to the energy norm of the error also where P^-1 hardly sees a soft mode (r'T^-1 r <= r'P^-1 r / lambda_min, and the smallest Ritz
    /// value comes down to lambda_min as soon as the error is in that mode). It is kept until forget_spectrum(). Reference: A. Greenbaum,
    /// Iterative Methods for Solving Linear Systems, SIAM 1997, chapter 3 (Lanczos from CG).
    LinearSolve solve(const LinearMap      &T,
                      const LinearMap      &precondition,
                      const Vector         &rhs,
                      const ScalarProduct  &dot,
                      const SolveTolerance &tolerance,
                      unsigned              max_iterations,
                      Vector               &x,
                      Vector               *Tx = nullptr);

    /// To be called when T or its preconditioner has changed.
    void forget_spectrum() { smallest_ritz_value = 1; }

    /// Of P^-1 T, at most 1.
    double smallest_ritz_value_met() const { return smallest_ritz_value; }

  private:
    Vector r, z, p, Tp;
    double smallest_ritz_value = 1;
  };
} // namespace unilateral
