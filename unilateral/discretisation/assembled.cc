#include "unilateral/discretisation/assembled.h"

#include "unilateral/algebra/iterative_refinement.h"
#include "unilateral/algebra/nonnegative_minimum.h"
#include "unilateral/discretisation/block_assembly.h"
#include "unilateral/discretisation/element_systems.h"
#include "unilateral/discretisation/free_boundary_rows.h"
#include "unilateral/discretisation/memory_estimate.h"
#include "unilateral/discretisation/rigid_body_modes.h"
#include "unilateral/discretisation/vertex_volumes.h"
#include "unilateral/discretisation/volume_rows.h"
#include "unilateral/spaces/linear_subspaces.h"

#include <deal.II/base/mpi.h>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <exception>
#include <utility>

namespace unilateral
{
  using namespace dealii;

  namespace
  {
    /// Where all of them touch, a contact set means a dense system of so many unknowns: seconds.
    constexpr std::size_t most_points_at_once = 3000;

    /// A dense quadratic program for more of them would take longer than Newton's method.
    constexpr std::size_t most_points_of_dense_program = 1500;

    /// What one solve may leave of a residual. More shows that rounding has spoilt the factorisation.
    constexpr double largest_gain = 1e-4;
  } // namespace

  void Assembled::apply_stiffness(Vector &Au, const Vector &u) const
  {
    apply_without_volumes(Au, u);
    if (volumes)
      volumes->add_product(Au, u);
  }

  void Assembled::apply_without_volumes(Vector &Au, const Vector &u) const
  {
    if (keeps_blocks())
      multigrid->matrix().vmult(Au, u);
    else
      stiffness.vmult(Au, u);
    ++applications;
  }

  void Assembled::apply_gram(Vector &Hu, const Vector &u) const
  {
    Assert(has_gram(), ExcMessage("assemble() was not asked for the Gram matrix"));
    gram.vmult(Hu, u);
  }

  LinearSolve Assembled::solve_tangent(const Vector &d, const Vector &rhs, const SolveTolerance &tolerance, Vector &x, Vector *Ax)
  {
    if (!tangent_is_set || !std::equal(d.begin(), d.end(), tangent_diagonal.begin()))
    {
      tangent_is_set = false; // should the factorisation throw
      set_tangent(d);
      tangent_is_set = true;
    }
    const LinearSolve result = solve_with_tangent(rhs, tolerance, x);
    if (Ax)
      apply_stiffness(*Ax, x);
    return result;
  }

  void Assembled::set_tangent(const Vector &d)
  {
    tangent_diagonal = d;
    if (factorise_once && !factored_once)
      try_to_factorise_once();
    if (factored_once)
      return factored_once->set_diagonal(d);
    if (multigrid)
    {
      conjugate_gradients.forget_spectrum();
      if (volumes)
        volumes->forget_spectrum();
      return multigrid->set_diagonal(d);
    }
    if (tangent.empty())
      tangent.reinit(sparsity);
    tangent.copy_from(stiffness);
    add_penalty(tangent, {B.row_start, B.columns, B.values}, d);
    linear_solver->set_matrix(tangent);
  }

  LinearSolve Assembled::solve_with_tangent(const Vector &rhs, const SolveTolerance &tolerance, Vector &x)
  {
    const LinearMap T = [this](Vector &Tv, const Vector &v) { multiply_by_tangent(Tv, v); };
    if (multigrid)
      return solve_with_multigrid(T, rhs, tolerance, x);
    if (!factored_once)
      return linear_solver->solve(rhs, tolerance, x);
    double            gain = 0;
    const Vector      start(x);
    const LinearSolve result = solve_with_refinement(
      T, [this](Vector &z, const Vector &r) { factored_once->solve(z, r); }, rhs, [](const Vector &a, const Vector &b) { return a * b; },
      tolerance, x, &gain);
    if (result.converged && gain <= largest_gain)
      return result;
    // Rounding has spoilt it: A alone may be much closer to singular than A + B'DB.
    factorise_once = false;
    factored_once.reset();
    x = start;
    set_tangent(Vector(tangent_diagonal));
    return linear_solver->solve(rhs, tolerance, x);
  }

  bool Assembled::solve_for_pressure(const double epsilon, Vector &u, Vector &lambda)
  {
    if (B.n_points() > most_points_of_dense_program)
      return false;
    if (factorise_once && !factored_once)
      try_to_factorise_once();
    const Eigen::MatrixXd *const G = factored_once ? factored_once->compliance() : nullptr;
    if (!G)
      return false;
    tangent_is_set = false;
    Vector no_contact, trace;
    for (Vector *const q : {&no_contact, &trace, &lambda})
      initialize_point_vector(*q);
    initialize_dof_vector(u);
    factored_once->set_diagonal(no_contact);
    factored_once->solve(u, f);
    apply_trace(trace, u);

    // B u - s <= epsilon lambda with u = A^-1 (f - B'W lambda), in terms of the forces W lambda.
    const Eigen::Index n = B.n_points();
    Eigen::MatrixXd    M = *G;
    Eigen::VectorXd    gap(n);
    for (Eigen::Index i = 0; i < n; ++i)
    {
      M(i, i) += epsilon / B.weights(i);
      gap(i) = trace(i) - B.obstacle(i);
    }
    const Eigen::VectorXd forces = nonnegative_minimum(M, gap);
    for (Eigen::Index i = 0; i < n; ++i)
      lambda(i) = forces(i) / B.weights(i);

    Vector rest(f), contact;
    initialize_dof_vector(contact);
    apply_trace_transpose(contact, lambda);
    rest -= contact;
    factored_once->solve(u, rest);
    return true;
  }

  LinearSolve Assembled::solve_with_multigrid(const LinearMap &T, const Vector &rhs, const SolveTolerance &tolerance, Vector &x)
  {
    const LinearMap precondition = [this](Vector &z, const Vector &r) { multigrid->vmult(z, r); };
    LinearSolve     result;
    if (volumes)
      result = volumes->solve(
        [this](Vector &Tv, const Vector &v)
        {
          apply_without_volumes(Tv, v);
          B.add_penalty_product(tangent_diagonal, Tv, v);
        },
        precondition, rhs, tolerance, MixedSolver::most_steps, x);
    else
      result = conjugate_gradients.solve(
        T, precondition, rhs, [](const Vector &a, const Vector &b) { return a * b; },
        with_least_iterations(tolerance, LinearSolver::Parameters().least_iterations), LinearSolver::Parameters().max_iterations, x);
    if (result.failure.find("not positive definite") != std::string::npos)
      result.failure += ", or its preconditioner, which works in single precision, is not";
    return result;
  }

  /// (A + B' D B) x.
  void Assembled::multiply_by_tangent(Vector &Tx, const Vector &x)
  {
    apply_stiffness(Tx, x);
    B.add_penalty_product(tangent_diagonal, Tx, x);
  }

  LocalRows Assembled::rows_near_free_boundary(const std::vector<bool> &active) const
  {
    if (volumes)
      return {}; // moving the unknowns of one node at a time changes volumes, which is all that counts then
    return keeps_blocks() ? unilateral::rows_near_free_boundary(multigrid->matrix(), B, active)
                          : unilateral::rows_near_free_boundary(stiffness, B, active);
  }

  /// @p in_blocks: A, where `stiffness` is empty.
  void Assembled::finish(const SymmetricBlockMatrix &in_blocks, std::optional<OwnSparseRows> rows_of_volumes)
  {
    diagonal.reinit(f.size());
    for (std::size_t j = 0; j < f.size(); ++j)
      diagonal(j) = stiffness.empty() ? in_blocks.diagonal_entry(j) : stiffness.diag_element(j);
    if (rows_of_volumes)
    {
      volumes = std::make_unique<MixedSolver>(std::move(*rows_of_volumes), diagonal);
      volumes->add_to_diagonal(diagonal);
    }
    set_scales();
  }

  /// What the numbers of unknowns and points say, before there is a matrix.
  template <int dim>
  Assembled::Factorisation Assembled::factorisation_by_size(const Problem<dim> &problem, const Parameters &parameters, const Volumes kept)
  {
    const auto       &form = *problem.form;
    const std::size_t n = problem.space.dof_handler.n_dofs();
    if (kept == Volumes::apart || (parameters.solver == Method::Solver::amg && form.order() <= 1))
      return Factorisation::no;
    const auto &bounds = problem.conditions;
    factorise_once = is_symmetric && dim > 1 && B.n_points() > 0 && B.n_points() <= most_points_at_once &&
                     std::all_of(bounds.begin(), bounds.end(), [](const auto &bound) { return bound.part.has_value(); });
    if (parameters.solver == Method::Solver::direct || form.order() > 1) // aggregation knows nothing of fourth-order problems
      return Factorisation::yes;
    if (dim == 1 || n <= (dim == 2 ? parameters.direct_limit_2d : parameters.direct_limit_3d))
    {
      why_this_solver = "the quickest at this size";
      return Factorisation::yes;
    }
    factorise_once = factorise_once && form.n_components() > 1 && n <= (dim == 2 ? parameters.order_limit_2d : parameters.order_limit_3d);
    return factorise_once ? Factorisation::if_quick : Factorisation::no;
  }

  bool Assembled::one_factorisation_is_quick(const Parameters &parameters, const double volume_to_shape_stiffness)
  {
    try
    {
      prepare_to_factorise_once();
    }
    catch (const std::exception &) // too large
    {
      factorise_once = false;
      return false;
    }
    const double entries = prepared->predicted_entries(), operations = prepared->predicted_operations();
    const auto   memory = available_memory();
    // Smoothing node by node hardly sees what changes the shape alone: iterations grow with the ratio.
    const double affordable = parameters.operations_per_entry * std::max(1., std::min(volume_to_shape_stiffness, 100.));
    const bool   quick =
      operations <= affordable * stiffness.n_nonzero_elements() &&
      (!memory || sizeof(double) * entries * Utilities::MPI::n_mpi_processes(MPI_COMM_WORLD) <= parameters.part_of_memory * *memory);
    if (quick)
      why_this_solver = fmt::format("one factorisation for all contact sets ({:.2g} million numbers, {:.2g} billion operations)",
                                    1e-6 * entries, 1e-9 * operations);
    else
      prepared.reset();
    factorise_once = quick;
    return quick;
  }

  void Assembled::prepare_to_factorise_once()
  {
    prepared = std::make_unique<UpdatedCholesky>(stiffness, SparseRows{B.row_start, B.columns, B.values}, modes);
  }

  /// Else each contact set has a factorisation of its own.
  void Assembled::try_to_factorise_once()
  {
    factorise_once = false;
    try
    {
      if (!prepared)
        prepare_to_factorise_once();
      prepared->factorise();
      factored_once = std::move(prepared);
    }
    catch (const std::exception &) // A is not positive definite by its pivots, or too large
    {
      prepared.reset();
    }
  }

  namespace
  {
    template <int dim>
    bool can_keep_volumes_apart(const Problem<dim> &problem)
    {
      return dim > 1 && problem.symmetric() && has_volume_rows(problem);
    }

    /// A factorisation with them may be within reach.
    template <int dim>
    bool may_factorise_volumes(const Problem<dim> &problem, const Assembled::Parameters &parameters)
    {
      if (!VertexVolumes<dim>::any(problem))
        return parameters.solver != Method::Solver::amg;
      const std::size_t limit = (dim == 2 ? parameters.volumes_limit_2d : parameters.volumes_limit_3d) *
                                (problem.space.element.degree == 1 ? parameters.volumes_limit_factor_linear : 1);
      return parameters.solver == Method::Solver::direct ||
             (parameters.solver == Method::Solver::automatic && problem.space.dof_handler.n_dofs() <= limit);
    }
  } // namespace

  /// @p in_blocks: A, where `stiffness` is empty.
  template <int dim>
  void Assembled::make_iterative_solver(const Problem<dim> &problem, SymmetricBlockMatrix in_blocks)
  {
    LinearSolver::Parameters solver;
    solver.symmetric = is_symmetric;
    const auto &form = *problem.form;
    if (form.n_components() > 1)
      solver.near_null_space =
        modes_at_unknowns(problem, form.rigid_body_modes(problem.space.mesh.triangulation->begin_active()->center()));
    if (is_symmetric)
    {
      if (!stiffness.empty())
        in_blocks = SymmetricBlockMatrix(stiffness, block_size(problem));
      return make_multigrid(problem.space, std::move(solver.near_null_space), std::move(in_blocks));
    }
    solver.block_size = block_size(problem);
    solver.method = LinearSolver::Method::amg;
    solver.higher_order = problem.space.element.degree > 1;
    linear_solver = std::make_unique<LinearSolver>(solver);
    why_this_solver = "algebraic multigrid";
  }

  template <int dim>
  void Assembled::make_multigrid(const FunctionSpace<dim> &space, std::vector<Vector> near_null_space, SymmetricBlockMatrix in_blocks)
  {
    if (!has_gram())
    {
      stiffness.clear();
      sparsity.reinit(0, 0, 0);
    }
    std::vector<OwnSparseRows> prolongations;
    const auto                 family = space.element.family;
    if (family == ElementName::Family::P || family == ElementName::Family::Q)
    {
      auto linear = linear_subspaces(space);
      prolongations = std::move(linear.prolongations);
      if (!linear.at_vertex.empty())
        for (Vector &mode : near_null_space)
          mode = values_at_vertices(mode, linear.at_vertex.back());
    }
    const unsigned b = in_blocks.block_size();
    multigrid =
      std::make_unique<GalerkinMultigrid>(std::move(in_blocks), SparseRows{B.row_start, B.columns, B.values}, std::move(prolongations),
                                          GalerkinMultigrid::Parameters{.block_size = b, .near_null_space = std::move(near_null_space)});
    why_this_solver = multigrid->description();
    if (volumes)
      why_this_solver += ", for displacements and the tension of nearly incompressible volumes together";
  }

  /// Null where volumes are included and nothing is factorised, though they could be apart: then an iteration has to have them apart.
  template <int dim>
  std::unique_ptr<Assembled> assemble_with(const Volumes                volumes,
                                           const Problem<dim>          &problem,
                                           const ConstraintSet<dim>    &constraint_set,
                                           const Assembled::Parameters &parameters,
                                           const bool                   with_gram)
  {
    auto        result = std::make_unique<Assembled>();
    auto       &discrete = *result;
    const auto &dirichlet = problem.space.dirichlet;
    const auto  n_dofs = problem.space.dof_handler.n_dofs();

    discrete.is_symmetric = problem.symmetric();
    discrete.B = ConstraintTrace(constraint_set, dirichlet);
    const auto factorisation = discrete.factorisation_by_size(problem, parameters, volumes);
    const bool can_be_apart = volumes == Volumes::included && !with_gram && can_keep_volumes_apart(problem);
    if (factorisation == Assembled::Factorisation::no && can_be_apart)
      return nullptr;
    const bool needs_rows = with_gram || factorisation != Assembled::Factorisation::no || !discrete.is_symmetric ||
                            (volumes == Volumes::included && VertexVolumes<dim>::any(problem));

    dealii::Vector<double> load(n_dofs);
    SymmetricBlockMatrix   in_blocks;
    if (needs_rows)
    {
      make_coupling_pattern(problem, discrete.sparsity, volumes);
      discrete.stiffness.reinit(discrete.sparsity);
      for_each_local_system<dim>(
        problem,
        [&](const LocalSystem &local)
        { dirichlet.distribute_local_to_global(local.matrix, local.load, local.dofs, discrete.stiffness, load); },
        volumes);
    }
    else
      in_blocks = assemble_blocks(problem, block_size(problem), volumes, load);
    std::optional<OwnSparseRows> rows_of_volumes;
    if (volumes == Volumes::apart)
      rows_of_volumes = volume_rows(problem, load).C;
    if (with_gram)
    {
      discrete.gram.reinit(discrete.sparsity);
      for_each_local_gram<dim>(problem, problem.cell_quadrature(),
                               [&](const LocalSystem &local)
                               { dirichlet.distribute_local_to_global(local.matrix, local.dofs, discrete.gram); });
    }
    dirichlet.set_zero(load);
    discrete.f.reinit(n_dofs);
    std::copy(load.begin(), load.end(), discrete.f.begin());

    discrete.null_vectors = modes_at_unknowns(problem, problem.null_space);
    discrete.modes = modes_at_unknowns(problem, problem.unsupported);
    discrete.finish(in_blocks, std::move(rows_of_volumes));
    const double volume_to_shape = problem.form->volume_to_shape_stiffness();
    if (factorisation == Assembled::Factorisation::yes ||
        (factorisation == Assembled::Factorisation::if_quick && discrete.one_factorisation_is_quick(parameters, volume_to_shape)))
      discrete.linear_solver = std::make_unique<LinearSolver>(LinearSolver::Parameters{.symmetric = discrete.is_symmetric});
    else if (can_be_apart)
      return nullptr;
    else
      discrete.make_iterative_solver(problem, std::move(in_blocks));
    return result;
  }

  template <int dim>
  std::unique_ptr<Assembled> assemble(const Problem<dim>          &problem,
                                      const ConstraintSet<dim>    &constraint_set,
                                      const Assembled::Parameters &parameters,
                                      const bool                   with_gram)
  {
    if (with_gram || !can_keep_volumes_apart(problem) || may_factorise_volumes(problem, parameters))
      if (auto result = assemble_with(Volumes::included, problem, constraint_set, parameters, with_gram))
        return result;
    return assemble_with(Volumes::apart, problem, constraint_set, parameters, with_gram);
  }

  template <int dim>
  bool Assembled::set_data(const Problem<dim> &problem, const ConstraintSet<dim> &constraint_set)
  {
    const auto     &dirichlet = problem.space.dirichlet;
    ConstraintTrace trace(constraint_set, dirichlet);
    if (!trace.same_rows(B))
      return false;
    B.obstacle.swap(trace.obstacle);
    dealii::Vector<double> load(f.size());
    for_each_local_system<dim>(
      problem, [&](const LocalSystem &local) { dirichlet.distribute_local_to_global(local.load, local.dofs, load, local.matrix); },
      volumes ? Volumes::apart : Volumes::included);
    if (volumes)
      volume_rows(problem, load);
    dirichlet.set_zero(load);
    std::copy(load.begin(), load.end(), f.begin());
    return true;
  }

#define INSTANTIATE(dim)                                                                                                                   \
  template std::unique_ptr<Assembled> assemble(const Problem<dim> &, const ConstraintSet<dim> &, const Assembled::Parameters &, bool);     \
  template bool                       Assembled::set_data(const Problem<dim> &, const ConstraintSet<dim> &);
  INSTANTIATE(1)
  INSTANTIATE(2)
  INSTANTIATE(3)
#undef INSTANTIATE
} // namespace unilateral
