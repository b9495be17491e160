#include "unilateral/inequality/semismooth_newton.h"

#include "unilateral/inequality/newton_iteration.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>
#include <stdexcept>

namespace unilateral
{
  NewtonResult semismooth_newton(const AugmentedProblem  &augmented,
                                 const NewtonParameters  &parameters,
                                 const std::vector<bool> &predicted_active,
                                 Vector                  &u,
                                 Vector                  &Au,
                                 Progress                &progress)
  {
    NewtonResult       result;
    NewtonIteration    iteration(augmented, u, Au);
    const bool         symmetric = augmented.problem.symmetric();
    std::set<PointSet> visited; // active sets, only kept where a cycle is possible
    PointSet           prediction(predicted_active.begin(), predicted_active.end());
    if (!prediction.empty() && !iteration.stops_rigid_body_modes(prediction))
      prediction.clear(); // a step that nothing holds
    if (!iteration.stops_rigid_body_modes(iteration.active))
      iteration.balance_rigid_body_modes();
    bool   damp = false, active_set_rests = false;
    double tolerance = parameters.tolerance;
    // On an active set that rests the problem is linear: a step that gains nothing is round-off, or a linear solver that cannot do better.
    constexpr unsigned most_idle_steps = 4;
    // Where the line search cuts steps short, directions are worth more accuracy: the set changes little by each of them.
    constexpr double   short_step_length = 0.1, long_step_length = 0.5;
    constexpr unsigned most_iterations = 128;
    unsigned           enough_iterations = parameters.enough_iterations;
    unsigned           n_idle_steps = 0;
    double             least_decrement = std::numeric_limits<double>::max();

    // Where contact and pressure are zero alike, which points touch is decided by rounding, and relaxation would never leave it as it is.
    constexpr double   negligible_for_relaxation = 1e-6;
    constexpr unsigned most_relaxations = 40;
    unsigned           n_relaxations = 0;
    double             largest_decrement = 0;

    while (parameters.steps_before + result.history.size() < parameters.max_steps)
    {
      if (augmented.problem.processes().any(progress.stop_requested()))
        throw Interrupted();
      const bool     predicted = result.history.empty() && augmented.problem.processes().any(!prediction.empty());
      const PointSet set = predicted ? prediction : iteration.active;
      iteration.evaluate_residual(set);
      LinearSolve solve;
      try
      {
        solve = iteration.solve_for_direction(set, active_set_rests ? SolveTolerance{tolerance, 0.}
                                                                    : SolveTolerance{tolerance, parameters.forcing, enough_iterations});
      }
      catch (const std::runtime_error &failure)
      {
        result.reason = failure.what();
        return result;
      }
      const double decrement = iteration.decrement();
      if (result.history.empty())
        tolerance = std::max(tolerance, parameters.relative_tolerance * decrement);

      if (symmetric && iteration.shows_lack_of_coercivity())
      {
        result.reason = "the form a is not coercive: its energy has no minimum";
        return result;
      }
      if (!symmetric && !predicted && !damp)
        damp = !visited.insert(set).second;
      const bool  with_modes = symmetric && !predicted && !iteration.stops_rigid_body_modes(set);
      double      t = 1;
      std::size_t flipped = 0;
      if (with_modes)
        flipped = iteration.move_with_rigid_body_modes(t);
      else
      {
        t = predicted ? 1. : symmetric ? iteration.energy_step_length() : damp ? iteration.residual_step_length() : 1.;
        if (!(t < 1e8))
        {
          result.reason = "the form a is not coercive: its energy has no minimum";
          return result;
        }
        flipped = iteration.move(t);
      }
      if (iteration.has_rigid_body_modes() && !predicted && t < short_step_length)
        enough_iterations = std::min(2 * enough_iterations, most_iterations);
      else if (t > long_step_length)
        enough_iterations = std::max(enough_iterations / 2, parameters.enough_iterations);
      bool set_is_left = augmented.problem.processes().any(set != iteration.active);
      if (!predicted)
        largest_decrement = std::max(largest_decrement, decrement);
      if (set_is_left && symmetric && decrement > negligible_for_relaxation * largest_decrement && n_relaxations < most_relaxations)
      {
        ++n_relaxations;
        iteration.relax();
      }
      if (!iteration.stops_rigid_body_modes(iteration.active))
        iteration.balance_rigid_body_modes();
      set_is_left = set_is_left || augmented.problem.processes().any(set != iteration.active);

      NewtonStep step;
      step.active = iteration.n_active();
      step.flipped = flipped;
      step.linear_iterations = solve.iterations;
      step.step_length = t;
      step.residual = decrement;
      result.history.push_back(step);
      result.linear_iterations += solve.iterations;
      result.flipped += flipped;
      result.residual = solve.residual;

      if (!solve.converged && solve.residual > tolerance)
      {
        result.reason = solve.failure;
        return result;
      }
      active_set_rests = !predicted && (flipped == 0 || decrement <= tolerance);
      const bool solved_on_this_set = !set_is_left && std::abs(t - 1) < 1e-3;
      // A short step of an iterative solver is no proof: what is left of the residual has to be as small.
      const bool short_step = !predicted && decrement <= tolerance && (solve.iterations == 0 || solve.residual <= tolerance);
      if ((solved_on_this_set && solve.residual <= tolerance) || short_step)
      {
        iteration.balance_rigid_body_modes(); // to round-off, whatever the linear solver has left
        result.converged = true;
        result.reason = "the active set rests";
        return result;
      }
      // A direct solve leaves nothing to gain on the same set; the residual is then round-off above the tolerance.
      if (solved_on_this_set && solve.iterations == 0)
      {
        result.converged = result.at_round_off = true;
        result.reason = "the active set rests, residual at round-off";
        return result;
      }
      n_idle_steps = active_set_rests && decrement > 0.9 * least_decrement ? n_idle_steps + 1 : 0;
      least_decrement = std::min(least_decrement, decrement);
      if (n_idle_steps == most_idle_steps)
      {
        result.converged = result.at_round_off = decrement <= iteration.round_off();
        result.reason = result.converged ? "the active set rests, residual at round-off"
                                         : fmt::format("Newton's method stalls: the residual stays {:.1g} times above the tolerance",
                                                       decrement / tolerance);
        return result;
      }
    }
    result.out_of_steps = true;
    result.reason = "no rest after " + std::to_string(parameters.max_steps) + " Newton steps" + (damp ? ": the active sets repeat" : "");
    return result;
  }

  NewtonResult semismooth_newton(const AugmentedProblem  &augmented,
                                 const NewtonParameters  &parameters,
                                 const std::vector<bool> &predicted_active,
                                 Vector                  &u,
                                 Progress                &progress)
  {
    Vector Au;
    augmented.problem.initialize_dof_vector(Au);
    augmented.problem.apply_stiffness(Au, u);
    return semismooth_newton(augmented, parameters, predicted_active, u, Au, progress);
  }
} // namespace unilateral
