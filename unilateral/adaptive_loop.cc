#include "unilateral/adaptive_loop.h"

#include "unilateral/evaluation/estimator.h"
#include "unilateral/evaluation/unseen_contact.h"
#include "unilateral/mesh/nodes_of_refinement.h"
#include "unilateral/mesh/simplex_refinement.h"
#include "unilateral/spaces/cells_of_former_mesh.h"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numeric>
#include <utility>

namespace unilateral
{
  namespace
  {
    /// What rounding adds to the certified error, which grows like h^-2m, would on a mesh of half the size be more than the error now, @p m
    /// the order of H^m: as in fourth-order problems with thousands of cells in a row.
    bool rounding_outgrows(const Estimate &estimate, const std::optional<Certificate> &certificate, const unsigned m)
    {
      return certificate && certificate->available && std::pow(4., m) * certificate->round_off > estimate.total;
    }

    /// The largest number that @p accepts, which accepts all numbers below one that it accepts, 0 among them. Numbers that are not
    /// negative are in the order of their bits.
    template <typename Accepts>
    double largest_accepted(const Accepts &accepts)
    {
      std::uint64_t yes = 0, no = std::bit_cast<std::uint64_t>(std::numeric_limits<double>::infinity());
      while (no - yes > 1)
      {
        const std::uint64_t middle = yes + (no - yes) / 2;
        (accepts(std::bit_cast<double>(middle)) ? yes : no) = middle;
      }
      return std::bit_cast<double>(yes);
    }

    double sum_of(const std::vector<double> &squares, const Processes &processes)
    {
      return processes.sum(std::accumulate(squares.begin(), squares.end(), 0.));
    }
  } // namespace

  std::vector<bool> largest_contributions(const std::vector<double> &squares, const double share, const Processes &processes)
  {
    if (!processes.alone())
    {
      const double enough = share * sum_of(squares, processes);
      const double least = largest_accepted(
        [&](const double limit)
        {
          double sum = 0;
          for (const double square : squares)
            sum += square >= limit ? square : 0;
          return processes.sum(sum) >= enough;
        });
      std::vector<bool> chosen;
      for (const double square : squares)
        chosen.push_back(square >= least);
      return chosen;
    }
    std::vector<std::size_t> order(squares.size());
    std::iota(order.begin(), order.end(), std::size_t(0));
    std::stable_sort(order.begin(), order.end(), [&](const std::size_t a, const std::size_t b) { return squares[a] > squares[b]; });
    const double      enough = share * std::accumulate(squares.begin(), squares.end(), 0.);
    std::vector<bool> chosen(squares.size(), false);
    double            sum = 0;
    for (const std::size_t c : order)
    {
      chosen[c] = true;
      sum += squares[c];
      if (sum >= enough)
        break;
    }
    return chosen;
  }

  template <int dim>
  double AdaptiveLoop::bound_below(const Problem<dim> &problem) const
  {
    constexpr double in_any_case = std::numeric_limits<double>::infinity();
    if (!adapt || adapt->goal.is_a_number() || bound_per_estimate == 0)
      return in_any_case;
    const double n_unknowns = problem.space.n_unknowns();
    if (n_unknowns >= 8 * unknowns_at_bound || n_unknowns * std::pow(2., dim) > adapt->max_unknowns)
      return in_any_case;
    return adapt->tolerance * std::max(1., 1.5 / bound_per_estimate);
  }

  namespace
  {
    /// Of the square of the error, what is refined at once. More cells than needed come with a larger one, more meshes with a smaller one.
    /// Measured: in the plane 0.9 reaches a tolerance with a third fewer meshes than 0.75 and as many unknowns, in space with one and
    /// a half times as many.
    constexpr double largest_share(const int dim)
    {
      return dim == 3 ? 0.75 : 0.9;
    }

    /// Of the smallest cell over the largest. Where the solution has no finite energy nothing else ends.
    constexpr double least_size = 1e-12;

    /// Of the error in the energy norm, where that of the number which is asked for cannot be estimated.
    constexpr double small_enough = 0.02;

    /// Meshes that are refined for the sake of unseen_details(), each halving cells.
    constexpr unsigned most_refined_for_details = 8;

    /// Cells of one process over the mean. To begin with the coarse mesh takes about as long as to go on.
    constexpr double largest_imbalance_of_steps = 1.25;

    /// Fewer cells are not worth another solve, but for a tolerance that is nearly met.
    constexpr double least_share = 0.1;
  } // namespace

  double AdaptiveLoop::sum_per_tolerance() const
  {
    return adapt->goal.is_a_number() ? error_per_tolerance : std::pow(error_per_tolerance, 2);
  }

  void AdaptiveLoop::learn_from_refinement(const double sum_before, const unsigned degree)
  {
    const bool comparable = cycles.size() > 1 && cycles[cycles.size() - 2].guaranteed == cycles.back().guaranteed;
    if (comparable && sum_before > 0 && std::isfinite(sum_before + sum_per_tolerance()) && chosen_share > 0)
      left_by_halving = std::clamp(1 - (1 - sum_per_tolerance() / sum_before) / chosen_share, std::pow(0.25, degree), 0.5);
  }

  double AdaptiveLoop::share_to_refine(const int dim) const
  {
    if (error_per_tolerance <= 1) // to confirm the estimate
      return largest_share(dim);
    const double goal = adapt->goal.is_a_number() ? 0.97 : std::pow(0.97, 2);
    return std::clamp((1 - goal / sum_per_tolerance()) / (1 - left_by_halving), least_share, largest_share(dim));
  }

  namespace
  {
    /// Of simplices in proportion to their number. Nodes on cuts count on each process.
    template <int dim>
    double unknowns_after_refinement(const FunctionSpace<dim> &space, const std::vector<bool> &chosen)
    {
      const double n_unknowns = space.n_unknowns(), n_cells = space.n_cells();
      if constexpr (dim > 1)
      {
        if (space.element.simplex())
          return n_unknowns * double(space.processes().sum(std::uint64_t(n_cells_after_refinement(*space.mesh.triangulation, chosen)))) /
                 n_cells;
        if (space.refines_in_places())
          return n_unknowns +
                 double(space.processes().sum(std::uint64_t(n_new_nodes(*space.mesh.triangulation, chosen, space.element.degree)))) *
                   double(space.fe->n_components());
      }
      const double n_chosen = std::count(chosen.begin(), chosen.end(), true);
      return n_unknowns * (1 + (std::pow(2., dim) - 1) * (space.refines_in_places() ? n_chosen / n_cells : 1));
    }
  } // namespace

  void AdaptiveLoop::starts_from(const Vector &u)
  {
    if (adapt)
      start = u;
  }

  template <int dim>
  double AdaptiveLoop::correction_of_estimate(const Problem<dim> &problem, const Vector &u) const
  {
    if (cycles.empty() || start.size() != u.size())
      return 1;
    Vector change(start);
    problem.space.dirichlet.distribute(change);
    change -= u;
    const double moved = energy_norm(problem, change);
    return moved > estimate_before && estimate_before > 0 ? moved / estimate_before : 1;
  }

  double AdaptiveLoop::correction_of_estimate(const Estimate::Goal &goal) const
  {
    if (cycles.empty() || !cycles.back().goal || !(error_of_goal_before > 0) || !std::isfinite(error_of_goal_before))
      return 1;
    return std::max(1., std::abs(goal.value - cycles.back().goal->value) / error_of_goal_before);
  }

  template <int dim>
  bool AdaptiveLoop::ends(Solution<dim> &solution, const bool converged, Progress &progress)
  {
    const Problem<dim>        &problem = *solution.problem;
    const Vector              &u = solution.displacement;
    const std::vector<double> &error_squares = solution.error_squares;
    RunResult                 &result = solution.result;
    if (!adapt || !result.estimate)
      return true;
    Estimate    &estimate = *result.estimate;
    const double as_made = result.discretisation_indicator;
    const auto   say = [&](const std::string &changed, const double factor)
    {
      if (factor > 1)
        progress.log(fmt::format(
          "the last refinement changed {} by {:.2g} times the error estimated before it: the estimate is raised by that", changed, factor));
    };
    if (estimate.goal)
    {
      const double factor = correction_of_estimate(*estimate.goal);
      say(estimate.goal->quantity, factor);
      error_of_goal_before = std::exchange(estimate.goal->error, factor * estimate.goal->error);
    }
    else if (!estimate.guaranteed)
    {
      const double factor = correction_of_estimate(problem, u);
      say("u", factor);
      result.discretisation_indicator *= factor;
      estimate.total += (factor - 1) * estimate.discretisation;
      estimate.discretisation *= factor;
    }
    estimate_before = as_made;
    const double norm = result.reference_norm(), relative = norm > 0                   ? estimate.total / norm
                                                            : result.nothing_deforms() ? 0.
                                                                                       : std::numeric_limits<double>::infinity();
    const double n_unknowns = problem.space.n_unknowns();
    cycles.push_back({problem.space.level, problem.space.n_cells(), problem.space.n_unknowns(), estimate.total, estimate.discretisation,
                      estimate.penalty, estimate.algebraic, relative, estimate.guaranteed, estimate.goal});
    progress.log(estimate.goal ? fmt::format("mesh {} with {} unknowns: {} = {:.6g}, error about {:.2e} of it", cycles.size(), n_unknowns,
                                             estimate.goal->quantity, estimate.goal->value, estimate.goal->relative())
                               : fmt::format("mesh {} with {} unknowns: error {} {:.2e} of the energy norm", cycles.size(), n_unknowns,
                                             estimate.guaranteed ? "at most" : "about", relative));
    estimate.cycles = cycles;
    if (estimate.guaranteed && result.discretisation_indicator > 0)
    {
      bound_per_estimate = estimate.discretisation / result.discretisation_indicator;
      unknowns_at_bound = n_unknowns;
    }
    const double sum_before = sum_per_tolerance();
    error_per_tolerance = (estimate.goal ? estimate.goal->relative() : relative) / adapt->tolerance;
    learn_from_refinement(sum_before, problem.space.element.degree);
    const auto       unseen = unseen_contact(problem, solution.constraint_set, u, solution.contact_pressure);
    const Processes &processes = problem.space.processes();
    // What the points of cells do not show after as many halvings as the search looks ahead is a pole rather than a layer.
    const auto details = n_refined_for_details < most_refined_for_details ? result.unseen_details : std::vector<UnseenDetail>();
    const bool sees_all = !processes.any(!unseen.empty() || !details.empty());
    estimate.tolerance_met = error_per_tolerance <= 1 && sees_all;
    const bool confirmed = (estimate.guaranteed && !estimate.goal) || cycles.size() > 1 || result.nothing_deforms();
    if ((estimate.tolerance_met && confirmed) || !converged)
      return true;
    if (estimate.goal && !estimate.goal->why_no_error.empty() && sees_all && cycles.size() > 1 && relative <= small_enough)
      return true; // what has no error that could be estimated gets none by small errors of u
    if (sees_all && !(sum_of(error_squares, processes) > 0))
      return true; // no cell has a part in the error: finer ones would tell nothing
    if (error_per_tolerance > 1 && cycles.size() > 1 && rounding_outgrows(estimate, result.certificate, problem.form->order()))
    {
      estimate.ended_by_rounding = true;
      return true;
    }
    const auto [smallest, largest] = problem.space.cell_sizes();
    if (smallest < least_size * largest)
    {
      estimate.cells_too_small = true;
      return true;
    }
    if (!sees_all)
    {
      progress.log(fmt::format("contact or data that the points of cells do not show: {} cells there are refined first",
                               processes.sum(std::uint64_t(unseen.size() + details.size()))));
      chosen_share = 0;
      const auto unknowns_with_these = [&]
      {
        for (const UnseenContact &place : unseen)
          chosen[place.cell] = true;
        for (const UnseenDetail &detail : details)
          chosen[detail.cell] = true;
        return n_next = unknowns_after_refinement(problem.space, chosen);
      };
      if (!processes.any(!unseen.empty()))
      {
        ++n_refined_for_details;
        chosen = largest_contributions(error_squares, share_to_refine(dim), processes);
        if (unknowns_with_these() <= adapt->max_unknowns)
          return false;
      }
      chosen.assign(problem.space.mesh.triangulation->n_active_cells(), false);
      return unknowns_with_these() > adapt->max_unknowns;
    }
    const auto choose = [&](const double share)
    {
      chosen = largest_contributions(error_squares, share, processes);
      chosen_share = share;
      return n_next = unknowns_after_refinement(problem.space, chosen);
    };
    double share = share_to_refine(dim);
    if (choose(share) <= adapt->max_unknowns)
      return false;
    while ((share *= 0.7) >= least_share)
      if (choose(share) <= 0.8 * adapt->max_unknowns)
        return n_next < 1.2 * n_unknowns; // not worth a solve
    return true;
  }

  template <int dim>
  bool AdaptiveLoop::follows_former_mesh(const Problem<dim> &problem)
  {
    n_former.clear();
    if (!adapt || !adapt->former || former_reached)
      return false;
    // A cell that was refined has all of its children there, or more. Of a curved one the centres of some may lie beyond a side; a simplex
    // that was bisected because its neighbours were has fewer.
    const double most = (problem.space.element.simplex() ? 1 : 0.75) * std::pow(2., dim);
    const auto   n_within = n_former_cells(problem.space, *adapt->former);
    chosen.assign(n_within.size(), false);
    std::transform(n_within.begin(), n_within.end(), chosen.begin(), [&](const unsigned n) { return n >= most; });
    // The record comes from a file: one that holds the same point again and again must not refine a cell without end.
    const Processes &processes = problem.space.processes();
    const auto [smallest, largest] = problem.space.cell_sizes();
    former_reached = !processes.any(std::find(chosen.begin(), chosen.end(), true) != chosen.end()) || smallest < least_size * largest ||
                     unknowns_after_refinement(problem.space, chosen) > adapt->max_unknowns;
    if (former_reached)
      return false;
    n_former.assign(n_within.begin(), n_within.end());
    // What several processes are worth depends on the mesh that is known to come.
    n_next =
      double(problem.space.n_unknowns()) / problem.space.n_cells() * processes.sum(std::accumulate(n_former.begin(), n_former.end(), 0.));
    return true;
  }

  template <int dim>
  RefinementByError
  AdaptiveLoop::next_mesh(const Problem<dim> &problem, const std::vector<double> &error_squares, const Processes &processes) const
  {
    RefinementByError next{&chosen, {}, n_next};
    if (!processes.alone())
      next.expected = n_former.empty() ? expected_cells(problem, error_squares) : n_former;
    return next;
  }

  template <int dim>
  bool AdaptiveLoop::mesh_is_over_refined(const Problem<dim>        &problem,
                                          const std::vector<double> &error_squares,
                                          const unsigned             n_cells_unrefined) const
  {
    if (problem.space.processes().any(error_squares.empty()))
      return false;
    // The square of the error of a cell is of order h^(2 p + dim), its part in the error of a number as well. Where all cells have had what
    // they need, those just refined have that much less than those about to be.
    const double     of_larger_cell = std::pow(2., 2. * problem.space.element.degree + dim);
    const Processes &processes = problem.space.processes();
    const double     sum = sum_of(error_squares, processes), n_cells = double(problem.space.n_cells());
    const double     share = std::max(sum / sum_per_tolerance(), sum) / n_cells;
    const auto       n_too_fine =
      std::count_if(error_squares.begin(), error_squares.end(), [&](const double square) { return of_larger_cell * square <= share; });
    return processes.sum(double(n_too_fine)) > n_cells_unrefined + 0.5 * n_cells;
  }

  template <int dim>
  std::string AdaptiveLoop::obstacle_to_mesh(const Problem<dim>        &problem,
                                             const std::vector<double> &error_squares,
                                             const unsigned             n_cells_unrefined,
                                             const bool                 began_with_coarse_mesh) const
  {
    if (!adapt)
      return "";
    if (mesh_is_over_refined(problem, error_squares, n_cells_unrefined))
      return "the mesh of the step before is finer than it has to be in most places";
    if constexpr (dim > 1)
      if (problem.space.subdomain && !began_with_coarse_mesh && !problem.space.can_be_divided_anew())
        if (const double differ = largest_over_mean(problem.space.mesh.triangulation->n_active_cells(), problem.space.processes());
            differ > largest_imbalance_of_steps)
          return fmt::format("one process has {:.2g} times as many cells of the mesh of the step before as the mean", differ);
    return "";
  }

  template <int dim>
  std::vector<double> AdaptiveLoop::expected_cells(const Problem<dim> &problem, const std::vector<double> &error_squares) const
  {
    // All cells of the last mesh have the same error, delta^2, its sum over N of them being what is allowed: a cell with the square eta^2
    // becomes n of size h = n^(-1/dim), with eta^2 h^(2 degree + dim) each.
    const Processes    &processes = problem.space.processes();
    const double        most = std::max(1., adapt->max_unknowns / double(problem.space.n_unknowns())) * problem.space.n_cells();
    double              allowed = sum_of(error_squares, processes) / std::max(1., sum_per_tolerance()), n_all = problem.space.n_cells();
    std::vector<double> n(error_squares.size(), 1.);
    if (!(allowed > 0) || !std::isfinite(allowed))
      return n;
    constexpr unsigned n_rounds = 20;
    const double       exponent = dim / (2. * problem.space.element.degree + dim);
    for (unsigned round = 0; round < n_rounds; ++round)
    {
      const double delta_square = allowed / n_all;
      for (std::size_t c = 0; c < n.size(); ++c)
        n[c] = std::max(1., std::pow(error_squares[c] / delta_square, exponent));
      n_all = sum_of(n, processes);
      if (n_all > most) // more error has to be allowed
        allowed *= std::pow(n_all / most, 1 / exponent);
    }
    return n;
  }

#define INSTANTIATE(dim)                                                                                                                   \
  template double            AdaptiveLoop::bound_below(const Problem<dim> &) const;                                                        \
  template bool              AdaptiveLoop::ends(Solution<dim> &, bool, Progress &);                                                        \
  template bool              AdaptiveLoop::follows_former_mesh(const Problem<dim> &);                                                      \
  template RefinementByError AdaptiveLoop::next_mesh(const Problem<dim> &, const std::vector<double> &, const Processes &) const;          \
  template std::string       AdaptiveLoop::obstacle_to_mesh(const Problem<dim> &, const std::vector<double> &, unsigned, bool) const;
  INSTANTIATE(1)
  INSTANTIATE(2)
  INSTANTIATE(3)
#undef INSTANTIATE
} // namespace unilateral
