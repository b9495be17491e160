// DiscreteProblem with sparse matrices: any element, any mesh.
#pragma once

#include "unilateral/algebra/linear_solver.h"
#include "unilateral/constraints/constraint_trace.h"
#include "unilateral/discretisation/problem.h"
#include "unilateral/inequality/discrete_problem.h"

#include <deal.II/lac/sparse_matrix.h>
#include <deal.II/lac/sparsity_pattern.h>

#include <memory>
#include <vector>

namespace unilateral
{
  /// A DiscreteProblem of sparse matrices; `assemble` makes one.
  class Assembled : public DiscreteProblem
  {
  public:
    struct Parameters
    {
      Method::Solver solver = Method::Solver::automatic; ///< not multigrid
      /// Up to this many unknowns `auto` factorises: in 1-D always.
      std::size_t direct_limit_2d = 20000, direct_limit_3d = 5000;
    };

    void                       initialize_dof_vector(Vector &v) const override { v.reinit(stiffness.m()); }
    void                       initialize_point_vector(Vector &q) const override { q.reinit(B.n_points()); }
    bool                       symmetric() const override { return is_symmetric; }
    const std::vector<Vector> &null_space() const override { return null_vectors; }
    const std::vector<Vector> &rigid_body_modes() const override { return modes; }
    void                       apply_stiffness(Vector &Au, const Vector &u) const override;
    void                       apply_gram(Vector &Hu, const Vector &u) const override;
    void                       apply_trace(Vector &Bu, const Vector &u) const override;
    void                       apply_trace_transpose(Vector &BtWq, const Vector &q) const override;

    const Vector &stiffness_diagonal() const override { return diagonal; }
    const Vector &load() const override { return f; }
    const Vector &weights() const override { return B.weights; }
    const Vector &obstacle() const override { return B.obstacle; }
    const Vector &compliance() const override { return local_compliance; }
    const Vector &trace_mass() const override { return BtWB_diagonal; }

    LinearSolve
    solve_tangent(const Vector &d, const Vector &rhs, const SolveTolerance &tolerance, Vector &x, Vector *Ax = nullptr) override;

    LocalRows   rows_near_free_boundary(const std::vector<bool> &active) const override;
    std::string linear_solver_name() const override { return solves_exactly() ? "direct" : "amg"; }
    bool        solves_exactly() const override { return linear_solver->method() == LinearSolver::Method::direct; }
    std::size_t n_operator_applications() const override { return applications + linear_solver->n_products(); }

    /// H is not needed to solve and costs a matrix; made by assemble() when asked for.
    bool has_gram() const { return !gram.empty(); }

    const dealii::SparseMatrix<double> &stiffness_matrix() const { return stiffness; }
    const dealii::SparseMatrix<double> &gram_matrix() const { return gram; }
    const ConstraintTrace              &trace() const { return B; }

  private:
    template <int dim>
    friend std::unique_ptr<Assembled> assemble(const Problem<dim> &, const ConstraintSet<dim> &, const Parameters &, bool);

    void finish();

    dealii::SparsityPattern       sparsity;
    dealii::SparseMatrix<double>  stiffness, gram, tangent;
    ConstraintTrace               B;
    Vector                        f, diagonal, local_compliance, BtWB_diagonal;
    bool                          is_symmetric = true;
    std::vector<Vector>           null_vectors; ///< null_space()
    std::vector<Vector>           modes;        ///< rigid_body_modes()
    std::unique_ptr<LinearSolver> linear_solver;
    Vector                        tangent_diagonal; ///< the d that the factorisation or preconditioner belongs to
    bool                          tangent_is_set = false;
    mutable std::size_t           applications = 0;
  };

  /// Integrates A, f (and H when @p with_gram) and collects B, W, s on the current level of @p problem.
  template <int dim>
  std::unique_ptr<Assembled>
  assemble(const Problem<dim> &problem, const ConstraintSet<dim> &constraint_set, const Assembled::Parameters &parameters, bool with_gram);
} // namespace unilateral
