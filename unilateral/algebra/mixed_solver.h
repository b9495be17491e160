// Systems with a part that is much stiffer than the rest, as the volume of a nearly incompressible body: solved in their mixed form.
#pragma once

#include "unilateral/algebra/conjugate_gradients.h"
#include "unilateral/algebra/linear_map.h"
#include "unilateral/algebra/minres.h"
#include "unilateral/algebra/sparse_rows.h"

#include <vector>

namespace unilateral
{
  /// Solves (T + C'C) x = b, T symmetric and positive definite, as
  ///
  ///     T x + C'p = b,    C x - p = 0
  ///
  /// by MINRES with the preconditioner diag(P, S): P one of T, S = 1 + sum_j C_ij^2 / diag(T)_j. Where C'C is the volumetric energy of a
  /// nearly incompressible body and p its tension, the number of steps depends on the inf-sup constant of div alone, not on how stiff the
  /// volume is; a preconditioner of T + C'C would have to know which x have C x = 0. Reference: D. Silvester, A. Wathen, SIAM J. Numer.
  /// Anal. 31 (1994) 1352-1367.
  class MixedSolver
  {
  public:
    /// @p diagonal: of T.
    MixedSolver(OwnSparseRows C, const Vector &diagonal);

    void add_product(Vector &y, const Vector &x) const; ///< y += C'C x
    void add_to_diagonal(Vector &diagonal) const;       ///< of C'C

    /// To be called when T or its preconditioner has changed.
    void forget_spectrum() { conjugate_gradients.forget_spectrum(); }

    /// Starting from what x holds. The residual of the result bounds the energy norm of the error: of r = b - T x - C'p and q = p - C x,
    ///
    ///     ||x* - x|| <= (r'T^-1 r)^1/2 + |q|
    ///
    /// since C (T + C'C)^-1 C' <= 1, with r'T^-1 r as ConjugateGradients has it. A relative tolerance refers to the energy norm of what x
    /// has to change by. SolveTolerance::enough_iterations stands for what as many steps of conjugate gradients would gain: the energy does
    /// not fall in each step of MINRES.
    LinearSolve solve(const LinearMap      &T,
                      const LinearMap      &precondition,
                      const Vector         &b,
                      const SolveTolerance &tolerance,
                      unsigned              max_iterations,
                      Vector               &x);

  private:
    void multiply(Vector &p, const Vector &x) const;                              ///< p = C x
    void add_transposed_product(Vector &y, double factor, const Vector &p) const; ///< y += factor C'p
    void learn_spectrum(const LinearMap &T, const LinearMap &precondition, const Vector &r);

    OwnSparseRows       C;
    std::vector<double> S;
    ConjugateGradients  conjugate_gradients;
  };
} // namespace unilateral
