// DiscreteProblem with sparse matrices of which each of several processes has a part.
#pragma once

#include "unilateral/algebra/conjugate_gradients.h"
#include "unilateral/algebra/mixed_solver.h"
#include "unilateral/discretisation/shared_system.h"
#include "unilateral/multigrid/galerkin_multigrid.h"

#include <memory>
#include <string>
#include <vector>

namespace unilateral
{
  /// A is the sum over the processes of what their cells contribute, each with a matrix of its own; vectors have equal values at nodes on
  /// cuts. Conjugate gradients with GalerkinMultigrid. Lagrange elements with a symmetric form of second order.
  class SharedAssembled : public SharedSystem
  {
  public:
    /// On the own part of @p problem.
    template <int dim>
    SharedAssembled(const Problem<dim> &problem, const ConstraintSet<dim> &constraint_set);

    bool symmetric() const override { return true; }

    void apply_stiffness(Vector &Au, const Vector &u) const override;

    LinearSolve
    solve_tangent(const Vector &d, const Vector &rhs, const SolveTolerance &tolerance, Vector &x, Vector *Ax = nullptr) override;

    LocalRows   rows_near_free_boundary(const std::vector<bool> &active) const override;
    std::string linear_solver_name() const override { return "amg"; }

    std::string solver_reason() const;

    /// See Assembled.
    template <int dim>
    bool set_data(const Problem<dim> &problem, const ConstraintSet<dim> &constraint_set);

  private:
    template <int dim>
    void make_multigrid(const Problem<dim> &problem, SymmetricBlockMatrix A);
    void change_tangent() override;

    std::unique_ptr<GalerkinMultigrid> multigrid; ///< has the matrix
    ConjugateGradients                 conjugate_gradients;
    std::unique_ptr<MixedSolver>       volumes; ///< of nearly incompressible bodies: `multigrid` is without them
  };
} // namespace unilateral
