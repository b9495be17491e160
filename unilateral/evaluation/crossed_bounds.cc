#include "unilateral/evaluation/crossed_bounds.h"

#include "unilateral/constraints/quadrature_rule.h"
#include "unilateral/evaluation/cells_to_search.h"
#include "unilateral/evaluation/crossing_search.h"
#include "unilateral/mesh/box_around.h"
#include "unilateral/mesh/gauss_rule.h"
#include "unilateral/mesh/subdivided_rule.h"

#include <algorithm>
#include <cmath>
#include <iterator>

namespace unilateral
{
  using namespace dealii;

  namespace
  {
    /// Of the relative error; and how little of the largest u is looked for at most, and at least.
    constexpr double share_of_error = 0.3, least_crossing = 1e-6, largest_crossing = 0.05;
    /// Of the largest crossing: others are worth to be refined, too.
    constexpr double worth_refining = 0.5;

    /// Of a bound: those of the bound of the error, where there may be one, else those of its rule.
    template <int dim>
    typename CrossingSearch<dim>::PointsSeen points_of_bound(const Problem<dim> &problem, const RuleName &rule)
    {
      const ElementName                       &element = problem.space.element;
      const bool                               simplices = element.simplex();
      typename CrossingSearch<dim>::PointsSeen points;
      if (problem.form->order() > 1 || problem.space.mesh.curved || problem.space.mesh.curved_cells)
      {
        points.always = quadrature_rule<dim>(rule, element).get_points();
        return points;
      }
      const auto of_bound = gauss_rule<dim>(simplices, element.degree + 3);
      points.always = of_bound.get_points();
      points.closer = subdivided(of_bound, simplices, dim == 3 ? 1 : 2).get_points();
      return points;
    }

    /// At the nodes. Hermite elements have slopes among their unknowns, too.
    template <int dim>
    double largest_value(const Problem<dim> &problem, const Vector &u)
    {
      double largest = 0;
      for (const auto &node : problem.space.nodal_values())
        largest = std::max(largest, std::abs(u(node.dof)));
      return problem.space.processes().max(largest);
    }

    /// Of u beyond the bounds, at their points.
    template <int dim>
    double largest_penetration(const Problem<dim> &problem, const ConstraintSet<dim> &set, const Vector &u)
    {
      const auto values = set.values_of(u);
      double     largest = 0;
      for (std::size_t i = 0; i < set.size(); ++i)
        largest = std::max(largest, set.points[i].sign * (values[i] - set.points[i].bound));
      return problem.space.processes().max(largest);
    }

    /// Beams and plates sag between their points below a level floor, too.
    template <int dim>
    bool can_be_searched(const Problem<dim> &problem, const UnilateralCondition &condition)
    {
      const FieldFunction &bound = condition.bound;
      return !condition.part && !condition.surface && bound.range({}) && (problem.form->order() > 1 || !bound.is_constant());
    }
  } // namespace

  template <int dim>
  CrossedBounds crossed_bounds(const Problem<dim> &problem, const ConstraintSet<dim> &set, const Vector &u, const double relative_error)
  {
    CrossedBounds result;
    if (problem.form->order() == 0)
      return result;
    const double largest = largest_value(problem, u);
    const double tolerance = std::max(largest * std::clamp(share_of_error * relative_error, least_crossing, largest_crossing),
                                      2 * largest_penetration(problem, set, u));
    for (const UnilateralCondition &condition : problem.conditions)
    {
      if (!can_be_searched(problem, condition))
        continue;
      CrossingSearch<dim> search(problem, condition.bound, condition.side, points_of_bound(problem, condition.rule), u, tolerance);
      for (const auto &cell : cells_to_search(problem, condition.bound, condition.side, u, tolerance))
      {
        using Verdict = typename CrossingSearch<dim>::Verdict;
        const Verdict verdict = search.look_into(cell);
        result.certain = result.certain && verdict != Verdict::unknown;
        if (verdict != Verdict::found && verdict != Verdict::seen)
          continue;
        search.ask_for_more_than(worth_refining * search.excess);
        const std::size_t number = cell->active_cell_index();
        result.crossings.push_back({number, search.excess, largest > 0 ? search.excess / largest : 1});
        // Beams and plates have no bound of the error that would have to be false.
        if (verdict == Verdict::found && (problem.form->order() == 1 || search.excess > largest_crossing * largest))
        {
          auto &detail = result.details.emplace_back(
            UnseenDetail{"bound", condition.bound.where(), {}, search.value, search.shown.least, search.shown.most, number});
          for (unsigned d = 0; d < dim; ++d)
            detail.x[d] = search.where[d];
        }
      }
    }
    return result;
  }

  template <int dim>
  double add_crossed_bounds(const Problem<dim> &problem, const CrossedBounds &crossed, const double norm, std::vector<double> &cell_squares)
  {
    const Processes    &processes = problem.space.processes();
    std::vector<double> errors;
    if (norm > 0)
      for (const auto &crossing : crossed.crossings)
        errors.push_back((problem.form->order() > 1 ? 3 : 1) * norm * std::min(1., crossing.relative_excess));
    else
    {
      const auto [low, high] = box_around(*problem.space.mesh.triangulation, processes);
      const double size = low.distance(high);
      Flux         unit{};
      unit[0] = 1;
      auto cell = problem.space.dof_handler.begin_active();
      for (const auto &crossing : crossed.crossings)
      {
        std::advance(cell, std::ptrdiff_t(crossing.cell) - std::ptrdiff_t(cell->active_cell_index()));
        const double compliance = problem.form->flux_energy(unit, cell->material_id(), cell->center());
        errors.push_back(crossing.excess * std::pow(size, dim / 2. - problem.form->order()) / std::sqrt(compliance));
      }
    }
    const double largest = processes.max(errors.empty() ? 0. : *std::max_element(errors.begin(), errors.end()));
    for (std::size_t k = 0; k < errors.size(); ++k)
      if (errors[k] > worth_refining * largest)
        cell_squares[crossed.crossings[k].cell] += errors[k] * errors[k];
    return largest;
  }

#define INSTANTIATE(dim)                                                                                                                   \
  template CrossedBounds crossed_bounds(const Problem<dim> &, const ConstraintSet<dim> &, const Vector &, double);                         \
  template double        add_crossed_bounds(const Problem<dim> &, const CrossedBounds &, double, std::vector<double> &);
  INSTANTIATE(1)
  INSTANTIATE(2)
  INSTANTIATE(3)
#undef INSTANTIATE
} // namespace unilateral
