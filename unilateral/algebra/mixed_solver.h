// Systems with a part that is much stiffer than the rest, as the volume of a nearly incompressible body: solved in their mixed form.
#pragma once

#include "unilateral/algebra/conjugate_gradients.h"
#include "unilateral/algebra/linear_map.h"
#include "unilateral/algebra/minres.h"
#include "unilateral/algebra/sparse_rows.h"
#include "unilateral/base/shared_unknowns.h"

#include <utility>
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
    /// Each takes about as long as one of conjugate gradients; those of elements with oscillating tensions are many.
    static constexpr unsigned most_steps = 4000;

    /// @p diagonal: of T.
    MixedSolver(OwnSparseRows C, const Vector &diagonal) : MixedSolver(std::move(C), diagonal, {}, {}) {}

    /// C is the sum of what several processes have, each in terms of its own unknowns; they share @p unknowns and @p rows. The linear maps
    /// that solve() takes are those of the whole.
    MixedSolver(OwnSparseRows C, const Vector &diagonal, SharedUnknowns unknowns, SharedUnknowns rows);

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
    double product(const Vector &x, const Vector &y) const { return unknowns.dot(x.begin(), y.begin(), x.size()); }
    double product_of_rows(const Vector &p, const Vector &q) const { return rows.dot(p.begin(), q.begin(), p.size()); }

    void add_squares(const Vector &diagonal);
    void multiply(Vector &p, const Vector &x) const;                              ///< p = C x
    void add_transposed_product(Vector &y, double factor, const Vector &p) const; ///< y += factor C'p
    void learn_spectrum(const LinearMap &T, const LinearMap &precondition, const Vector &r);

    OwnSparseRows       C;
    SharedUnknowns      unknowns, rows;
    std::vector<double> S;
    std::vector<double> squares; ///< the diagonal of C'C
    ConjugateGradients  conjugate_gradients;
  };
} // namespace unilateral
