#include "unilateral/evaluation/unresolved_reaction.h"

#include "unilateral/evaluation/nodal_pressure.h"
#include "unilateral/forms/membrane.h"

#include <deal.II/fe/fe_values.h>

#include <algorithm>
#include <cmath>

namespace unilateral
{
  using namespace dealii;

  template <int dim>
  double add_unresolved_reaction(const Problem<dim>       &problem,
                                 const ConstraintSet<dim> &constraint_set,
                                 const Vector             &u,
                                 const Vector             &lambda,
                                 std::vector<double>      &cell_squares)
  {
    const auto *const membrane = dynamic_cast<const Membrane<dim> *>(problem.form.get());
    if (!membrane || !membrane->holds_rigid_body_modes())
      return 0;
    Vector pressure(u.size()); // as a load
    for (const ConstraintBlock &block : constraint_set.blocks)
      if (!problem.conditions[&block - constraint_set.blocks.data()].part)
        pressure.add(block.side == Side::lower ? 1. : -1., nodal_pressure(problem, constraint_set, block, lambda));
    const bool                  curves = problem.space.element.degree > 1;
    FEValues<dim>               values(*problem.space.mapping, *problem.space.fe, problem.cell_quadrature(),
                                       update_values | update_gradients | update_quadrature_points | update_JxW_values |
                                         (curves ? update_hessians : update_default));
    const unsigned              n_q = values.n_quadrature_points;
    std::vector<double>         u_at(n_q), pressure_at(n_q), c(n_q), f(n_q);
    std::vector<Tensor<1, dim>> gradients(n_q);
    std::vector<Tensor<2, dim>> hessians(n_q);
    double                      sum = 0;
    for (const auto &cell : problem.space.dof_handler.active_cell_iterators())
    {
      const auto &coefficients = membrane->coefficients_in(cell->material_id());
      values.reinit(cell);
      const auto &x = values.get_quadrature_points();
      coefficients.reaction.values(x, c);
      const double least = *std::min_element(c.begin(), c.end());
      if (!(least > 0))
        continue;
      std::vector<Tensor<2, dim>> k;
      double                      largest = 0;
      for (const Point<dim> &point : x)
      {
        k.push_back(coefficients.stiffness_tensor(point));
        largest = std::max(largest, trace(k.back())); // no less than the largest eigenvalue
      }
      const double rho = least * std::pow(cell->diameter(), 2) / largest;
      if (!(rho > 1))
        continue;
      coefficients.load.values(x, f);
      values.get_function_values(u, u_at);
      values.get_function_values(pressure, pressure_at);
      values.get_function_gradients(u, gradients);
      if (curves)
        values.get_function_hessians(u, hessians);
      double square = 0;
      for (unsigned q = 0; q < n_q; ++q)
      {
        double r = f[q] - c[q] * u_at[q] + pressure_at[q] + (curves ? scalar_product(k[q], hessians[q]) : 0.);
        if (!coefficients.velocity.empty())
          r -= coefficients.velocity_vector(x[q]) * gradients[q];
        square += r * r / c[q] * values.JxW(q);
      }
      square *= 1 - 1 / rho;
      cell_squares[cell->active_cell_index()] += square;
      sum += square;
    }
    return std::sqrt(problem.space.processes().sum(sum));
  }

#define INSTANTIATE(dim)                                                                                                                   \
  template double add_unresolved_reaction(const Problem<dim> &, const ConstraintSet<dim> &, const Vector &, const Vector &,                \
                                          std::vector<double> &);
  INSTANTIATE(1)
  INSTANTIATE(2)
  INSTANTIATE(3)
#undef INSTANTIATE
} // namespace unilateral
