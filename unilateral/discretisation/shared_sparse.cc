#include "unilateral/discretisation/shared_sparse.h"

#include "unilateral/algebra/gmres.h"
#include "unilateral/algebra/iterative_refinement.h"
#include "unilateral/algebra/linear_solver.h"
#include "unilateral/algebra/sparse_rows.h"
#include "unilateral/discretisation/element_systems.h"
#include "unilateral/discretisation/free_boundary_rows.h"

namespace unilateral
{
  using namespace dealii;

  template <int dim>
  SharedSparse::SharedSparse(const Problem<dim> &problem, const ConstraintSet<dim> &constraint_set, const Solver solver)
    : SharedSystem(problem, constraint_set), is_symmetric(problem.symmetric())
  {
    const auto            &dirichlet = problem.space.dirichlet;
    const std::size_t      n_dofs = problem.space.dof_handler.n_dofs();
    dealii::Vector<double> own_load(n_dofs);
    make_coupling_pattern(problem, sparsity);
    stiffness.reinit(sparsity);
    for_each_local_system<dim>(problem, [&](const LocalSystem &local)
                               { dirichlet.distribute_local_to_global(local.matrix, local.load, local.dofs, stiffness, own_load); });
    across = TermsAcrossCuts(problem, stiffness, own_load);
    AssertThrow(across.empty() || solver == Solver::factors, ExcMessage("iterations know no terms between cells of two processes"));
    take_load(problem, own_load);
    diagonal.reinit(n_dofs);
    for (std::size_t j = 0; j < n_dofs; ++j)
      diagonal(j) = stiffness.diag_element(j);
    across.add_diagonal(diagonal);
    shared_unknowns.add(diagonal.begin());
    set_scales();
    if (solver == Solver::factors)
      factors = std::make_unique<MumpsFactors>(shared_unknowns, n_dofs, is_symmetric);
    else
      amg = std::make_unique<DistributedAmg>(shared_unknowns, n_dofs, /*higher_order=*/problem.space.element.degree > 1);
  }

  std::string SharedSparse::solver_reason() const
  {
    return factors ? "factors that the processes have in parts (MUMPS)" : "algebraic multigrid on all processes (ML) with GMRES";
  }

  void SharedSparse::apply_stiffness(Vector &Au, const Vector &u) const
  {
    stiffness.vmult(Au, u);
    across.add_product(Au, u);
    shared_unknowns.add(Au.begin());
    ++applications;
  }

  LocalRows SharedSparse::rows_near_free_boundary(const std::vector<bool> &active) const
  {
    return unilateral::rows_near_free_boundary(stiffness, B, active, shared_unknowns, across.rows());
  }

  void SharedSparse::change_tangent()
  {
    if (tangent.empty())
      tangent.reinit(sparsity);
    tangent.copy_from(stiffness);
    add_penalty(tangent, {B.row_start, B.columns, B.values}, own_tangent_diagonal);
    if (factors)
      factors->factorise(tangent, across.entries());
    else
      amg->set_matrix(tangent);
  }

  /// (A + B' D B) x.
  void SharedSparse::multiply_by_tangent(Vector &Tx, const Vector &x) const
  {
    tangent.vmult(Tx, x);
    across.add_product(Tx, x);
    shared_unknowns.add(Tx.begin());
    ++applications;
  }

  LinearSolve SharedSparse::solve_tangent(const Vector &d, const Vector &rhs, const SolveTolerance &tolerance, Vector &x, Vector *Ax)
  {
    set_tangent(d);
    const LinearMap     T = [this](Vector &Tv, const Vector &v) { multiply_by_tangent(Tv, v); };
    const ScalarProduct product = [this](const Vector &u, const Vector &v) { return dot(u, v); };
    const LinearSolve   result = factors ? solve_with_refinement(
                                             T, [this](Vector &z, const Vector &r) { factors->solve(z, r); }, rhs, product, tolerance, x)
                                         : gmres(
                                             T, [this](Vector &z, const Vector &r) { amg->vmult(z, r); }, rhs, product, tolerance,
                                             LinearSolver::Parameters().max_iterations, LinearSolver::Parameters().gmres_basis, x);
    if (Ax)
      apply_stiffness(*Ax, x);
    return result;
  }

  template <int dim>
  bool SharedSparse::set_data(const Problem<dim> &problem, const ConstraintSet<dim> &constraint_set)
  {
    if (!take_bounds(problem, constraint_set))
      return false;
    const auto            &dirichlet = problem.space.dirichlet;
    dealii::Vector<double> own_load(f.size());
    for_each_local_system<dim>(problem, [&](const LocalSystem &local)
                               { dirichlet.distribute_local_to_global(local.load, local.dofs, own_load, local.matrix); });
    add_load_across_cuts(problem, own_load);
    take_load(problem, own_load);
    return true;
  }

#define INSTANTIATE(dim)                                                                                                                   \
  template SharedSparse::SharedSparse(const Problem<dim> &, const ConstraintSet<dim> &, Solver);                                           \
  template bool SharedSparse::set_data(const Problem<dim> &, const ConstraintSet<dim> &);
  INSTANTIATE(1)
  INSTANTIATE(2)
  INSTANTIATE(3)
#undef INSTANTIATE
} // namespace unilateral
