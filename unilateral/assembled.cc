#include "unilateral/assembled.h"

#include "unilateral/free_motion.h"
#include "unilateral/local_systems.h"

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
    for (std::size_t i = 0; i + 1 < B.row_start.size(); ++i)
    {
      double sum = 0;
      for (std::size_t k = B.row_start[i]; k < B.row_start[i + 1]; ++k)
        sum += B.values[k] * u(B.columns[k]);
      Bu(i) = sum;
    }
  }

  void Assembled::apply_trace_transpose(Vector &BtWq, const Vector &q) const
  {
    BtWq = 0.;
    for (std::size_t i = 0; i + 1 < B.row_start.size(); ++i)
      if (const double wq = point_weights(i) * q(i); wq != 0)
        for (std::size_t k = B.row_start[i]; k < B.row_start[i + 1]; ++k)
          BtWq(B.columns[k]) += B.values[k] * wq;
  }

  LinearSolve Assembled::solve_tangent(const Vector &d, const Vector &rhs, const SolveTolerance &tolerance, Vector &x)
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
    return linear_solver->solve(rhs, tolerance, x);
  }

  std::string Assembled::linear_solver_name() const
  {
    return linear_solver->method() == LinearSolver::Method::direct ? "direct" : "amg";
  }

  void Assembled::finish()
  {
    tangent.reinit(sparsity);
    diagonal.reinit(stiffness.m());
    for (std::size_t j = 0; j < stiffness.m(); ++j)
      diagonal(j) = stiffness.diag_element(j);
    initialize_point_vector(local_compliance);
    initialize_dof_vector(BtWB_diagonal);
    for (std::size_t i = 0; i + 1 < B.row_start.size(); ++i)
      for (std::size_t k = B.row_start[i]; k < B.row_start[i + 1]; ++k)
      {
        const double wBB = point_weights(i) * B.values[k] * B.values[k];
        local_compliance(i) += wBB / diagonal(B.columns[k]);
        BtWB_diagonal(B.columns[k]) += wBB;
      }
  }

  namespace
  {
    LinearSolver::Method choose_method(const Assembled::Parameters &parameters, const unsigned dim, const std::size_t n_dofs)
    {
      if (parameters.solver == "direct")
        return LinearSolver::Method::direct;
      if (parameters.solver == "amg")
        return LinearSolver::Method::amg;
      const bool small = dim == 1 || n_dofs <= (dim == 2 ? parameters.direct_limit_2d : parameters.direct_limit_3d);
      return small ? LinearSolver::Method::direct : LinearSolver::Method::amg;
    }

    /// Unknowns dim i, ..., dim i + dim - 1 are the components at one node.
    template <int dim>
    bool nodes_are_blocks(const Problem<dim> &problem)
    {
      const auto                          &fe = *problem.fe;
      std::vector<types::global_dof_index> dofs(fe.n_dofs_per_cell());
      for (const auto &cell : problem.dof_handler.active_cell_iterators())
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

    /// Motions at the unknowns; zero where they are prescribed.
    template <int dim>
    std::vector<Vector> at_unknowns(const Problem<dim> &problem, const std::vector<Motion<dim>> &motions)
    {
      std::vector<Vector> result;
      for (const auto &motion : motions)
      {
        result.push_back(interpolate(problem, motion));
        for (const auto &line : problem.dirichlet.get_lines())
          result.back()(line.index) = 0;
      }
      return result;
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
    const auto &dirichlet = problem.dirichlet;
    const auto &form = *problem.form;
    const auto  n_dofs = problem.dof_handler.n_dofs();

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

    // B without the columns that the Dirichlet data fix; what they contribute goes to s.
    const std::size_t n_points = constraint_set.size();
    discrete.point_weights.reinit(n_points);
    discrete.s.reinit(n_points);
    discrete.B.row_start.assign(1, 0);
    for (std::size_t i = 0; i < n_points; ++i)
    {
      const double sign = constraint_set.sign[i];
      discrete.point_weights(i) = constraint_set.weights[i];
      discrete.s(i) = sign * constraint_set.bound[i];
      double     prescribed = 0;
      const auto row = resolved(constraint_set.trace[i], dirichlet, prescribed);
      discrete.s(i) -= sign * prescribed;
      for (std::size_t k = 0; k < row.dofs.size(); ++k)
      {
        discrete.B.columns.push_back(row.dofs[k]);
        discrete.B.values.push_back(sign * row.values[k]);
      }
      discrete.B.row_start.push_back(discrete.B.columns.size());
    }

    LinearSolver::Parameters solver;
    // Aggregation knows nothing of fourth-order problems.
    solver.method = form.order() > 1 ? LinearSolver::Method::direct : choose_method(parameters, dim, n_dofs);
    solver.symmetric = discrete.is_symmetric;
    solver.higher_order = problem.element.degree > 1;
    if (solver.method == LinearSolver::Method::amg && form.n_components() > 1)
    {
      solver.near_kernel = at_unknowns(problem, form.motions(problem.mesh.triangulation->begin_active()->center()));
      solver.block_size = nodes_are_blocks(problem) ? form.n_components() : 1;
    }
    discrete.linear_solver = std::make_unique<LinearSolver>(solver);
    discrete.motions = at_unknowns(problem, problem.kernel);
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
