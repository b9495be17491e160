#include "unilateral/evaluation/interior_residual.h"

#include "unilateral/discretisation/points_by_cell.h"

#include <deal.II/base/quadrature_lib.h>
#include <deal.II/fe/fe_values.h>

#include <algorithm>
#include <cmath>

namespace unilateral
{
  using namespace dealii;

  namespace
  {
    /// Cells with pressure at all points of a bound.
    template <int dim>
    std::vector<bool> cells_in_contact(const Problem<dim> &problem, const ConstraintSet<dim> &constraint_set, const Vector &lambda)
    {
      std::vector<bool> contact(problem.space.mesh.triangulation->n_active_cells(), false);
      for (std::size_t b = 0; b < constraint_set.blocks.size(); ++b)
        for (const RuleOnCell<dim> &rule : rule_on_cells(problem, constraint_set, b))
          if (!rule.face && std::all_of(rule.points.begin(), rule.points.end(),
                                        [&](const std::size_t i) { return i < constraint_set.size() && lambda(i) > 0; }))
            contact[rule.cell->active_cell_index()] = true;
      return contact;
    }

    constexpr unsigned n_points = 3; ///< of Gauss, in each direction

    /// f''(x) from its values at three points.
    double second_derivative(const std::array<double, 3> &x, const std::array<double, 3> &f)
    {
      return 2 * ((f[2] - f[1]) / (x[2] - x[1]) - (f[1] - f[0]) / (x[1] - x[0])) / (x[2] - x[0]);
    }

    /// div Div M at the points of a rectangle's 3 x 3 rule, or of the three on an interval, by differences of the moments there.
    template <int dim>
    double divergence_of_moments(const std::vector<Point<dim>> &x, const std::vector<Flux> &M, const unsigned q)
    {
      const unsigned i = q % n_points, j = q / n_points;
      const auto     along = [&](const unsigned d, const unsigned component)
      {
        std::array<double, 3> at, f;
        for (unsigned k = 0; k < n_points; ++k)
        {
          const unsigned point = d == 0 ? k + n_points * j : i + n_points * k;
          at[k] = x[point][d];
          f[k] = M[point][component];
        }
        return second_derivative(at, f);
      };
      if constexpr (dim == 1)
        return along(0, 0);
      const unsigned last = n_points - 1, corner = n_points * last;
      const double   mixed =
        (M[corner + last][2] - M[corner][2] - M[last][2] + M[0][2]) / ((x[last][0] - x[0][0]) * (x[corner][dim - 1] - x[0][dim - 1]));
      return along(0, 0) + 2 * mixed + along(dim - 1, 1);
    }

    /// h^4/720, and its like on a rectangle.
    template <int dim>
    double factor(const typename DoFHandler<dim>::active_cell_iterator &cell)
    {
      const double a = cell->extent_in_direction(0);
      if constexpr (dim == 1)
        return std::pow(a, 4) / 720;
      const double b = cell->extent_in_direction(dim - 1);
      return 1 / (720 * (std::pow(a, -4) + 4 / (7 * a * a * b * b) + std::pow(b, -4)));
    }
  } // namespace

  template <int dim>
  double add_interior_residuals(const Problem<dim>       &problem,
                                const ConstraintSet<dim> &constraint_set,
                                const Vector             &u,
                                const Vector             &lambda,
                                std::vector<double>      &cell_squares)
  {
    double total = 0;
    if constexpr (dim < 3)
    {
      if (!problem.space.hermite())
        return 0;
      const std::vector<bool>              contact = cells_in_contact(problem, constraint_set, lambda);
      FEValues<dim>                        values(*problem.space.mapping, *problem.space.fe, QGauss<dim>(n_points),
                                                  update_values | update_hessians | update_quadrature_points | update_JxW_values);
      std::vector<types::global_dof_index> dofs(problem.space.fe->n_dofs_per_cell());
      dealii::Vector<double>               local_u(dofs.size());
      std::vector<double>                  r;
      std::vector<Flux>                    moments;
      Flux                                 unit{};
      unit[0] = 1;
      for (const auto &cell : problem.space.dof_handler.active_cell_iterators())
      {
        if (contact[cell->active_cell_index()])
          continue;
        values.reinit(cell);
        cell->get_dof_indices(dofs);
        for (unsigned i = 0; i < dofs.size(); ++i)
          local_u(i) = u(dofs[i]);
        problem.form->load_less_reaction(values, local_u, r);
        problem.form->flux(values, local_u, moments);
        double sum = 0;
        for (const unsigned q : values.quadrature_point_indices())
        {
          const Point<dim> &x = values.quadrature_point(q);
          const double      residual = r[q] - divergence_of_moments(values.get_quadrature_points(), moments, q);
          sum += residual * residual * problem.form->flux_energy(unit, cell->material_id(), x) * values.JxW(q);
        }
        cell_squares[cell->active_cell_index()] += factor<dim>(cell) * sum;
        total += factor<dim>(cell) * sum;
      }
    }
    return std::sqrt(problem.space.processes().sum(total));
  }

#define INSTANTIATE(dim)                                                                                                                   \
  template double add_interior_residuals(const Problem<dim> &, const ConstraintSet<dim> &, const Vector &, const Vector &,                 \
                                         std::vector<double> &);
  INSTANTIATE(1)
  INSTANTIATE(2)
  INSTANTIATE(3)
#undef INSTANTIATE
} // namespace unilateral
