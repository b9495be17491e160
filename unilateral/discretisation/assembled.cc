#include "unilateral/discretisation/assembled.h"

#include "unilateral/discretisation/element_systems.h"
#include "unilateral/discretisation/free_boundary_rows.h"
#include "unilateral/discretisation/rigid_body_modes.h"

#include <algorithm>
#include <cmath>

namespace unilateral
{
  using namespace dealii;

  void Assembled::apply_stiffness(Vector &Au, const Vector &u) const
  {
    stiffness.vmult(Au, u);
    ++applications;
  }

  void Assembled::apply_gram(Vector &Hu, const Vector &u) const
  {
    Assert(has_gram(), ExcMessage("assemble() was not asked for the Gram matrix"));
    gram.vmult(Hu, u);
  }

  void Assembled::apply_trace(Vector &Bu, const Vector &u) const
  {
    B.apply(Bu, u);
  }

  void Assembled::apply_trace_transpose(Vector &BtWq, const Vector &q) const
  {
    B.apply_transpose(BtWq, q);
  }

  LinearSolve Assembled::solve_tangent(const Vector &d, const Vector &rhs, const SolveTolerance &tolerance, Vector &x, Vector *Ax)
  {
    if (!tangent_is_set || !std::equal(d.begin(), d.end(), tangent_diagonal.begin()))
    {
      // B' D B stays inside the pattern of A: the dofs that see a point belong to one cell.
      tangent.copy_from(stiffness);
      for (std::size_t i = 0; i < d.size(); ++i)
        if (d(i) != 0)
          for (std::size_t k = B.row_start[i]; k < B.row_start[i + 1]; ++k)
            for (std::size_t l = B.row_start[i]; l < B.row_start[i + 1]; ++l)
              tangent.add(B.columns[k], B.columns[l], d(i) * B.values[k] * B.values[l]);
      tangent_is_set = false; // should the factorisation throw
      linear_solver->set_matrix(tangent);
      tangent_diagonal = d;
      tangent_is_set = true;
    }
    const LinearSolve result = linear_solver->solve(rhs, tolerance, x);
    if (Ax)
      apply_stiffness(*Ax, x);
    return result;
  }

  LocalRows Assembled::rows_near_free_boundary(const std::vector<bool> &active) const
  {
    return unilateral::rows_near_free_boundary(stiffness, B, active);
  }

  void Assembled::finish()
  {
    tangent.reinit(sparsity);
    diagonal.reinit(stiffness.m());
    for (std::size_t j = 0; j < stiffness.m(); ++j)
      diagonal(j) = stiffness.diag_element(j);
    B.scale(diagonal, local_compliance, BtWB_diagonal);
  }

  namespace
  {
    LinearSolver::Method choose_method(const Assembled::Parameters &parameters, const unsigned dim, const std::size_t n_dofs)
    {
      if (parameters.solver == Method::Solver::direct)
        return LinearSolver::Method::direct;
      if (parameters.solver == Method::Solver::amg)
        return LinearSolver::Method::amg;
      const bool small = dim == 1 || n_dofs <= (dim == 2 ? parameters.direct_limit_2d : parameters.direct_limit_3d);
      return small ? LinearSolver::Method::direct : LinearSolver::Method::amg;
    }

    /// Unknowns dim i, ..., dim i + dim - 1 are the components at one node.
    template <int dim>
    bool nodes_are_blocks(const Problem<dim> &problem)
    {
      const auto                          &fe = *problem.space.fe;
      std::vector<types::global_dof_index> dofs(fe.n_dofs_per_cell());
      for (const auto &cell : problem.space.dof_handler.active_cell_iterators())
      {
        cell->get_dof_indices(dofs);
        for (unsigned i = 0; i < dofs.size(); ++i)
        {
          const auto [component, shape] = fe.system_to_component_index(i);
          if (dofs[i] % fe.n_components() != component || dofs[fe.component_to_system_index(0, shape)] + component != dofs[i])
            return false;
        }
      }
      return true;
    }
  } // namespace

  template <int dim>
  std::unique_ptr<Assembled> assemble(const Problem<dim>          &problem,
                                      const ConstraintSet<dim>    &constraint_set,
                                      const Assembled::Parameters &parameters,
                                      const bool                   with_gram)
  {
    auto        result = std::make_unique<Assembled>();
    auto       &discrete = *result;
    const auto &dirichlet = problem.space.dirichlet;
    const auto &form = *problem.form;
    const auto  n_dofs = problem.space.dof_handler.n_dofs();

    make_coupling_pattern(problem, discrete.sparsity);
    discrete.stiffness.reinit(discrete.sparsity);
    if (with_gram)
      discrete.gram.reinit(discrete.sparsity);
    discrete.is_symmetric = problem.symmetric();

    dealii::Vector<double> load(n_dofs);
    for_each_local_system<dim>(problem, [&](const LocalSystem &local)
                               { dirichlet.distribute_local_to_global(local.matrix, local.load, local.dofs, discrete.stiffness, load); });
    if (with_gram)
      for_each_local_gram<dim>(problem, problem.cell_quadrature(),
                               [&](const LocalSystem &local)
                               { dirichlet.distribute_local_to_global(local.matrix, local.dofs, discrete.gram); });
    dirichlet.set_zero(load);
    discrete.f.reinit(n_dofs);
    std::copy(load.begin(), load.end(), discrete.f.begin());

    discrete.B = ConstraintTrace(constraint_set, dirichlet);

    LinearSolver::Parameters solver;
    // Aggregation knows nothing of fourth-order problems.
    solver.method = form.order() > 1 ? LinearSolver::Method::direct : choose_method(parameters, dim, n_dofs);
    solver.symmetric = discrete.is_symmetric;
    solver.higher_order = problem.space.element.degree > 1;
    if (solver.method == LinearSolver::Method::amg && form.n_components() > 1)
    {
      solver.near_null_space =
        modes_at_unknowns(problem, form.rigid_body_modes(problem.space.mesh.triangulation->begin_active()->center()));
      solver.block_size = nodes_are_blocks(problem) ? form.n_components() : 1;
    }
    discrete.linear_solver = std::make_unique<LinearSolver>(solver);
    discrete.null_vectors = modes_at_unknowns(problem, problem.null_space);
    discrete.modes = modes_at_unknowns(problem, problem.unsupported);
    discrete.finish();
    return result;
  }

#define INSTANTIATE(dim)                                                                                                                   \
  template std::unique_ptr<Assembled> assemble(const Problem<dim> &, const ConstraintSet<dim> &, const Assembled::Parameters &, bool);
  INSTANTIATE(1)
  INSTANTIATE(2)
  INSTANTIATE(3)
#undef INSTANTIATE
} // namespace unilateral
