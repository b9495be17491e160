#include "unilateral/inequality/semismooth_newton.h"

#include "unilateral/inequality/newton_iteration.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>
#include <stdexcept>
#include <utility>

namespace unilateral
{
  namespace
  {
    /// On an active set that rests the problem is linear: a step that gains nothing is round-off, or a linear solver that cannot do better.
    constexpr unsigned most_idle_steps = 4;

    /// Where the line search cuts steps short, directions are worth more accuracy: the set changes little by each of them.
    constexpr double   short_step_length = 0.1, long_step_length = 0.5;
    constexpr unsigned most_iterations_for_direction = 128;

    /// Where contact and pressure are zero alike, which points touch is decided by rounding, and relaxation would never leave it as it is.
    constexpr double   negligible_for_relaxation = 1e-6;
    constexpr unsigned most_relaxations = 40;

    const char *const no_minimum =
      "the energy has no minimum: the form a is not coercive, or a part of the mesh is held by nothing but contact that was not found";

    /// One step of Newton's method.
    struct StepOnSet
    {
      PointSet    set;               ///< the active set for which the problem is linearised
      bool        predicted = false; ///< this set is not that of u
      LinearSolve solve;
      double      decrement = 0; ///< length of the direction in the norm of the energy
      double      length = 1;    ///< how far along the direction
      std::size_t flipped = 0;
      bool        ends_on_another_set = false;
    };

    /// semismooth_newton() with what it remembers from step to step.
    class SemismoothNewton
    {
    public:
      SemismoothNewton(const AugmentedProblem  &augmented,
                       const NewtonParameters  &parameters,
                       const std::vector<bool> &predicted_active,
                       Vector                  &u,
                       Vector                  &Au)
        : processes(augmented.problem.processes()), symmetric(augmented.problem.symmetric()), parameters(parameters),
          iteration(augmented, u, Au), prediction(predicted_active.begin(), predicted_active.end()), tolerance(parameters.tolerance),
          enough_iterations(parameters.enough_iterations)
      {
        // A process without points has nothing to predict.
        if (processes.any(!prediction.empty()) && !iteration.stops_rigid_body_modes(prediction))
          prediction.clear(); // a step that nothing holds
      }

      NewtonResult solve(const Progress &progress)
      {
        balance_modes_that_contact_leaves_free();
        while (parameters.steps_before + result.history.size() < parameters.max_steps)
        {
          if (processes.any(progress.stop_requested()))
            throw Interrupted();
          StepOnSet step = next_step();
          iteration.evaluate_residual(step.set);
          if (!find_direction(step) || !move_along_direction(step))
            return result;
          adapt_accuracy_of_directions(step);
          improve_active_set(step);
          record(step);
          if (has_ended(step))
            return result;
        }
        result.out_of_steps = true;
        result.reason =
          "no rest after " + std::to_string(parameters.max_steps) + " Newton steps" + (damp ? ": the active sets repeat" : "");
        return result;
      }

    private:
      /// The first step may take a prediction for the active set.
      StepOnSet next_step() const
      {
        StepOnSet step;
        step.predicted = result.history.empty() && processes.any(!prediction.empty());
        step.set = step.predicted ? prediction : iteration.active;
        return step;
      }

      /// Solves the problem that is linearised on the set. False: there is no direction, or none that lowers the energy.
      bool find_direction(StepOnSet &step)
      {
        const SolveTolerance until =
          active_set_rests ? SolveTolerance{tolerance, 0.} : SolveTolerance{tolerance, parameters.forcing, enough_iterations};
        try
        {
          step.solve = iteration.solve_for_direction(step.set, until);
        }
        catch (const std::runtime_error &failure)
        {
          result.reason = failure.what();
          return false;
        }
        step.decrement = iteration.decrement();
        // Without load, and before there is contact, the first steps have nothing to do.
        if (step.decrement > 0 && !std::exchange(scale_is_known, true))
          tolerance = std::max(tolerance, parameters.relative_tolerance * step.decrement);
        if (!symmetric || !iteration.shows_lack_of_coercivity())
          return true;
        result.reason = no_minimum;
        return false;
      }

      /// To the minimum of the energy where there is one: along the direction, and along the rigid body modes that the set leaves free.
      /// False where the energy falls for ever.
      bool move_along_direction(StepOnSet &step)
      {
        // Of several processes each knows its part of the set: none of the parts is a new one.
        if (!symmetric && !step.predicted && !damp)
          damp = !processes.any(visited.insert(step.set).second);
        if (symmetric && !step.predicted && !iteration.stops_rigid_body_modes(step.set))
        {
          step.flipped = iteration.move_with_rigid_body_modes(step.length);
          return true;
        }
        step.length = step.predicted ? 1. : symmetric ? iteration.energy_step_length() : damp ? iteration.residual_step_length() : 1.;
        if (!(step.length < 1e8))
        {
          result.reason = no_minimum;
          return false;
        }
        step.flipped = iteration.move(step.length);
        return true;
      }

      void adapt_accuracy_of_directions(const StepOnSet &step)
      {
        if (iteration.has_rigid_body_modes() && !step.predicted && step.length < short_step_length)
          enough_iterations = std::min(2 * enough_iterations, most_iterations_for_direction);
        else if (step.length > long_step_length)
          enough_iterations = std::max(enough_iterations / 2, parameters.enough_iterations);
      }

      /// Relaxation around the free boundary where the step has left its set, and balance of forces where contact leaves modes free.
      void improve_active_set(StepOnSet &step)
      {
        step.ends_on_another_set = processes.any(step.set != iteration.active);
        if (!step.predicted)
          largest_decrement = std::max(largest_decrement, step.decrement);
        if (step.ends_on_another_set && symmetric && step.decrement > negligible_for_relaxation * largest_decrement &&
            n_relaxations < most_relaxations)
        {
          ++n_relaxations;
          iteration.relax();
        }
        balance_modes_that_contact_leaves_free();
        step.ends_on_another_set = step.ends_on_another_set || processes.any(step.set != iteration.active);
      }

      void balance_modes_that_contact_leaves_free()
      {
        if (!iteration.stops_rigid_body_modes(iteration.active))
          iteration.balance_rigid_body_modes();
      }

      void record(const StepOnSet &step)
      {
        NewtonStep &entry = result.history.emplace_back();
        entry.active = iteration.n_active();
        entry.flipped = step.flipped;
        entry.linear_iterations = step.solve.iterations;
        entry.step_length = step.length;
        entry.residual = step.decrement;
        result.linear_iterations += step.solve.iterations;
        result.flipped += step.flipped;
        result.residual = step.solve.residual;
      }

      /// It has converged, or nothing is gained any more: `result` says which.
      bool has_ended(const StepOnSet &step)
      {
        if (!std::isfinite(step.decrement + step.solve.residual))
        {
          result.reason = step.solve.failure.empty() ? "a Newton step is not finite" : step.solve.failure;
          return true;
        }
        if (!step.solve.converged && step.solve.residual > tolerance)
        {
          result.reason = step.solve.failure;
          return true;
        }
        active_set_rests = !step.predicted && (step.flipped == 0 || step.decrement <= tolerance);
        const bool solved_on_this_set = !step.ends_on_another_set && std::abs(step.length - 1) < 1e-3;
        // A short step of an iterative solver is no proof: what is left of the residual has to be as small.
        const bool short_step =
          !step.predicted && step.decrement <= tolerance && (step.solve.iterations == 0 || step.solve.residual <= tolerance);
        if ((solved_on_this_set && step.solve.residual <= tolerance) || short_step)
        {
          iteration.balance_rigid_body_modes(); // to round-off, whatever the linear solver has left
          result.converged = true;
          result.reason = "the active set rests";
          return true;
        }
        // A direct solve leaves nothing to gain on the same set; the residual is then round-off above the tolerance.
        if (solved_on_this_set && step.solve.iterations == 0)
        {
          converge_at_round_off();
          return true;
        }
        return stalls(step);
      }

      /// On an active set that rests several steps have gained nothing: the residual is round-off, or the linear solver fails.
      bool stalls(const StepOnSet &step)
      {
        n_idle_steps = active_set_rests && step.decrement > 0.9 * least_decrement ? n_idle_steps + 1 : 0;
        if (step.decrement > 0) // a first step that has nothing to do is no measure
          least_decrement = std::min(least_decrement, step.decrement);
        if (n_idle_steps < most_idle_steps)
          return false;
        if (step.decrement <= iteration.round_off())
          converge_at_round_off();
        else
          result.reason =
            fmt::format("Newton's method stalls: the residual stays {:.1g} times above the tolerance", step.decrement / tolerance);
        return true;
      }

      void converge_at_round_off()
      {
        result.converged = result.at_round_off = true;
        result.reason = "the active set rests, residual at round-off";
      }

      const Processes        &processes;
      const bool              symmetric;
      const NewtonParameters &parameters;
      NewtonIteration         iteration;
      PointSet                prediction; ///< of the active set; empty: none
      NewtonResult            result;
      double                  tolerance;
      bool                    scale_is_known = false; ///< of the tolerance that is relative to the first step
      unsigned                enough_iterations;      ///< of the linear solver while the active set still changes
      bool                    active_set_rests = false;
      bool                    damp = false;
      std::set<PointSet>      visited; ///< active sets, only kept where a cycle is possible
      unsigned                n_relaxations = 0, n_idle_steps = 0;
      double                  largest_decrement = 0, least_decrement = std::numeric_limits<double>::max();
    };
  } // namespace

  NewtonResult semismooth_newton(const AugmentedProblem  &augmented,
                                 const NewtonParameters  &parameters,
                                 const std::vector<bool> &predicted_active,
                                 Vector                  &u,
                                 Vector                  &Au,
                                 Progress                &progress)
  {
    return SemismoothNewton(augmented, parameters, predicted_active, u, Au).solve(progress);
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
