// DiscreteProblem with sparse matrices: any element, any mesh.
#pragma once

#include "unilateral/algebra/conjugate_gradients.h"
#include "unilateral/algebra/linear_solver.h"
#include "unilateral/algebra/mixed_solver.h"
#include "unilateral/algebra/updated_cholesky.h"
#include "unilateral/discretisation/constrained_system.h"
#include "unilateral/discretisation/element_systems.h"
#include "unilateral/discretisation/problem.h"
#include "unilateral/multigrid/galerkin_multigrid.h"

#include <deal.II/lac/sparse_matrix.h>
#include <deal.II/lac/sparsity_pattern.h>

#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace unilateral
{
  /// A DiscreteProblem of sparse matrices; `assemble` makes one.
  class Assembled : public ConstrainedSystem
  {
  public:
    struct Parameters
    {
      Method::Solver solver = Method::Solver::automatic; ///< not multigrid
      /// Up to this many unknowns `auto` factorises, in 1-D always.
      std::size_t direct_limit_2d = 20000, direct_limit_3d = 5000;
      /// Bodies of more unknowns it factorises where one factorisation serves for all contact sets, and takes no more operations an entry
      /// of A, which is about what iterations with multigrid take in all, and no more than this part of the available memory.
      /// For membranes multigrid is as quick.
      double operations_per_entry = 5e3, part_of_memory = 0.4;
      /// Systems with more unknowns are not ordered to find out.
      std::size_t order_limit_2d = 2000000, order_limit_3d = 600000;
      /// Nor are those with more, where VertexVolumes couple each unknown with hundreds. Of elements of degree 1, whose tensions are not
      /// stable and take MixedSolver several times as many steps, the limit is a multiple.
      std::size_t volumes_limit_2d = 500000, volumes_limit_3d = 20000, volumes_limit_factor_linear = 5;
    };

    bool symmetric() const override { return is_symmetric; }
    void apply_stiffness(Vector &Au, const Vector &u) const override;
    void apply_gram(Vector &Hu, const Vector &u) const override;

    LinearSolve
    solve_tangent(const Vector &d, const Vector &rhs, const SolveTolerance &tolerance, Vector &x, Vector *Ax = nullptr) override;

    bool        solve_for_pressure(double epsilon, Vector &u, Vector &lambda) override;
    LocalRows   rows_near_free_boundary(const std::vector<bool> &active) const override;
    std::string linear_solver_name() const override { return solves_exactly() ? "direct" : "amg"; }
    bool        solves_exactly() const override { return !multigrid && linear_solver->method() == LinearSolver::Method::direct; }
    std::size_t n_operator_applications() const override { return applications + (linear_solver ? linear_solver->n_products() : 0); }

    /// Why this direct solver: "39 million numbers in the factor", or which iterative one.
    const std::string &solver_reason() const { return why_this_solver; }

    /// H is not needed to solve and costs a matrix; made by assemble() when asked for.
    bool has_gram() const { return !gram.empty(); }

    /// Takes over load, prescribed values and bounds, where A is that of @p problem: what has been factorised serves on. False, and nothing
    /// has changed, where B has.
    template <int dim>
    bool set_data(const Problem<dim> &problem, const ConstraintSet<dim> &constraint_set);

    /// Where it was assembled with the Gram matrix, or a direct solver is asked for; else multigrid may keep all there is of it.
    const dealii::SparseMatrix<double> &stiffness_matrix() const
    {
      Assert(!keeps_blocks(), dealii::ExcMessage("multigrid has the matrix"));
      return stiffness;
    }
    const dealii::SparseMatrix<double> &gram_matrix() const { return gram; }
    const ConstraintTrace              &trace() const { return B; }

  private:
    template <int dim>
    friend std::unique_ptr<Assembled> assemble(const Problem<dim> &, const ConstraintSet<dim> &, const Parameters &, bool);
    template <int dim>
    friend std::unique_ptr<Assembled> assemble_with(Volumes, const Problem<dim> &, const ConstraintSet<dim> &, const Parameters &, bool);

    bool keeps_blocks() const { return multigrid && stiffness.empty(); }
    void apply_without_volumes(Vector &Au, const Vector &u) const;
    void finish(const SymmetricBlockMatrix &in_blocks, std::optional<OwnSparseRows> rows_of_volumes);
    template <int dim>
    void make_iterative_solver(const Problem<dim> &problem, SymmetricBlockMatrix in_blocks);
    template <int dim>
    void make_multigrid(const FunctionSpace<dim> &space, std::vector<Vector> near_null_space, SymmetricBlockMatrix in_blocks);

    enum class Factorisation
    {
      no,
      yes,
      if_quick ///< by one_factorisation_is_quick()
    };
    template <int dim>
    Factorisation factorisation_by_size(const Problem<dim> &problem, const Parameters &parameters, Volumes kept);
    bool          one_factorisation_is_quick(const Parameters &parameters, double volume_to_shape_stiffness);
    void          prepare_to_factorise_once();
    void          try_to_factorise_once();
    void          multiply_by_tangent(Vector &Tx, const Vector &x);
    void          set_tangent(const Vector &d);
    LinearSolve   solve_with_tangent(const Vector &rhs, const SolveTolerance &tolerance, Vector &x);
    LinearSolve   solve_with_multigrid(const LinearMap &T, const Vector &rhs, const SolveTolerance &tolerance, Vector &x);

    dealii::SparsityPattern       sparsity;
    dealii::SparseMatrix<double>  stiffness, gram, tangent;
    bool                          is_symmetric = true;
    std::unique_ptr<LinearSolver> linear_solver;
    std::string                   why_this_solver;
    /// Takes the place of a direct linear_solver where contact on a boundary constrains few unknowns. It is prepared where the choice of
    /// the solver depends on what it takes, and made for the first system.
    bool                             factorise_once = false;
    std::unique_ptr<UpdatedCholesky> prepared, factored_once;
    /// Takes the place of linear_solver where A is symmetric and nothing is factorised.
    std::unique_ptr<GalerkinMultigrid> multigrid;
    ConjugateGradients                 conjugate_gradients;
    std::unique_ptr<MixedSolver>       volumes;          ///< where they are apart: `stiffness` and `multigrid` are without them
    Vector                             tangent_diagonal; ///< the d that the factorisation or preconditioner belongs to
    bool                               tangent_is_set = false;
    mutable std::size_t                applications = 0;
  };

  /// Integrates A, f (and H when @p with_gram) and collects B, W, s on the current level of @p problem.
  template <int dim>
  std::unique_ptr<Assembled>
  assemble(const Problem<dim> &problem, const ConstraintSet<dim> &constraint_set, const Assembled::Parameters &parameters, bool with_gram);
} // namespace unilateral
