// Linear systems with an assembled matrix: a direct factorisation, or Krylov with algebraic multigrid.
#pragma once

#include "unilateral/algebra/conjugate_gradients.h"
#include "unilateral/algebra/linear_solve.h"
#include "unilateral/algebra/vector.h"

#include <deal.II/lac/sparse_matrix.h>

#include <functional>
#include <memory>
#include <vector>

namespace unilateral
{
  /// Solves T x = rhs for a sequence of right-hand sides with one matrix.
  class LinearSolver
  {
  public:
    enum class Method
    {
      direct, ///< CHOLMOD, or UMFPACK where T is not positive definite; with iterative refinement
      amg     ///< CG, or GMRES when T is not symmetric, with smoothed aggregation (Trilinos ML)
    };

    struct Parameters
    {
      Method   method = Method::direct;
      bool     symmetric = true;
      bool     higher_order = false;  ///< element degree > 1: tells the aggregation not to trust small couplings
      unsigned max_iterations = 1000; ///< Krylov steps
      unsigned least_iterations = 5;  ///< of CG where a solve is to be as accurate as asked: aggregation may not see a soft mode at once
      unsigned gmres_basis = 40;      ///< vectors between restarts of GMRES
      double   amg_drop_tolerance = 0.02; ///< couplings weaker than this fraction of the diagonal do not join an aggregate
      /// Vectors with (nearly) no energy, which the coarse spaces must contain: rigid body modes. None: the constant.
      std::vector<Vector> near_null_space;
      unsigned block_size = 1; ///< unknowns i block_size, ..., (i + 1) block_size - 1 belong to one node and are aggregated together
    };

    explicit LinearSolver(const Parameters &parameters);
    ~LinearSolver();

    /// Factorises or sets up the preconditioner; keeps a reference to @p matrix for solve(), which precondition() does without.
    /// Throws std::runtime_error when the matrix is singular.
    void set_matrix(const dealii::SparseMatrix<double> &matrix);

    /// Improves x, starting from what it holds, until the residual is within @p tolerance; a direct solve goes as far as it can.
    LinearSolve solve(const Vector &rhs, const SolveTolerance &tolerance, Vector &x) const;

    /// x = P^-1 r: one V-cycle, or one solve with the factors.
    void precondition(Vector &x, const Vector &r) const;

    Method method() const { return parameters.method; }

    /// Products with the matrix since construction.
    std::size_t n_products() const { return products; }

  private:
    struct Preconditioner; ///< one of CHOLMOD, UMFPACK and ML; hides their headers

    void multiply(Vector &Tx, const Vector &x) const;

    Parameters                          parameters;
    const dealii::SparseMatrix<double> *matrix = nullptr;
    std::unique_ptr<Preconditioner>     preconditioner;
    mutable ConjugateGradients          conjugate_gradients;
    mutable std::size_t                 products = 0;
  };
} // namespace unilateral
