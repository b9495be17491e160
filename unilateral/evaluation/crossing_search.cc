#include "unilateral/evaluation/crossing_search.h"

#include "unilateral/evaluation/value_search.h"

#include <deal.II/base/quadrature.h>
#include <deal.II/fe/fe_q.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <queue>
#include <utility>

namespace unilateral
{
  using namespace dealii;

  namespace
  {
    /// The polynomials of Lagrange's kind that functions of V_h consist of: bicubics for those of Hermite.
    template <int dim>
    std::shared_ptr<const FiniteElement<dim>> polynomials_of(const Problem<dim> &problem)
    {
      if (problem.space.hermite())
        return std::make_shared<FE_Q<dim>>(3);
      return {std::shared_ptr<void>(), problem.space.fe.get()}; // the problem has it
    }

    /// Of the linear function of a vertex of a simplex, or of the multilinear one of a hypercube, at a point of the reference cell.
    template <int dim>
    Tensor<1, dim> gradient_of_linear_function(const bool simplex, const Point<dim> &unit, const unsigned vertex)
    {
      Tensor<1, dim> gradient;
      for (unsigned d = 0; d < dim; ++d)
        if (simplex)
          gradient[d] = vertex == 0 ? -1 : vertex == d + 1 ? 1 : 0;
        else
        {
          gradient[d] = vertex >> d & 1 ? 1 : -1;
          for (unsigned e = 0; e < dim; ++e)
            if (e != d)
              gradient[d] *= vertex >> e & 1 ? unit[e] : 1 - unit[e];
        }
      return gradient;
    }

    /// Below this nothing is a crossing, whatever is asked for.
    constexpr double rounding_of_values = 1e-11;
    constexpr double rough_share = 1e-4; ///< of the range of s on a cell, see FeasibleState
    constexpr double more_than_seen = 1.5, largest_but_for = 1.2, slack_of_slopes = 0.2, slack_of_seen_slopes = 0.5,
                     slack_of_curved_cells = 0.3;
    constexpr unsigned most_steps_of_first_look = 8, most_steps = 400, most_steps_for_slopes = 200, most_steps_of_all = 100000;
  } // namespace

  template <int dim>
  CrossingSearch<dim>::CrossingSearch(
    const Problem<dim> &problem, const FieldFunction &s, const Side side, const PointsSeen &seen, const Vector &u, const double tolerance)
    : problem(problem), s(s), side(side), u(u), tolerance(std::max(tolerance, rounding_of_values * u.linfty_norm())),
      steps_left(most_steps_of_all + problem.space.mesh.triangulation->n_active_cells() / 2),
      simplex(problem.space.element.simplex() || dim == 1), curved(problem.space.mesh.curved || problem.space.mesh.curved_cells),
      polynomials(polynomials_of(problem)), at_nodes(*problem.space.mapping,
                                                     *problem.space.fe,
                                                     Quadrature<dim>(polynomials->get_unit_support_points()),
                                                     update_values | update_gradients | update_hessians),
      at_seen(*problem.space.mapping, *problem.space.fe, Quadrature<dim>(seen.always), update_values | update_quadrature_points),
      u_at_nodes(polynomials->n_dofs_per_cell()), gradients(polynomials->n_dofs_per_cell()), hessians(polynomials->n_dofs_per_cell()),
      dofs(problem.space.fe->n_dofs_per_cell())
  {
    if (!seen.closer.empty())
      at_closer = std::make_unique<FEValues<dim>>(*problem.space.mapping, *problem.space.fe, Quadrature<dim>(seen.closer),
                                                  update_values | update_quadrature_points);
  }

  template <int dim>
  std::vector<Point<dim>> CrossingSearch<dim>::corners_of_cell() const
  {
    const auto              reference = problem.space.fe->reference_cell();
    std::vector<Point<dim>> corners;
    for (const unsigned v : reference.vertex_indices())
      corners.push_back(reference.template vertex<dim>(v));
    return corners;
  }

  template <int dim>
  Point<dim> CrossingSearch<dim>::place(const Cell &cell, const Point<dim> &unit) const
  {
    if (curved)
      return problem.space.mapping->transform_unit_to_real_cell(cell, unit);
    return straight_place(cell, unit);
  }

  template <int dim>
  std::array<Interval, 3> CrossingSearch<dim>::box_of(const Cell &cell, const std::vector<Point<dim>> &corners) const
  {
    std::array<Interval, 3> box{};
    for (unsigned d = 0; d < dim; ++d)
      box[d] = Interval::none();
    for (const Point<dim> &corner : corners)
    {
      const Point<dim> x = place(cell, corner);
      for (unsigned d = 0; d < dim; ++d)
        box[d] = hull(box[d], Interval::of(x[d]));
    }
    for (unsigned d = 0; d < dim; ++d)
    {
      const double slack = curved ? slack_of_curved_cells * (box[d].most - box[d].least) : 0;
      box[d] = {box[d].least - slack, box[d].most + slack};
    }
    return box;
  }

  template <int dim>
  double CrossingSearch<dim>::u_at(const Point<dim> &unit) const
  {
    double value = 0;
    for (unsigned i = 0; i < u_at_nodes.size(); ++i)
      value += u_at_nodes[i] * polynomials->shape_value(i, unit);
    return value;
  }

  /// Its polynomial on the cell, and its slopes.
  template <int dim>
  void CrossingSearch<dim>::take_u(const Cell &cell)
  {
    at_nodes.reinit(cell);
    at_nodes.get_function_values(u, u_at_nodes);
    at_nodes.get_function_gradients(u, gradients);
    at_nodes.get_function_hessians(u, hessians);
    const bool exact = simplex && !curved && polynomials->degree <= 2;
    const auto range = [&](const auto &derivatives, const auto &component)
    {
      Interval values = Interval::of(component(derivatives[0]));
      for (const auto &derivative : derivatives)
        values = hull(values, Interval::of(component(derivative)));
      const double slack = exact ? 0 : slack_of_slopes * (values.most - values.least);
      return Interval{values.least - slack, values.most + slack};
    };
    for (unsigned d = 0; d < dim; ++d)
    {
      slopes_of_u[d] = range(gradients, [d](const Tensor<1, dim> &g) { return g[d]; });
      for (unsigned e = 0; e < dim; ++e)
        second_derivatives_of_u[d][e] = range(hessians, [d, e](const Tensor<2, dim> &H) { return H[d][e]; });
    }
  }

  /// Of u on a part of the cell with the middle @p unit, as far as @p reach from it in each direction.
  template <int dim>
  std::array<Interval, 3>
  CrossingSearch<dim>::slopes_on(const Cell &cell, const Point<dim> &unit, const std::array<double, dim> &reach) const
  {
    if (curved || polynomials->degree == 1)
      return slopes_of_u;
    Tensor<2, dim> jacobian;
    for (const unsigned v : cell->vertex_indices())
      jacobian += outer_product(Tensor<1, dim>(cell->vertex(v)), gradient_of_linear_function(simplex, unit, v));
    Tensor<1, dim> gradient;
    for (unsigned i = 0; i < u_at_nodes.size(); ++i)
      gradient += u_at_nodes[i] * polynomials->shape_grad(i, unit);
    gradient = transpose(invert(jacobian)) * gradient;
    std::array<Interval, 3> slopes{};
    for (unsigned d = 0; d < dim; ++d)
    {
      slopes[d] = Interval::of(gradient[d]);
      for (unsigned e = 0; e < dim; ++e)
        slopes[d] = slopes[d] + second_derivatives_of_u[d][e] * Interval{-reach[e], reach[e]};
      slopes[d] = intersection(slopes[d], slopes_of_u[d]);
    }
    return slopes;
  }

  /// What its interpolant misses of s at the points that are seen, and how near s comes to u there, decide with the bound of the error
  /// whether it looks closer: see FeasibleState.
  template <int dim>
  double CrossingSearch<dim>::seen_beyond(const Cell &cell, const bool touches)
  {
    shown = Interval::none();
    double                  largest = 0, least_distance = std::numeric_limits<double>::max(), missed = 0;
    std::vector<Point<dim>> crossing_points;
    const auto              look = [&](FEValues<dim> &at, const auto &at_point)
    {
      std::vector<double> of_u(at.n_quadrature_points);
      at.reinit(cell);
      at.get_function_values(u, of_u);
      for (unsigned q = 0; q < of_u.size(); ++q)
        if (const auto value_there = value_if_any(s, at.quadrature_point(q)))
        {
          shown = hull(shown, Interval::of(*value_there));
          const double D = beyond(*value_there, of_u[q]);
          largest = std::max(largest, D);
          if (D > 0 || touches)
            crossing_points.push_back(at.quadrature_point(q));
          at_point(q, *value_there, of_u[q]);
        }
    };
    std::vector<double> s_at_nodes;
    for (const Point<dim> &node : polynomials->get_unit_support_points())
      s_at_nodes.push_back(value_if_any(s, place(cell, node)).value_or(0));
    look(at_seen,
         [&](const unsigned q, const double of_s, const double of_u)
         {
           double interpolant = 0;
           for (unsigned i = 0; i < s_at_nodes.size(); ++i)
             interpolant += s_at_nodes[i] * polynomials->shape_value(i, at_seen.get_quadrature().point(q));
           missed = std::max(missed, std::abs(of_s - interpolant));
           least_distance = std::min(least_distance, std::abs(of_s - of_u));
         });
    const bool rough = touches && missed > rough_share * (shown.most - shown.least);
    if (at_closer && (largest > 0 || rough || least_distance < 2 * missed))
    {
      crossing_points.clear(); // it is at the others that slopes count then
      look(*at_closer, [](unsigned, double, double) {});
    }
    slopes_seen = slopes_of_u;
    take_slopes_at(crossing_points, slopes_seen);
    return largest;
  }

  /// Those of s become part of @p slopes.
  template <int dim>
  void CrossingSearch<dim>::take_slopes_at(const std::vector<Point<dim>> &points, std::array<Interval, 3> &slopes) const
  {
    std::vector<double>         values;
    std::vector<Tensor<1, dim>> gradients;
    if (!points.empty())
      s.values_and_gradients(points, values, gradients);
    for (const auto &gradient : gradients)
      for (unsigned d = 0; d < dim; ++d)
        slopes[d] = hull(slopes[d], Interval::of(gradient[d]));
  }

  template <int dim>
  bool CrossingSearch<dim>::touches_at_nodes(const Cell &cell) const
  {
    const auto &nodes = polynomials->get_unit_support_points();
    for (unsigned i = 0; i < nodes.size(); ++i)
      if (const auto value = value_if_any(s, place(cell, nodes[i])); value && beyond(*value, u_at_nodes[i]) > -tolerance)
        return true;
    return false;
  }

  template <int dim>
  bool CrossingSearch<dim>::are_seen(const std::array<Interval, 3> &slopes, const std::array<Interval, 3> &box) const
  {
    for (unsigned d = 0; d < dim; ++d)
    {
      const Interval &seen = slopes_seen[d];
      const double    size = box[d].most - box[d].least;
      const double    slack = slack_of_seen_slopes * (seen.most - seen.least) + (size > 0 ? tolerance / size : 0);
      if (!slopes[d].inside({seen.least - slack, seen.most + slack}))
        return false;
    }
    return true;
  }

  /// For a place with D above the tolerance where slopes are not seen. Unknown where slopes decide nothing, as where s jumps.
  template <int dim>
  typename CrossingSearch<dim>::Verdict CrossingSearch<dim>::search_for_slopes(const Cell &cell)
  {
    const auto                box = box_of(cell, corners_of_cell());
    std::priority_queue<Part> parts;
    const auto                add = [&](std::vector<Point<dim>> corners)
    {
      excess = 0;
      auto part = judge(cell, std::move(corners), tolerance);
      if (excess > 0) // in its middle
      {
        std::array<Interval, 3> slope;
        slope.fill(Interval::none());
        take_slopes_at({where}, slope);
        if (!are_seen(slope, box))
          return true;
      }
      if (part.most > tolerance && !are_seen(part.slopes, box))
        parts.push(std::move(part));
      return false;
    };
    if (add(corners_of_cell()))
      return Verdict::found;
    for (unsigned step = 0; !parts.empty(); ++step)
    {
      if (step == most_steps_for_slopes || steps_left == 0)
        return Verdict::unknown;
      --steps_left;
      const Part part = parts.top();
      parts.pop();
      for (auto &half : halves_of(part.corners, simplex))
        if (add(std::move(half)))
          return Verdict::found;
    }
    return Verdict::nothing;
  }

  template <int dim>
  typename CrossingSearch<dim>::Part CrossingSearch<dim>::judge(const Cell &cell, std::vector<Point<dim>> corners, const double threshold)
  {
    Point<dim> centre;
    for (const Point<dim> &corner : corners)
      centre += corner / double(corners.size());
    const Point<dim> x = place(cell, centre);
    const double     u_here = u_at(centre);
    const auto       s_here = value_if_any(s, x);
    if (const double D = s_here ? beyond(*s_here, u_here) : 0; D > std::max(threshold, excess))
    {
      excess = D;
      where = x;
      value = *s_here;
    }
    const auto              box = box_of(cell, corners);
    const auto              set = s.range_and_slopes(box).value();
    std::array<double, dim> reach;
    for (unsigned d = 0; d < dim; ++d)
      reach[d] = std::max(box[d].most - x[d], x[d] - box[d].least);
    const auto of_u = slopes_on(cell, centre, reach);
    double     change = 0, change_of_u = 0;
    for (unsigned d = 0; d < dim; ++d)
    {
      const Interval slope = set.slopes[d] - of_u[d];
      change += std::max(std::abs(slope.least), std::abs(slope.most)) * reach[d];
      change_of_u += std::max(std::abs(of_u[d].least), std::abs(of_u[d].most)) * reach[d];
    }
    // By the slopes; and by the values, where s jumps or has a pole.
    double most = set.value.empty()     ? -std::numeric_limits<double>::infinity()
                  : side == Side::lower ? set.value.most - (u_here - change_of_u)
                                        : u_here + change_of_u - set.value.least;
    if (s_here && !std::isnan(change))
      most = std::min(most, beyond(*s_here, u_here) + change);
    return {most, std::move(corners), set.slopes};
  }

  template <int dim>
  typename CrossingSearch<dim>::Verdict CrossingSearch<dim>::search(const Cell &cell, const double threshold, const unsigned most_steps)
  {
    excess = 0;
    std::priority_queue<Part> parts;
    // Once something is found the largest is wanted, but for a part of it.
    const auto enough = [&] { return excess > 0 ? largest_but_for * excess : threshold; };
    const auto add = [&](std::vector<Point<dim>> corners)
    {
      auto part = judge(cell, std::move(corners), threshold);
      if (part.most > enough())
        parts.push(std::move(part));
    };
    add(corners_of_cell());
    for (unsigned step = 0; !parts.empty() && parts.top().most > enough(); ++step)
    {
      if (step == most_steps || steps_left == 0)
        return excess > 0 ? Verdict::found : Verdict::unknown;
      --steps_left;
      const Part part = parts.top();
      parts.pop();
      for (auto &half : halves_of(part.corners, simplex))
        add(std::move(half));
    }
    return excess > 0 ? Verdict::found : Verdict::nothing;
  }

  template <int dim>
  typename CrossingSearch<dim>::Verdict CrossingSearch<dim>::look_into(const Cell &cell)
  {
    // Away from the obstacle the values at the nodes are enough.
    const auto range = curved ? s.range(box_of(cell, corners_of_cell())) : range_on(s, vertices_of<dim>(cell));
    if (!range)
      return Verdict::unknown;
    if (range->empty())
      return Verdict::nothing;
    const bool nodal = !problem.space.hermite();
    if (nodal)
    {
      cell->get_dof_indices(dofs);
      for (unsigned i = 0; i < dofs.size(); ++i)
        u_at_nodes[i] = u(dofs[i]);
    }
    else
      take_u(cell);
    const auto [least, most] = std::minmax_element(u_at_nodes.begin(), u_at_nodes.end());
    const double slack = polynomials->degree > 1 ? slack_of_slopes * (*most - *least) : 0;
    if (side == Side::lower ? range->most <= *least - slack + tolerance : range->least >= *most + slack - tolerance)
      return Verdict::nothing;
    if (nodal)
      take_u(cell);
    if (search(cell, tolerance, most_steps_of_first_look) == Verdict::nothing)
      return Verdict::nothing;
    const bool   touches = touches_at_nodes(cell);
    const double seen = seen_beyond(cell, touches), threshold = std::max(tolerance, more_than_seen * seen);
    if (threshold == tolerance || problem.form->order() > 1)
      return search(cell, threshold, most_steps);
    const Verdict slopes = search_for_slopes(cell);
    if (slopes == Verdict::found || (slopes == Verdict::unknown && !touches))
      return search(cell, tolerance, most_steps);
    const Verdict more = search(cell, threshold, most_steps);
    if (more != Verdict::nothing)
      return more;
    return !touches && search(cell, tolerance, most_steps) == Verdict::found ? Verdict::seen : Verdict::nothing;
  }

  template class CrossingSearch<1>;
  template class CrossingSearch<2>;
  template class CrossingSearch<3>;
} // namespace unilateral
