#include "unilateral/solution_norms.h"

#include "unilateral/case_on_mesh.h"
#include "unilateral/elasticity.h"
#include "unilateral/equilibrium.h"
#include "unilateral/estimator.h"
#include "unilateral/local_systems.h"
#include "unilateral/point_location.h"

#include <deal.II/base/quadrature_lib.h>
#include <deal.II/grid/grid_tools.h>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cmath>

namespace unilateral
{
  using namespace dealii;
  using VectorType = LinearAlgebra::distributed::Vector<double>;

  template <int dim>
  SolutionNorms solution_norms(const Problem<dim> &problem, const VectorType &u)
  {
    SolutionNorms                            norms;
    const unsigned                           n_components = problem.form->n_components();
    const bool                               bending = problem.form->order() > 1;
    FEValues<dim>                            values(*problem.mapping, *problem.fe, problem.cell_quadrature(), cell_flags(*problem.form));
    std::vector<Tensor<2, dim>>              hessian_at(values.n_quadrature_points);
    std::vector<dealii::Vector<double>>      u_at(values.n_quadrature_points, dealii::Vector<double>(n_components));
    std::vector<std::vector<Tensor<1, dim>>> gradient_at(values.n_quadrature_points, std::vector<Tensor<1, dim>>(n_components));
    for (const auto &cell : problem.dof_handler.active_cell_iterators())
    {
      values.reinit(cell);
      values.get_function_values(u, u_at);
      values.get_function_gradients(u, gradient_at);
      if (bending)
        values.get_function_hessians(u, hessian_at);
      for (const unsigned q : values.quadrature_point_indices())
      {
        const double w = values.JxW(q) * problem.form->measure(values.quadrature_point(q));
        norms.L2 += u_at[q].norm_sqr() * w;
        for (const auto &gradient : gradient_at[q])
          norms.H1_semi += gradient.norm_square() * w;
        if (bending)
          norms.H2_semi += hessian_at[q].norm_square() * w;
      }
    }
    norms.energy = energy(problem, u);
    norms.L2 = std::sqrt(norms.L2);
    norms.H1_semi = std::sqrt(norms.H1_semi);
    norms.H2_semi = std::sqrt(norms.H2_semi);
    norms.min = std::numeric_limits<double>::max();
    norms.max = std::numeric_limits<double>::lowest();
    const auto is_value = problem.values_among_unknowns();
    for (types::global_dof_index dof = 0; dof < u.size(); ++dof)
      if (is_value[dof])
      {
        norms.min = std::min(norms.min, u(dof));
        norms.max = std::max(norms.max, u(dof));
      }
    return norms;
  }

  template <int dim>
  double largest_violation(const Problem<dim> &problem, const UnilateralCondition &condition, const VectorType &u)
  {
    const unsigned        n = 4 * std::max(problem.element.degree, 1u);
    const Quadrature<dim> lattice =
      problem.element.simplex() ? Quadrature<dim>(QGaussSimplex<dim>(4)) : Quadrature<dim>(QIterated<dim>(QTrapezoid<1>(), n));
    FEValues<dim>       values(*problem.mapping, *problem.fe, lattice, update_values | update_quadrature_points);
    std::vector<double> u_at(lattice.size());
    double              largest = 0;
    for (const auto &cell : problem.dof_handler.active_cell_iterators())
    {
      values.reinit(cell);
      values.get_function_values(u, u_at);
      for (const unsigned q : values.quadrature_point_indices())
      {
        const double excess = u_at[q] - condition.bound.value(values.quadrature_point(q));
        largest = std::max(largest, condition.side == Side::upper ? excess : -excess);
      }
    }
    return largest;
  }

  template <int dim>
  Errors solution_errors(const Problem<dim>       &problem,
                         const ConstraintSet<dim> &constraint_set,
                         const VectorType         &u,
                         const VectorType         &contact_pressure)
  {
    const Case &request = problem.request;
    Errors      errors;
    if (!request.exact.u.empty())
    {
      const std::vector<FieldFunction> exact = compile(request.exact.u, request);
      const unsigned                   n_components = exact.size();
      const Quadrature<dim>            quadrature =
        problem.element.simplex() ? Quadrature<dim>(QGaussSimplex<dim>(4)) : Quadrature<dim>(QGauss<dim>(problem.element.degree + 3));
      const bool                               bending = problem.form->order() > 1;
      FEValues<dim>                            values(*problem.mapping, *problem.fe, quadrature, cell_flags(*problem.form));
      std::vector<Tensor<2, dim>>              hessian_at(quadrature.size());
      std::vector<dealii::Vector<double>>      u_at(quadrature.size(), dealii::Vector<double>(n_components));
      std::vector<std::vector<Tensor<1, dim>>> gradient_at(quadrature.size(), std::vector<Tensor<1, dim>>(n_components));
      double                                   L2 = 0, H1_semi = 0, H2_semi = 0;
      for (const auto &cell : problem.dof_handler.active_cell_iterators())
      {
        values.reinit(cell);
        values.get_function_values(u, u_at);
        values.get_function_gradients(u, gradient_at);
        if (bending)
          values.get_function_hessians(u, hessian_at);
        for (const unsigned q : values.quadrature_point_indices())
        {
          const Point<dim> &x = values.quadrature_point(q);
          const double      w = values.JxW(q) * problem.form->measure(x);
          for (unsigned c = 0; c < n_components; ++c)
          {
            const double error = u_at[q](c) - exact[c].value(x);
            L2 += error * error * w;
            H1_semi += (gradient_at[q][c] - exact[c].gradient(x)).norm_square() * w;
          }
          if (bending)
            H2_semi += (hessian_at[q] - exact[0].hessian(x)).norm_square() * w;
        }
      }
      errors.L2 = std::sqrt(L2);
      errors.H1_semi = std::sqrt(H1_semi);
      if (bending)
        errors.H2_semi = std::sqrt(H2_semi);

      // Every component at every node.
      const auto nodes = problem.nodal_values();
      double     max = 0, sum = 0;
      for (const auto &node : nodes)
      {
        const double error = std::abs(u(node.dof) - exact[node.component].value(node.x));
        max = std::max(max, error);
        sum += error;
      }
      errors.max_nodal = max;
      errors.mean_nodal = sum / nodes.size();
    }
    if (request.exact.pressure && !constraint_set.blocks.empty())
    {
      const FieldFunction exact(*request.exact.pressure, request.parameters);
      double              sum = 0;
      for (std::size_t i = constraint_set.blocks[0].begin; i < constraint_set.blocks[0].end; ++i)
      {
        const double error = contact_pressure(i) - exact.value(constraint_set.points[i]);
        sum += constraint_set.weights[i] * error * error;
      }
      errors.pressure_L2 = std::sqrt(sum);
    }
    return errors;
  }

  template <int dim>
  std::vector<ProbeResult> probe_values(const Problem<dim> &problem, const VectorType &u)
  {
    std::vector<ProbeResult>             results;
    const auto                          &fe = *problem.fe;
    std::vector<types::global_dof_index> dofs(fe.n_dofs_per_cell());
    const bool                           body = problem.form->n_components() > 1;
    std::optional<RecoveredFlux<dim>>    recovered;
    if (body && !problem.request.output.probes.empty())
      recovered.emplace(problem, u);
    const auto                           scalar = body ? problem.scalar_element() : nullptr;
    std::vector<types::global_dof_index> nodes(body ? scalar->n_dofs_per_cell() : 0);
    for (const auto &coordinates : problem.request.output.probes)
    {
      const auto [owner, unit, outside] = locate(problem, to_point<dim>(coordinates));
      ProbeResult result{
        coordinates, std::vector<double>(problem.form->n_components(), std::numeric_limits<double>::quiet_NaN()), {}, 0, {}};
      if (outside <= 0.05)
      {
        owner->get_dof_indices(dofs);
        result.value.assign(result.value.size(), 0.);
        FEValues<dim> at_point(*problem.mapping, fe, Quadrature<dim>(unit), cell_flags(*problem.form));
        at_point.reinit(owner);
        dealii::Vector<double> local(dofs.size());
        for (unsigned i = 0; i < dofs.size(); ++i)
        {
          local(i) = u(dofs[i]);
          result.value[fe.system_to_component_index(i).first] += local(i) * at_point.shape_value(i, 0);
        }
        if (problem.form->order() > 1)
        {
          std::vector<Flux> moments;
          problem.form->flux(at_point, local, moments);
          result.moments.assign(moments[0].begin(), moments[0].begin() + problem.form->n_flux_components());
        }
        if (body)
        {
          Stress stress{};
          typename DoFHandler<dim>::active_cell_iterator(&*problem.mesh.triangulation, owner->level(), owner->index(), &*recovered->nodes)
            ->get_dof_indices(nodes);
          for (unsigned i = 0; i < nodes.size(); ++i)
            for (std::size_t c = 0; c < stress.size(); ++c)
              stress[c] += scalar->shape_value(i, unit) * recovered->at(nodes[i], owner->material_id())[c];
          result.stress = stress;
          result.von_mises = von_mises(stress);
        }
      }
      else if (body)
      {
        result.stress.emplace();
        result.stress->fill(std::numeric_limits<double>::quiet_NaN());
        result.von_mises = std::numeric_limits<double>::quiet_NaN();
      }
      results.push_back(std::move(result));
    }
    return results;
  }

#define INSTANTIATE(dim)                                                                                                                   \
  template double        largest_violation(const Problem<dim> &, const UnilateralCondition &, const VectorType &);                         \
  template SolutionNorms solution_norms(const Problem<dim> &, const VectorType &);                                                         \
  template Errors        solution_errors(const Problem<dim> &, const ConstraintSet<dim> &, const VectorType &, const VectorType &);        \
  template std::vector<ProbeResult> probe_values(const Problem<dim> &, const VectorType &);
  INSTANTIATE(1)
  INSTANTIATE(2)
  INSTANTIATE(3)
#undef INSTANTIATE
} // namespace unilateral
