#include "unilateral/evaluation/unresolved_stiffness.h"

#include "unilateral/mesh/gauss_rule.h"
#include "unilateral/mesh/subdivided_rule.h"

#include <deal.II/base/geometry_info.h>
#include <deal.II/fe/fe_values.h>

#include <Eigen/Dense>

#include <algorithm>
#include <cmath>
#include <numeric>

namespace unilateral
{
  using namespace dealii;

  namespace
  {
    constexpr double least_share = 1e-8;
    /// Where values at the points and corners of a cell are that close to a linear function, no finer rule is tried.
    constexpr double nearly_linear = 1e-5;
    /// By so much more have values at corners to differ than those between the points, or it is no jump.
    constexpr double little = 1e-3;
    /// About this share of a cell lies between a side and the Gauss points next to it.
    constexpr double share_beyond_points = 0.05;
    /// A coefficient that is farther than this from a polynomial of degree 2 jumps, or may as well.
    constexpr double jumps = 0.05;
    /// From the corners of a cell, where it may meet others with another stiffness, in parts of its size.
    constexpr double inside = 1e-4;

    template <int dim>
    Quadrature<dim> next_to_corners(const ReferenceCell &cell)
    {
      std::vector<Point<dim>> points;
      const Point<dim>        centre = cell.template barycenter<dim>();
      for (const unsigned v : cell.vertex_indices())
      {
        const Point<dim> corner = cell.template vertex<dim>(v);
        points.push_back(corner + inside * (centre - corner));
      }
      return Quadrature<dim>(points, std::vector<double>(points.size(), 1. / points.size()));
    }

    /// Means of values and of their inverses.
    std::pair<double, double> means(const std::vector<double> &values, const std::vector<double> &weights)
    {
      double sum = 0, of_inverse = 0, volume = 0;
      for (std::size_t q = 0; q < values.size(); ++q)
      {
        sum += weights[q] * values[q];
        of_inverse += weights[q] / values[q];
        volume += weights[q];
      }
      return {sum / volume, of_inverse / volume};
    }

    std::pair<double, double> range(const std::vector<double> &values)
    {
      const auto [least, most] = std::minmax_element(values.begin(), values.end());
      return {*least, *most};
    }

    /// How far values at given points of the reference cell are from the linear function closest to them, relative to the largest.
    template <int dim>
    class DistanceFromLinear
    {
    public:
      explicit DistanceFromLinear(const std::vector<Point<dim>> &points)
      {
        Eigen::MatrixXd linear(points.size(), dim + 1);
        for (std::size_t q = 0; q < points.size(); ++q)
        {
          linear(q, 0) = 1;
          for (unsigned d = 0; d < dim; ++d)
            linear(q, d + 1) = points[q][d];
        }
        basis = Eigen::HouseholderQR<Eigen::MatrixXd>(linear).householderQ() * Eigen::MatrixXd::Identity(points.size(), dim + 1);
      }

      double operator()(const std::vector<double> &first, const std::vector<double> &others) const
      {
        Eigen::VectorXd values(first.size() + others.size());
        std::copy(others.begin(), others.end(), std::copy(first.begin(), first.end(), values.begin()));
        return (values - basis * (basis.transpose() * values)).lpNorm<Eigen::Infinity>() / values.lpNorm<Eigen::Infinity>();
      }

    private:
      Eigen::MatrixXd basis; ///< of the linear functions, orthonormal
    };

    /// How far values at the points of a finer rule are from the polynomial of degree 2 that fits those of a coarser one best, in the mean,
    /// relative to their mean. Both rules may give a jump the same weight by chance; a polynomial follows none.
    template <int dim>
    class DeviationFromQuadratic
    {
    public:
      DeviationFromQuadratic(const std::vector<Point<dim>> &coarse, const std::vector<Point<dim>> &fine)
        : at_fine(polynomials(fine) * polynomials(coarse).completeOrthogonalDecomposition().pseudoInverse())
      {
      }

      double operator()(const std::vector<double> &coarse, const std::vector<double> &fine, const std::vector<double> &fine_weights) const
      {
        const Eigen::VectorXd fitted = at_fine * Eigen::Map<const Eigen::VectorXd>(coarse.data(), coarse.size());
        double                difference = 0, sum = 0;
        for (std::size_t q = 0; q < fine.size(); ++q)
        {
          difference += fine_weights[q] * std::abs(fine[q] - fitted(q));
          sum += fine_weights[q] * fine[q];
        }
        return difference / sum;
      }

    private:
      static Eigen::MatrixXd polynomials(const std::vector<Point<dim>> &points)
      {
        Eigen::MatrixXd values(points.size(), (dim + 1) * (dim + 2) / 2);
        for (std::size_t q = 0; q < points.size(); ++q)
        {
          unsigned n = 0;
          values(q, n++) = 1;
          for (unsigned a = 0; a < dim; ++a)
          {
            values(q, n++) = points[q][a];
            for (unsigned b = a; b < dim; ++b)
              values(q, n++) = points[q][a] * points[q][b];
          }
        }
        return values;
      }

      Eigen::MatrixXd at_fine; ///< values of the fitted polynomial at the finer points, from those at the coarser ones
    };

    std::vector<double> inverse(std::vector<double> values)
    {
      for (double &value : values)
        value = 1 / value;
      return values;
    }

    /// Values of 1/C at the points of a rule on a cell, C the compliance for one component of the flux.
    template <int dim>
    class StiffnessAt
    {
    public:
      StiffnessAt(const Problem<dim> &problem, const Quadrature<dim> &rule, const UpdateFlags more = update_default)
        : form(*problem.form), values(*problem.space.mapping, *problem.space.fe, rule, update_quadrature_points | update_JxW_values | more)
      {
      }

      void reinit(const typename DoFHandler<dim>::active_cell_iterator &cell)
      {
        values.reinit(cell);
        form.prepare(cell->material_id(), values.get_quadrature_points());
        region = cell->material_id();
      }

      void of_component(const unsigned c, std::vector<double> &stiffness) const
      {
        Flux unit{};
        unit[c] = 1;
        stiffness.clear();
        for (const Point<dim> &x : values.get_quadrature_points())
          stiffness.push_back(1 / form.flux_energy(unit, region, x));
      }

      /// int flux . C flux over the cell.
      double energy_of(const Flux &flux) const
      {
        double energy = 0;
        form.prepare(region, values.get_quadrature_points());
        for (unsigned q = 0; q < values.n_quadrature_points; ++q)
        {
          const Point<dim> &x = values.quadrature_point(q);
          energy += form.flux_energy(flux, region, x) * values.JxW(q) * form.measure(x);
        }
        return energy;
      }

      const BilinearForm<dim> &form;
      FEValues<dim>            values;
      types::material_id       region = 0;
    };

    /// The flux of u in a cell: its mean, and its energy as the rule sees it.
    struct FluxInCell
    {
      Flux   mean{};
      double energy = 0;
    };

    template <int dim>
    FluxInCell flux_in(const typename DoFHandler<dim>::active_cell_iterator &cell, const Vector &u, StiffnessAt<dim> &at)
    {
      std::vector<types::global_dof_index> dofs(cell->get_fe().n_dofs_per_cell());
      dealii::Vector<double>               local_u(dofs.size());
      std::vector<Flux>                    fluxes(at.values.n_quadrature_points);
      FluxInCell                           result;
      double                               volume = 0;
      at.reinit(cell);
      cell->get_dof_indices(dofs);
      for (unsigned i = 0; i < dofs.size(); ++i)
        local_u(i) = u(dofs[i]);
      at.form.flux(at.values, local_u, fluxes);
      for (unsigned q = 0; q < fluxes.size(); ++q)
      {
        const Point<dim> &x = at.values.quadrature_point(q);
        const double      w = at.values.JxW(q) * at.form.measure(x);
        volume += w;
        for (unsigned c = 0; c < at.form.n_flux_components(); ++c)
          result.mean[c] += w * fluxes[q][c];
        result.energy += w * at.form.flux_energy(fluxes[q], at.region, x);
      }
      for (double &component : result.mean)
        component /= volume;
      return result;
    }

    /// Of each component the one that is closest to zero; zero where signs differ.
    Flux least_of(const Flux &a, const Flux &b)
    {
      Flux least{};
      for (std::size_t c = 0; c < least.size(); ++c)
        if (a[c] * b[c] > 0)
          least[c] = std::abs(a[c]) < std::abs(b[c]) ? a[c] : b[c];
      return least;
    }
  } // namespace

  double unseen_share(const std::vector<double> &coarse,
                      const std::vector<double> &weights,
                      const std::vector<double> &fine,
                      const std::vector<double> &fine_weights,
                      const std::vector<double> &corners)
  {
    const auto [mean, of_inverse] = means(coarse, weights);
    const auto [fine_mean, of_fine_inverse] = means(fine, fine_weights);
    // Either rule may be the one whose points miss what there is.
    const auto   difference = [](const double a, const double b) { return std::max(a / b, b / a) - 1; };
    const double by_rules = std::max(difference(fine_mean, mean), difference(of_fine_inverse, of_inverse));
    const auto [least, most] = range(coarse);
    const auto [least_at_corners, most_at_corners] = range(corners);
    const double ratio = std::max(most_at_corners / most, least / least_at_corners);
    return ratio - 1 > most / least - 1 + little ? std::max(by_rules, share_beyond_points * (ratio - 1)) : by_rules;
  }

  template <int dim>
  double add_unresolved_stiffness(const Problem<dim> &problem, const Vector &u, std::vector<double> &cell_squares)
  {
    const auto &form = *problem.form;
    if (form.order() != 1)
      return 0;
    const bool            simplex = problem.space.element.simplex();
    const Quadrature<dim> rule = gauss_rule<dim>(simplex, problem.space.element.degree + 2),
                          near_corners = next_to_corners<dim>(problem.space.fe->reference_cell());
    const Quadrature<dim> finer = subdivided(rule, simplex, 1);
    StiffnessAt<dim>      coarse(problem, rule, update_values | update_gradients), fine(problem, finer, update_values | update_gradients),
      corners(problem, near_corners);
    std::vector<Point<dim>> all_points = rule.get_points();
    all_points.insert(all_points.end(), near_corners.get_points().begin(), near_corners.get_points().end());
    const DistanceFromLinear<dim>     distance_from_linear(all_points);
    const DeviationFromQuadratic<dim> deviation(rule.get_points(), finer.get_points());
    const unsigned                    n = form.n_flux_components();
    std::vector<unsigned>             components(n);
    std::vector<double>               at_points, at_more, at_corners;
    double                            total = 0;
    std::iota(components.begin(), components.end(), 0);
    if (n > 3) // of an isotropic material: tension and shear
      components = {0, n - 1};
    for (const auto &cell : problem.space.dof_handler.active_cell_iterators())
    {
      if (form.uniform_in(cell->material_id()))
        continue;
      coarse.reinit(cell);
      corners.reinit(cell);
      bool   fine_is_ready = false;
      double share = 0;
      for (const unsigned c : components)
      {
        coarse.of_component(c, at_points);
        corners.of_component(c, at_corners);
        if (distance_from_linear(at_points, at_corners) <= nearly_linear)
          continue;
        if (!fine_is_ready)
          fine.reinit(cell);
        fine_is_ready = true;
        fine.of_component(c, at_more);
        const auto &weights = fine.values.get_JxW_values();
        share = std::max(share, unseen_share(at_points, coarse.values.get_JxW_values(), at_more, weights, at_corners));
        const double from_smooth =
          std::max(deviation(at_points, at_more, weights), deviation(inverse(at_points), inverse(at_more), weights));
        if (from_smooth > jumps)
          share = std::max(share, share_beyond_points * from_smooth);
      }
      if (share <= least_share)
        continue;
      const auto [mean, seen_by_coarse] = flux_in(cell, u, coarse);
      const double seen_by_fine = flux_in(cell, u, fine).energy;
      Flux         through = mean;
      for (const unsigned f : cell->face_indices())
        if (!cell->at_boundary(f) && cell->neighbor(f)->is_active())
          through = least_of(through, flux_in<dim>(cell->neighbor(f), u, coarse).mean);
      const double energy = std::max({seen_by_coarse, seen_by_fine, fine.energy_of(through)});
      cell_squares[cell->active_cell_index()] += share * energy;
      total += share * energy;
    }
    return std::sqrt(problem.space.processes().sum(total));
  }

#define INSTANTIATE(dim) template double add_unresolved_stiffness(const Problem<dim> &, const Vector &, std::vector<double> &);
  INSTANTIATE(1)
  INSTANTIATE(2)
  INSTANTIATE(3)
#undef INSTANTIATE
} // namespace unilateral
