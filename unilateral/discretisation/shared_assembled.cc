#include "unilateral/discretisation/shared_assembled.h"

#include "unilateral/algebra/linear_solver.h"
#include "unilateral/discretisation/block_assembly.h"
#include "unilateral/discretisation/free_boundary_rows.h"
#include "unilateral/discretisation/rigid_body_modes.h"
#include "unilateral/discretisation/volume_rows.h"
#include "unilateral/spaces/linear_subspaces.h"

#include <utility>

namespace unilateral
{
  using namespace dealii;

  namespace
  {
    Volumes parts_of_volume(const bool apart)
    {
      return apart ? Volumes::apart : Volumes::included;
    }
  } // namespace

  template <int dim>
  SharedAssembled::SharedAssembled(const Problem<dim> &problem, const ConstraintSet<dim> &constraint_set)
    : SharedSystem(problem, constraint_set)
  {
    const std::size_t      n_dofs = problem.space.dof_handler.n_dofs();
    dealii::Vector<double> own_load(n_dofs);
    const bool             volumes_apart = has_volume_rows(problem);
    SymmetricBlockMatrix   A = assemble_blocks(problem, block_size(problem), parts_of_volume(volumes_apart), own_load);
    VolumeRows             rows;
    if (volumes_apart)
      rows = volume_rows(problem, own_load);
    take_load(problem, own_load);
    diagonal.reinit(n_dofs);
    for (std::size_t j = 0; j < n_dofs; ++j)
      diagonal(j) = A.diagonal_entry(j);
    shared_unknowns.add(diagonal.begin());
    if (volumes_apart)
    {
      volumes = std::make_unique<MixedSolver>(std::move(rows.C), diagonal, shared_unknowns, std::move(rows.shared));
      volumes->add_to_diagonal(diagonal);
    }
    set_scales();
    make_multigrid(problem, std::move(A));
  }

  template <int dim>
  void SharedAssembled::make_multigrid(const Problem<dim> &problem, SymmetricBlockMatrix A)
  {
    auto                          linear = linear_subspaces(problem.space);
    GalerkinMultigrid::Parameters parameters;
    parameters.block_size = block_size(problem);
    parameters.shared.push_back(shared_unknowns);
    for (const auto &at_vertex : linear.at_vertex)
      parameters.shared.push_back(shared_unknowns.of_subspace(std::vector<std::uint32_t>(at_vertex.begin(), at_vertex.end())));
    if (problem.form->n_components() > 1)
    {
      // About the same point on all processes.
      for (const Vector &mode : modes_at_unknowns(problem, problem.form->rigid_body_modes(problem.space.subdomain->some_point)))
        parameters.near_null_space.push_back(linear.at_vertex.empty() ? mode : values_at_vertices(mode, linear.at_vertex.back()));
    }
    multigrid = std::make_unique<GalerkinMultigrid>(std::move(A), SparseRows{B.row_start, B.columns, B.values},
                                                    std::move(linear.prolongations), std::move(parameters));
  }

  void SharedAssembled::apply_stiffness(Vector &Au, const Vector &u) const
  {
    multigrid->matrix().vmult(Au, u);
    shared_unknowns.add(Au.begin());
    if (volumes)
      volumes->add_product(Au, u);
    ++applications;
  }

  std::string SharedAssembled::solver_reason() const
  {
    return multigrid->description() + (volumes ? ", for displacements and the tension of nearly incompressible volumes together" : "");
  }

  LocalRows SharedAssembled::rows_near_free_boundary(const std::vector<bool> &active) const
  {
    if (volumes)
      return {}; // see Assembled
    return unilateral::rows_near_free_boundary(multigrid->matrix(), B, active, shared_unknowns);
  }

  void SharedAssembled::change_tangent()
  {
    multigrid->set_diagonal(own_tangent_diagonal);
    conjugate_gradients.forget_spectrum();
    if (volumes)
      volumes->forget_spectrum();
  }

  LinearSolve SharedAssembled::solve_tangent(const Vector &d, const Vector &rhs, const SolveTolerance &tolerance, Vector &x, Vector *Ax)
  {
    set_tangent(d);
    const LinearMap T = [this](Vector &Tv, const Vector &v)
    {
      multigrid->matrix().vmult(Tv, v);
      B.add_penalty_product(own_tangent_diagonal, Tv, v);
      shared_unknowns.add(Tv.begin());
      ++applications;
    };
    const LinearMap     precondition = [this](Vector &z, const Vector &r) { multigrid->vmult(z, r); };
    const ScalarProduct product = [this](const Vector &u, const Vector &v) { return dot(u, v); };
    const LinearSolve   result = volumes
                                   ? volumes->solve(T, precondition, rhs, tolerance, MixedSolver::most_steps, x)
                                   : conjugate_gradients.solve(T, precondition, rhs, product,
                                                               with_least_iterations(tolerance, LinearSolver::Parameters().least_iterations),
                                                               LinearSolver::Parameters().max_iterations, x);
    if (Ax)
      apply_stiffness(*Ax, x);
    return result;
  }

  template <int dim>
  bool SharedAssembled::set_data(const Problem<dim> &problem, const ConstraintSet<dim> &constraint_set)
  {
    if (!take_bounds(problem, constraint_set))
      return false;
    const auto            &dirichlet = problem.space.dirichlet;
    dealii::Vector<double> own_load(f.size());
    for_each_local_system<dim>(
      problem, [&](const LocalSystem &local) { dirichlet.distribute_local_to_global(local.load, local.dofs, own_load, local.matrix); },
      parts_of_volume(volumes != nullptr));
    if (volumes)
      volume_rows(problem, own_load);
    take_load(problem, own_load);
    return true;
  }

#define INSTANTIATE(dim)                                                                                                                   \
  template SharedAssembled::SharedAssembled(const Problem<dim> &, const ConstraintSet<dim> &);                                             \
  template bool SharedAssembled::set_data(const Problem<dim> &, const ConstraintSet<dim> &);
  INSTANTIATE(1)
  INSTANTIATE(2)
  INSTANTIATE(3)
#undef INSTANTIATE
} // namespace unilateral
