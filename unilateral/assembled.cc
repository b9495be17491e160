#include "unilateral/assembled.h"

#include <deal.II/dofs/dof_tools.h>
#include <deal.II/lac/dynamic_sparsity_pattern.h>

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
  } // namespace

  template <int dim>
  std::unique_ptr<Assembled> assemble(const Problem<dim>          &problem,
                                      const ConstraintSet<dim>    &constraint_set,
                                      const Assembled::Parameters &parameters,
                                      const bool                   with_gram)
  {
    auto        result = std::make_unique<Assembled>();
    auto       &discrete = *result;
    const auto &dof_handler = problem.dof_handler;
    const auto &dirichlet = problem.dirichlet;
    const auto  n_dofs = dof_handler.n_dofs();

    {
      DynamicSparsityPattern pattern(n_dofs);
      DoFTools::make_sparsity_pattern(dof_handler, pattern, dirichlet, /*keep_constrained_dofs=*/false);
      discrete.sparsity.copy_from(pattern);
    }
    discrete.stiffness.reinit(discrete.sparsity);
    if (with_gram)
      discrete.gram.reinit(discrete.sparsity);
    discrete.is_symmetric = problem.symmetric();

    dealii::Vector<double>               load(n_dofs);
    const unsigned                       n = problem.fe->n_dofs_per_cell();
    FullMatrix<double>                   cell_matrix(n, n), cell_gram(n, n);
    dealii::Vector<double>               cell_load(n);
    std::vector<types::global_dof_index> cell_dofs(n);
    FEValues<dim>                        values(*problem.mapping, *problem.fe, problem.cell_quadrature(),
                                                update_values | update_gradients | update_quadrature_points | update_JxW_values);
    FEFaceValues<dim>                    face_values(*problem.mapping, *problem.fe, problem.face_quadrature(),
                                                     update_values | update_quadrature_points | update_JxW_values);
    for (const auto &cell : dof_handler.active_cell_iterators())
    {
      cell_matrix = 0.;
      cell_load = 0.;
      values.reinit(cell);
      add_cell_terms(values, problem.coefficients(cell), cell_matrix, cell_load);
      for (const auto face : cell->face_indices())
        if (cell->face(face)->at_boundary())
        {
          const auto &condition = problem.boundary_condition(cell->face(face)->boundary_id());
          if (condition.value || (condition.flux.is_zero() && condition.spring.is_zero()))
            continue;
          face_values.reinit(cell, face);
          add_face_terms(face_values, condition, cell_matrix, cell_load);
        }
      cell->get_dof_indices(cell_dofs);
      dirichlet.distribute_local_to_global(cell_matrix, cell_load, cell_dofs, discrete.stiffness, load);
      if (with_gram)
      {
        cell_gram = 0.;
        add_gram_terms(values, cell_gram);
        dirichlet.distribute_local_to_global(cell_gram, cell_dofs, discrete.gram);
      }
    }
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
      const auto &row = constraint_set.trace[i];
      for (std::size_t k = 0; k < row.dofs.size(); ++k)
        if (dirichlet.is_constrained(row.dofs[k]))
          discrete.s(i) -= sign * row.values[k] * dirichlet.get_inhomogeneity(row.dofs[k]);
        else
        {
          discrete.B.columns.push_back(row.dofs[k]);
          discrete.B.values.push_back(sign * row.values[k]);
        }
      discrete.B.row_start.push_back(discrete.B.columns.size());
    }

    LinearSolver::Parameters solver;
    solver.method = choose_method(parameters, dim, n_dofs);
    solver.symmetric = discrete.is_symmetric;
    solver.higher_order = problem.element.degree > 1;
    discrete.linear_solver = std::make_unique<LinearSolver>(solver);
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
