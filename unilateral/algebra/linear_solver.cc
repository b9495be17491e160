#include "unilateral/algebra/linear_solver.h"

#include "unilateral/algebra/gmres.h"
#include "unilateral/algebra/iterative_refinement.h"
#include "unilateral/algebra/ml_parameters.h"
#include "unilateral/algebra/sparse_cholesky.h"

#include <deal.II/lac/sparse_direct.h>
#include <deal.II/lac/trilinos_sparse_matrix.h>

#include <Epetra_MultiVector.h>
#include <Teuchos_ParameterList.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace unilateral
{
  using namespace dealii;

  /// x = P^-1 r.
  struct LinearSolver::Preconditioner
  {
    std::unique_ptr<SparseCholesky>                    cholesky; ///< its order serves all matrices
    std::unique_ptr<SparseDirectUMFPACK>               lu;       ///< where T is not positive definite, be it by rounding
    std::unique_ptr<TrilinosWrappers::SparseMatrix>    copy;     ///< that amg was made for
    std::unique_ptr<TrilinosWrappers::PreconditionAMG> amg;
    mutable dealii::Vector<double>                     work; ///< UMFPACK works in place on a serial vector

    void vmult(Vector &x, const Vector &r) const
    {
      if (amg)
        return amg->vmult(x, r);
      if (!lu)
      {
        cholesky->forward(r.begin(), x.begin());
        cholesky->backward(x.begin(), x.begin());
        return;
      }
      work.reinit(r.size(), true);
      std::copy(r.begin(), r.end(), work.begin());
      lu->solve(work);
      std::copy(work.begin(), work.end(), x.begin());
    }

    bool factorise_as_positive_definite(const SparseMatrix<double> &matrix)
    {
      if (lu)
        return false; // nor will another one of the same problem be
      if (!cholesky)
        cholesky = std::make_unique<SparseCholesky>(matrix);
      try
      {
        cholesky->factorise(matrix);
        return true;
      }
      catch (const NotPositiveDefinite &)
      {
        cholesky.reset();
        return false;
      }
    }

    void factorise(const SparseMatrix<double> &matrix)
    {
      lu = std::make_unique<SparseDirectUMFPACK>();
      try
      {
        lu->factorize(matrix);
      }
      catch (const std::exception &)
      {
        throw std::runtime_error("the linear system is singular, or too large for the direct solver");
      }
    }
  };

  LinearSolver::LinearSolver(const Parameters &parameters) : parameters(parameters), preconditioner(std::make_unique<Preconditioner>()) {}
  LinearSolver::~LinearSolver() = default;

  void LinearSolver::set_matrix(const SparseMatrix<double> &new_matrix)
  {
    matrix = &new_matrix;
    conjugate_gradients.forget_spectrum();
    if (parameters.method == Method::direct)
    {
      if (!parameters.symmetric || !preconditioner->factorise_as_positive_definite(new_matrix))
        preconditioner->factorise(new_matrix);
      return;
    }
    auto data = ml_parameters(parameters.symmetric, parameters.higher_order, parameters.amg_drop_tolerance);
    preconditioner->amg = std::make_unique<TrilinosWrappers::PreconditionAMG>();
    if (parameters.near_null_space.empty())
    {
      preconditioner->amg->initialize(new_matrix, data);
      return;
    }
    preconditioner->copy = std::make_unique<TrilinosWrappers::SparseMatrix>();
    preconditioner->copy->reinit(complete_index_set(new_matrix.m()), complete_index_set(new_matrix.n()), new_matrix, MPI_COMM_SELF, 0.);
    const Epetra_CrsMatrix             &epetra = preconditioner->copy->trilinos_matrix();
    Teuchos::ParameterList              list;
    std::unique_ptr<Epetra_MultiVector> no_modes;
    data.set_parameters(list, no_modes, epetra);
    Epetra_MultiVector kernel(epetra.OperatorDomainMap(), parameters.near_null_space.size());
    for (std::size_t k = 0; k < parameters.near_null_space.size(); ++k)
      std::copy(parameters.near_null_space[k].begin(), parameters.near_null_space[k].end(), kernel[k]);
    list.set("PDE equations", int(parameters.block_size));
    list.set("null space: type", "pre-computed");
    list.set("null space: dimension", kernel.NumVectors());
    list.set("null space: vectors", kernel.Values());
    preconditioner->amg->initialize(epetra, list);
  }

  void LinearSolver::precondition(Vector &x, const Vector &r) const
  {
    preconditioner->vmult(x, r);
  }

  void LinearSolver::multiply(Vector &Tx, const Vector &x) const
  {
    matrix->vmult(Tx, x);
    ++products;
  }

  LinearSolve LinearSolver::solve(const Vector &rhs, const SolveTolerance &tolerance, Vector &x) const
  {
    if (parameters.method == Method::direct)
      return solve_with_refinement([this](Vector &Tv, const Vector &v) { multiply(Tv, v); },
                                   [this](Vector &z, const Vector &r) { preconditioner->vmult(z, r); }, rhs,
                                   [](const Vector &a, const Vector &b) { return a * b; }, tolerance, x);
    const LinearMap T = [this](Vector &Tv, const Vector &v) { multiply(Tv, v); },
                    precondition = [this](Vector &z, const Vector &r) { preconditioner->vmult(z, r); };
    if (!parameters.symmetric)
      return gmres(
        T, precondition, rhs, [](const Vector &a, const Vector &b) { return a * b; }, tolerance, parameters.max_iterations,
        parameters.gmres_basis, x);
    return conjugate_gradients.solve(
      T, precondition, rhs, [](const Vector &a, const Vector &b) { return a * b; },
      with_least_iterations(tolerance, parameters.least_iterations), parameters.max_iterations, x);
  }
} // namespace unilateral
