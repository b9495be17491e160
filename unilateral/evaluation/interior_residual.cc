#include "unilateral/evaluation/interior_residual.h"

#include "unilateral/discretisation/points_by_cell.h"
#include "unilateral/mesh/gauss_rule.h"

#include <deal.II/base/quadrature_lib.h>
#include <deal.II/fe/fe_values.h>

#include <Eigen/Dense>

#include <algorithm>
#include <array>
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

    constexpr unsigned n_points = 5; ///< of Gauss, in each direction: moments of degree four are differentiated without error

    using AtPoints = Eigen::Matrix<double, n_points, n_points>;

    /// D, (D f)_i the derivative at point i of the polynomial with the values f at the points of Gauss on the unit interval.
    const AtPoints &differentiation()
    {
      static const AtPoints D = []
      {
        const auto points = QGauss<1>(n_points).get_points();
        AtPoints   powers, derivatives; // of t^k at the points
        for (unsigned i = 0; i < n_points; ++i)
          for (unsigned k = 0; k < n_points; ++k)
          {
            powers(i, k) = std::pow(points[i][0], k);
            derivatives(i, k) = k == 0 ? 0. : k * std::pow(points[i][0], k - 1.);
          }
        return AtPoints(derivatives * powers.inverse());
      }();
      return D;
    }

    /// div Div M at the points of a rectangle with sides a and b parallel to the axes, or of an interval: x runs first.
    template <int dim>
    std::vector<double> divergences_on_rectangle(const double a, const double b, const std::vector<Flux> &M)
    {
      const AtPoints     &D = differentiation();
      std::vector<double> result(M.size());
      if constexpr (dim == 1)
      {
        Eigen::Matrix<double, n_points, 1> moments;
        for (unsigned i = 0; i < n_points; ++i)
          moments(i) = M[i][0];
        Eigen::Map<Eigen::Matrix<double, n_points, 1>>(result.data()) = D * (D * moments) / (a * a);
      }
      else
      {
        AtPoints xx, yy, xy;
        for (unsigned j = 0; j < n_points; ++j)
          for (unsigned i = 0; i < n_points; ++i)
          {
            xx(i, j) = M[i + n_points * j][0];
            yy(i, j) = M[i + n_points * j][1];
            xy(i, j) = M[i + n_points * j][2];
          }
        Eigen::Map<AtPoints>(result.data()) =
          D * D * xx / (a * a) + 2 * D * xy * D.transpose() / (a * b) + yy * D.transpose() * D.transpose() / (b * b);
      }
      return result;
    }

    /// That of moments at any points of a quadrilateral, of the quadratic functions that fit them best.
    double
    divergence_of_fitted_moments(const std::vector<Point<2>> &x, const std::vector<Flux> &M, const Point<2> &center, const double size)
    {
      Eigen::MatrixXd squares(x.size(), 6), moments(x.size(), 3);
      for (std::size_t q = 0; q < x.size(); ++q)
      {
        const double X = (x[q][0] - center[0]) / size, Y = (x[q][1] - center[1]) / size;
        squares.row(q) << 1, X, Y, X * X, X * Y, Y * Y;
        moments.row(q) << M[q][0], M[q][1], M[q][2];
      }
      const Eigen::MatrixXd fit = squares.colPivHouseholderQr().solve(moments);
      return (2 * fit(3, 0) + 2 * fit(4, 2) + 2 * fit(5, 1)) / (size * size);
    }

    bool is_parallel_to_axes(const DoFHandler<1>::active_cell_iterator &)
    {
      return true;
    }
    bool is_parallel_to_axes(const DoFHandler<2>::active_cell_iterator &cell)
    {
      const double slack = 1e-9 * cell->diameter();
      return cell->n_vertices() == 4 && std::abs(cell->vertex(0)[1] - cell->vertex(1)[1]) < slack &&
             std::abs(cell->vertex(2)[1] - cell->vertex(3)[1]) < slack && std::abs(cell->vertex(0)[0] - cell->vertex(2)[0]) < slack &&
             std::abs(cell->vertex(1)[0] - cell->vertex(3)[0]) < slack;
    }

    /// int of l_1^a l_2^b l_3^c over a triangle, its barycentric coordinates, over its area: 2 a! b! c!/(a + b + c + 2)!.
    double mean_of_monomial(const std::array<unsigned, 3> &power)
    {
      return 2 * std::tgamma(power[0] + 1.) * std::tgamma(power[1] + 1.) * std::tgamma(power[2] + 1.) /
             std::tgamma(power[0] + power[1] + power[2] + 3.);
    }

    /// (int w)^2/(area int (lap w)^2), w = (l_1 l_2 l_3)^2.
    double factor_of_triangle(const DoFHandler<2>::active_cell_iterator &cell)
    {
      // lap w = sum of c times a monomial of degree 4, with the products of the gradients of l_1, l_2, l_3.
      const double                                            area = cell->measure();
      std::array<Tensor<1, 2>, 3>                             gradient;
      std::vector<std::pair<double, std::array<unsigned, 3>>> terms;
      for (unsigned i = 0; i < 3; ++i)
        gradient[i] = cross_product_2d(cell->vertex((i + 2) % 3) - cell->vertex((i + 1) % 3)) / (2 * area);
      for (unsigned i = 0; i < 3; ++i)
      {
        std::array<unsigned, 3> twice = {2, 2, 2}, mixed = {1, 1, 1};
        twice[i] = 0;
        mixed[i] = 2;
        terms.push_back({2 * gradient[i] * gradient[i], twice});
        terms.push_back({8 * gradient[(i + 1) % 3] * gradient[(i + 2) % 3], mixed});
      }
      double energy = 0;
      for (const auto &[c, power] : terms)
        for (const auto &[d, other] : terms)
          energy += c * d * mean_of_monomial({power[0] + other[0], power[1] + other[1], power[2] + other[2]});
      return std::pow(mean_of_monomial({2, 2, 2}), 2) / energy;
    }

    /// h^4/720, and its like on rectangles and triangles.
    template <int dim>
    double factor(const typename DoFHandler<dim>::active_cell_iterator &cell)
    {
      if constexpr (dim == 2)
        if (cell->n_vertices() == 3)
          return factor_of_triangle(cell);
      const double a = cell->extent_in_direction(0);
      if constexpr (dim == 1)
        return std::pow(a, 4) / 720;
      const double b = cell->extent_in_direction(dim - 1);
      return 1 / (720 * (std::pow(a, -4) + 4 / (7 * a * a * b * b) + std::pow(b, -4)));
    }

    /// Of the forces and moments at points inside a cell of a beam, a from its beginning and b from its end: with EI = 1 the work that they
    /// do on a beam that is clamped at both ends.
    double square_of_point_loads(const Problem<1> &problem, const DoFHandler<1>::active_cell_iterator &cell)
    {
      double       square = 0;
      const double h = cell->extent_in_direction(0);
      for (const PointLoad &load : problem.statement.point_loads)
      {
        const double a = load.at[0] - std::min(cell->vertex(0)[0], cell->vertex(1)[0]), b = h - a, F = load.force, M = load.moment;
        if (a > 0 && b > 0)
          square +=
            (F * F * std::pow(a * b, 3) / 3 + F * M * std::pow(a * b, 2) * (b - a) + M * M * a * b * (h * h - 3 * a * b)) / std::pow(h, 3);
      }
      return square;
    }
    double square_of_point_loads(const Problem<2> &, const DoFHandler<2>::active_cell_iterator &)
    {
      return 0; // see add_point_loads_on_plates()
    }

    /// Next to a force F on a plate u is r^2 ln r F/(8 pi D), of which bicubics of Hermite's kind miss more than their recovered moments
    /// show: 0.00175 F^2 h^2/D, h^2 the area of a cell, for forces at nodes (by the series of Navier). With that the estimate is 0.7 to 1.3
    /// of the error for forces elsewhere. Returns the sum.
    template <int dim>
    double add_point_loads_on_plates(const Problem<dim> &problem, std::vector<double> &cell_squares)
    {
      constexpr double    share = 0.00175;
      const auto         &loads = problem.statement.point_loads;
      std::vector<double> n_cells(loads.size(), 0.);
      const auto          for_each_cell_at_load = [&](const auto &act)
      {
        for (const auto &cell : problem.space.mesh.triangulation->active_cell_iterators())
          for (std::size_t k = 0; k < loads.size(); ++k)
          {
            Point<dim> x;
            for (unsigned d = 0; d < dim; ++d)
              x[d] = loads[k].at[d];
            if (loads[k].force != 0 && cell->bounding_box().point_inside(x, 1e-9))
              act(cell, k);
          }
      };
      for_each_cell_at_load([&](const auto &, const std::size_t k) { n_cells[k] += 1; });
      problem.space.processes().sum(n_cells.data(), n_cells.size());
      double total = 0;
      Flux   unit{};
      unit[0] = 1;
      for_each_cell_at_load(
        [&](const auto &cell, const std::size_t k)
        {
          const double square = share * loads[k].force * loads[k].force * cell->measure() / n_cells[k] *
                                problem.form->flux_energy(unit, cell->material_id(), cell->center());
          cell_squares[cell->active_cell_index()] += square;
          total += square;
        });
      return total;
    }

    /// div Div M at the points of a cell's rule. On triangles of degree three at most the moments are linear.
    template <int dim>
    std::vector<double> divergences_of_moments(const typename DoFHandler<dim>::active_cell_iterator &cell,
                                               const std::vector<Point<dim>>                        &x,
                                               const std::vector<Flux>                              &M)
    {
      if (is_parallel_to_axes(cell))
        return divergences_on_rectangle<dim>(cell->extent_in_direction(0), cell->extent_in_direction(dim - 1), M);
      std::vector<double> divergences(x.size(), 0.);
      if constexpr (dim == 2)
        if (cell->n_vertices() == 4)
          std::fill(divergences.begin(), divergences.end(), divergence_of_fitted_moments(x, M, cell->center(), cell->diameter()));
      return divergences;
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
      if (problem.form->order() != 2)
        return 0;
      const std::vector<bool> contact = cells_in_contact(problem, constraint_set, lambda);
      FEValues<dim>           values(*problem.space.mapping, *problem.space.fe, gauss_rule<dim>(problem.space.element.simplex(), n_points),
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
        const auto divergences = divergences_of_moments<dim>(cell, values.get_quadrature_points(), moments);
        double     sum = 0;
        for (const unsigned q : values.quadrature_point_indices())
        {
          const Point<dim> &x = values.quadrature_point(q);
          const double      residual = r[q] - divergences[q];
          sum += residual * residual * problem.form->flux_energy(unit, cell->material_id(), x) * values.JxW(q);
        }
        const double of_points =
          square_of_point_loads(problem, cell) * problem.form->flux_energy(unit, cell->material_id(), cell->center());
        cell_squares[cell->active_cell_index()] += factor<dim>(cell) * sum + of_points;
        total += factor<dim>(cell) * sum + of_points;
      }
    }
    if constexpr (dim == 2)
      if (problem.form->order() == 2 && problem.space.hermite() && !problem.statement.point_loads.empty())
        total += add_point_loads_on_plates(problem, cell_squares);
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
