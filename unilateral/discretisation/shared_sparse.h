// DiscreteProblem with sparse matrices of which each of several processes has a part, for forms of any kind.
#pragma once

#include "unilateral/algebra/distributed_amg.h"
#include "unilateral/algebra/mumps_factors.h"
#include "unilateral/discretisation/shared_system.h"
#include "unilateral/discretisation/terms_across_cuts.h"

#include <deal.II/lac/sparse_matrix.h>
#include <deal.II/lac/sparsity_pattern.h>

#include <memory>
#include <string>

namespace unilateral
{
  /// A is the sum over the processes of what their cells contribute, in rows. Where SharedAssembled does not serve: forms that are not
  /// symmetric or of fourth order, and factorisations.
  class SharedSparse : public SharedSystem
  {
  public:
    enum class Solver
    {
      factors,   ///< MumpsFactors, with iterative refinement
      iterations ///< GMRES with DistributedAmg
    };

    /// On the own part of @p problem.
    template <int dim>
    SharedSparse(const Problem<dim> &problem, const ConstraintSet<dim> &constraint_set, Solver solver);

    bool symmetric() const override { return is_symmetric; }

    void apply_stiffness(Vector &Au, const Vector &u) const override;

    LinearSolve
    solve_tangent(const Vector &d, const Vector &rhs, const SolveTolerance &tolerance, Vector &x, Vector *Ax = nullptr) override;

    LocalRows   rows_near_free_boundary(const std::vector<bool> &active) const override;
    std::string linear_solver_name() const override { return factors ? "direct" : "amg"; }
    bool        solves_exactly() const override { return bool(factors); }

    std::string solver_reason() const;

    /// See Assembled.
    template <int dim>
    bool set_data(const Problem<dim> &problem, const ConstraintSet<dim> &constraint_set);

  private:
    void change_tangent() override;
    void multiply_by_tangent(Vector &Tx, const Vector &x) const;

    bool                            is_symmetric;
    dealii::SparsityPattern         sparsity;
    dealii::SparseMatrix<double>    stiffness, tangent; ///< of the own cells
    TermsAcrossCuts                 across;             ///< of both
    std::unique_ptr<MumpsFactors>   factors;            ///< one of these two
    std::unique_ptr<DistributedAmg> amg;
  };
} // namespace unilateral
