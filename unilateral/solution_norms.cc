#include "unilateral/solution_norms.h"

#include <deal.II/base/quadrature_lib.h>
#include <deal.II/dofs/dof_tools.h>
#include <deal.II/grid/grid_tools.h>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cmath>

namespace unilateral
{
  using namespace dealii;
  using VectorType = LinearAlgebra::distributed::Vector<double>;

  namespace
  {
    /// By how much a point lies outside the reference cell: 0 inside.
    template <int dim>
    double outside_reference_cell(const Point<dim> &x, const bool simplex)
    {
      double excess = 0, sum = 0;
      for (unsigned d = 0; d < dim; ++d)
      {
        excess = std::max({excess, -x[d], simplex ? 0. : x[d] - 1});
        sum += x[d];
      }
      return simplex ? std::max(excess, sum - 1) : excess;
    }
  } // namespace

  template <int dim>
  SolutionNorms solution_norms(const Problem<dim> &problem, const VectorType &u)
  {
    SolutionNorms               norms;
    FEValues<dim>               values(*problem.mapping, *problem.fe, problem.cell_quadrature(),
                                       update_values | update_gradients | update_quadrature_points | update_JxW_values);
    FEFaceValues<dim>           face_values(*problem.mapping, *problem.fe, problem.face_quadrature(),
                                            update_values | update_quadrature_points | update_JxW_values);
    std::vector<double>         u_at(values.n_quadrature_points), u_on_face(face_values.n_quadrature_points);
    std::vector<Tensor<1, dim>> gradient_at(values.n_quadrature_points);
    for (const auto &cell : problem.dof_handler.active_cell_iterators())
    {
      values.reinit(cell);
      values.get_function_values(u, u_at);
      values.get_function_gradients(u, gradient_at);
      const auto &coefficients = problem.coefficients(cell);
      for (const unsigned q : values.quadrature_point_indices())
      {
        const Point<dim>    &x = values.quadrature_point(q);
        const Tensor<1, dim> flux = coefficients.stiffness_tensor(x) * gradient_at[q];
        const double         a =
          flux * gradient_at[q] + (coefficients.velocity_vector(x) * gradient_at[q] + coefficients.reaction.value(x) * u_at[q]) * u_at[q];
        norms.energy += (0.5 * a - coefficients.load.value(x) * u_at[q]) * values.JxW(q);
        norms.L2 += u_at[q] * u_at[q] * values.JxW(q);
        norms.H1_semi += gradient_at[q].norm_square() * values.JxW(q);
      }
      for (const auto face : cell->face_indices())
        if (cell->face(face)->at_boundary())
        {
          const auto &condition = problem.boundary_condition(cell->face(face)->boundary_id());
          if (condition.value || (condition.flux.is_zero() && condition.spring.is_zero()))
            continue;
          face_values.reinit(cell, face);
          face_values.get_function_values(u, u_on_face);
          for (const unsigned q : face_values.quadrature_point_indices())
          {
            const Point<dim> &x = face_values.quadrature_point(q);
            norms.energy += (0.5 * condition.spring.value(x) * u_on_face[q] - condition.flux.value(x)) * u_on_face[q] * face_values.JxW(q);
          }
        }
    }
    norms.L2 = std::sqrt(norms.L2);
    norms.H1_semi = std::sqrt(norms.H1_semi);
    norms.min = *std::min_element(u.begin(), u.end());
    norms.max = *std::max_element(u.begin(), u.end());
    return norms;
  }

  template <int dim>
  Errors solution_errors(const Problem<dim>       &problem,
                         const ConstraintSet<dim> &constraint_set,
                         const VectorType         &u,
                         const VectorType         &contact_pressure)
  {
    const Case &request = problem.request;
    Errors      errors;
    if (request.exact.u)
    {
      const FieldFunction   exact(*request.exact.u, request.parameters);
      const Quadrature<dim> quadrature =
        problem.element.simplex() ? Quadrature<dim>(QGaussSimplex<dim>(4)) : Quadrature<dim>(QGauss<dim>(problem.element.degree + 3));
      FEValues<dim>               values(*problem.mapping, *problem.fe, quadrature,
                                         update_values | update_gradients | update_quadrature_points | update_JxW_values);
      std::vector<double>         u_at(quadrature.size());
      std::vector<Tensor<1, dim>> gradient_at(quadrature.size());
      double                      L2 = 0, H1_semi = 0;
      for (const auto &cell : problem.dof_handler.active_cell_iterators())
      {
        values.reinit(cell);
        values.get_function_values(u, u_at);
        values.get_function_gradients(u, gradient_at);
        for (const unsigned q : values.quadrature_point_indices())
        {
          const Point<dim> &x = values.quadrature_point(q);
          const double      error = u_at[q] - exact.value(x);
          L2 += error * error * values.JxW(q);
          H1_semi += (gradient_at[q] - exact.gradient(x)).norm_square() * values.JxW(q);
        }
      }
      errors.L2 = std::sqrt(L2);
      errors.H1_semi = std::sqrt(H1_semi);

      std::vector<Point<dim>> nodes(problem.dof_handler.n_dofs());
      DoFTools::map_dofs_to_support_points(*problem.mapping, problem.dof_handler, nodes);
      double max = 0, sum = 0;
      for (std::size_t j = 0; j < nodes.size(); ++j)
      {
        const double error = std::abs(u(j) - exact.value(nodes[j]));
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
    for (std::size_t k = 0; k < problem.request.output.probes.size(); ++k)
    {
      const auto &coordinates = problem.request.output.probes[k];
      Point<dim>  p;
      for (unsigned d = 0; d < dim; ++d)
        p[d] = coordinates[d];

      // The best of all cells near the point: it may lie a little outside a straight-sided mesh of a curved domain.
      double best_excess = std::numeric_limits<double>::max(), value = 0;
      for (const auto &cell : problem.dof_handler.active_cell_iterators())
      {
        if (cell->center().distance(p) > cell->diameter())
          continue;
        Point<dim> unit;
        try
        {
          unit = problem.mapping->transform_real_to_unit_cell(cell, p);
        }
        catch (const typename Mapping<dim>::ExcTransformationFailed &)
        {
          continue;
        }
        const double excess = outside_reference_cell(unit, problem.element.simplex());
        if (excess >= best_excess)
          continue;
        best_excess = excess;
        cell->get_dof_indices(dofs);
        value = 0;
        for (unsigned i = 0; i < dofs.size(); ++i)
          value += u(dofs[i]) * fe.shape_value(i, unit);
        if (excess == 0)
          break;
      }
      if (best_excess > 0.05)
        value = std::numeric_limits<double>::quiet_NaN();
      results.push_back({coordinates, value});
    }
    return results;
  }

#define INSTANTIATE(dim)                                                                                                                   \
  template SolutionNorms solution_norms(const Problem<dim> &, const VectorType &);                                                         \
  template Errors        solution_errors(const Problem<dim> &, const ConstraintSet<dim> &, const VectorType &, const VectorType &);        \
  template std::vector<ProbeResult> probe_values(const Problem<dim> &, const VectorType &);
  INSTANTIATE(1)
  INSTANTIATE(2)
  INSTANTIATE(3)
#undef INSTANTIATE
} // namespace unilateral
