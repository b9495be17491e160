// Preconditioned MINRES, for systems that are symmetric but not definite.
#pragma once

#include "unilateral/algebra/linear_solve.h"
#include "unilateral/algebra/vector.h"

#include <deal.II/lac/la_parallel_block_vector.h>

#include <functional>

namespace unilateral
{
  /// Unknowns of several kinds.
  using BlockVector = dealii::LinearAlgebra::distributed::BlockVector<double>;

  using BlockLinearMap = std::function<void(BlockVector &y, const BlockVector &x)>;

  using BlockScalarProduct = std::function<double(const BlockVector &a, const BlockVector &b)>;

  /// Whether x will do, whose residual has the norm (r'P^-1 r)^1/2.
  using IsEnough = std::function<bool(const BlockVector &x, double norm)>;

  /// Solves K x = rhs from x = 0, K symmetric, @p precondition P^-1 symmetric and positive definite, @p product the scalar product of
  /// vectors of its kind, until @p is_enough, which is asked after each step, and may change @p rhs: it has been read by then. Seven
  /// vectors. Reference: C. C. Paige, M. A. Saunders, SIAM J. Numer. Anal. 12 (1975) 617-629, in the form of H. Elman, D. Silvester, A.
  /// Wathen, Finite Elements and Fast Iterative Solvers, 2nd ed., Oxford 2014, algorithm 4.1.
  LinearSolve minres(const BlockLinearMap     &K,
                     const BlockLinearMap     &precondition,
                     const BlockVector        &rhs,
                     const BlockScalarProduct &product,
                     const IsEnough           &is_enough,
                     unsigned                  max_iterations,
                     BlockVector              &x);
} // namespace unilateral
