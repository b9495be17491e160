#include "unilateral/evaluation/solution_errors.h"

#include "unilateral/forms/elasticity.h"
#include "unilateral/forms/membrane.h"
#include "unilateral/spaces/function_on_cells.h"

#include <deal.II/base/quadrature_lib.h>

#include <algorithm>
#include <cmath>

namespace unilateral
{
  using namespace dealii;
  using VectorType = LinearAlgebra::distributed::Vector<double>;

  namespace
  {
    /// Its energy is what [exact] can be compared with: not that of a body of revolution, nor one whose changes of volume are integrated in
    /// a reduced way.
    template <int dim>
    const Elasticity<dim> *body_with_energy(const Problem<dim> &problem)
    {
      const auto *const body = dynamic_cast<const Elasticity<dim> *>(problem.form.get());
      if (!body || problem.axisymmetric())
        return nullptr;
      bool reduced = false;
      for (const auto &cell : problem.space.dof_handler.active_cell_iterators())
        reduced = reduced || body->lame_parameters(cell->material_id(), cell->center()).reduced;
      return problem.space.processes().any(reduced) ? nullptr : body;
    }

    /// eps : C eps of the displacement with this gradient.
    template <int dim>
    double strain_energy(const Elasticity<dim> &body, const types::material_id region, const Point<dim> &x, const Tensor<2, dim> &gradient)
    {
      const auto           lame = body.lame_parameters(region, x);
      const Tensor<2, dim> strain = 0.5 * (gradient + transpose(gradient));
      return lame.lambda * std::pow(trace(gradient), 2) + 2 * lame.mu * strain.norm_square();
    }

    /// L2, H1 and, of order 4, H2 seminorm of u - exact, by quadrature with p + 3 points a direction.
    template <int dim>
    void add_errors_on_cells(const Problem<dim> &problem, const VectorType &u, const std::vector<FieldFunction> &exact, Errors &errors)
    {
      const Quadrature<dim>       rule = problem.space.element.simplex() ? Quadrature<dim>(QGaussSimplex<dim>(4))
                                                                         : Quadrature<dim>(QGauss<dim>(problem.space.element.degree + 3));
      const bool                  bending = problem.form->order() > 1;
      FunctionOnCells<dim>        u_on_cell(problem.space, rule, bending);
      std::vector<double>         exact_at;
      std::vector<Tensor<1, dim>> exact_gradient_at;
      const auto *const           membrane = dynamic_cast<const Membrane<dim> *>(problem.form.get());
      const auto *const           body = body_with_energy(problem);
      std::vector<Tensor<2, dim>> of_body(body ? rule.size() : 0);
      double                      L2 = 0, H1_semi = 0, H2_semi = 0, energy = 0;
      for (const auto &cell : problem.space.dof_handler.active_cell_iterators())
      {
        u_on_cell.reinit(cell, u);
        for (unsigned c = 0; c < exact.size(); ++c)
        {
          exact[c].values_and_gradients(u_on_cell.points(), exact_at, exact_gradient_at);
          for (unsigned q = 0; q < rule.size(); ++q)
          {
            const Point<dim> &x = u_on_cell.points()[q];
            const double      w = u_on_cell.weight(q) * problem.form->measure(x), error = u_on_cell.value(q, c) - exact_at[q];
            L2 += error * error * w;
            const Tensor<1, dim> gradient_error = u_on_cell.gradient(q, c) - exact_gradient_at[q];
            H1_semi += gradient_error.norm_square() * w;
            if (membrane)
            {
              const auto &coefficients = membrane->coefficients_in(cell->material_id());
              energy +=
                (gradient_error * (coefficients.stiffness_tensor(x) * gradient_error) + coefficients.reaction.value(x) * error * error) * w;
            }
            if (body)
              for (unsigned d = 0; d < dim; ++d)
                of_body[q][c][d] = gradient_error[d];
            if (bending)
              H2_semi += (u_on_cell.hessian(q, c) - exact[c].hessian(x)).norm_square() * w;
          }
        }
        for (unsigned q = 0; q < of_body.size(); ++q)
          energy += strain_energy(*body, cell->material_id(), u_on_cell.points()[q], of_body[q]) * u_on_cell.weight(q);
      }
      const Processes &processes = problem.space.processes();
      errors.L2 = std::sqrt(processes.sum(L2));
      errors.H1_semi = std::sqrt(processes.sum(H1_semi));
      if (membrane || body)
        errors.energy = std::sqrt(std::max(0., processes.sum(energy)));
      if (bending)
        errors.H2_semi = std::sqrt(H2_semi);
    }

    /// Largest and mean error of every component at every node.
    template <int dim>
    void add_errors_at_nodes(const Problem<dim> &problem, const VectorType &u, const std::vector<FieldFunction> &exact, Errors &errors)
    {
      const Processes                                  &processes = problem.space.processes();
      double                                            max = 0, sum = 0, n = 0;
      std::vector<std::vector<Point<dim>>>              points(exact.size());
      std::vector<std::vector<types::global_dof_index>> dofs(exact.size());
      for (const auto &node : problem.space.nodal_values())
        if (problem.space.shared().owns(node.dof))
        {
          points[node.component].push_back(node.x);
          dofs[node.component].push_back(node.dof);
        }
      std::vector<double> exact_at;
      for (std::size_t c = 0; c < exact.size(); ++c)
      {
        exact[c].values(points[c], exact_at);
        n += dofs[c].size();
        for (std::size_t i = 0; i < dofs[c].size(); ++i)
        {
          const double error = std::abs(u(dofs[c][i]) - exact_at[i]);
          max = std::max(max, error);
          sum += error;
        }
      }
      errors.max_nodal = processes.max(max);
      errors.mean_nodal = processes.sum(sum) / processes.sum(n);
    }
  } // namespace

  template <int dim>
  Errors solution_errors(const Problem<dim>       &problem,
                         const ConstraintSet<dim> &constraint_set,
                         const VectorType         &u,
                         const VectorType         &contact_pressure)
  {
    const auto running = problem.time_by_part.run("norms");
    const auto &[exact_u, exact_pressure] = problem.statement.exact;
    Errors errors;
    if (!exact_u.empty())
    {
      add_errors_on_cells(problem, u, exact_u, errors);
      add_errors_at_nodes(problem, u, exact_u, errors);
    }
    if (exact_pressure && !constraint_set.blocks.empty())
    {
      double sum = 0;
      for (std::size_t i = constraint_set.blocks[0].begin; i < constraint_set.blocks[0].end; ++i)
      {
        if (!constraint_set.owns(i))
          continue;
        const double error = contact_pressure(i) - exact_pressure->value(constraint_set.points[i].x);
        sum += constraint_set.points[i].weight * error * error;
      }
      errors.pressure_L2 = std::sqrt(problem.space.processes().sum(sum));
    }
    return errors;
  }

#define INSTANTIATE(dim)                                                                                                                   \
  template Errors solution_errors(const Problem<dim> &, const ConstraintSet<dim> &, const VectorType &, const VectorType &);
  INSTANTIATE(1)
  INSTANTIATE(2)
  INSTANTIATE(3)
#undef INSTANTIATE
} // namespace unilateral
