#include "unilateral/inequality/method_of_multipliers.h"

#include "unilateral/inequality/balanced_pressure.h"
#include "unilateral/inequality/free_boundary_relaxation.h"
#include "unilateral/inequality/semismooth_newton.h"
#include "unilateral/inequality/solution_check.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>

namespace unilateral
{
  MultiplierResult &MultiplierResult::operator+=(const MultiplierResult &later)
  {
    converged = later.converged;
    reason = later.reason;
    outer_iterations += later.outer_iterations;
    linear_iterations += later.linear_iterations;
    flipped += later.flipped;
    equilibrium = later.equilibrium;
    complementarity = later.complementarity;
    history.insert(history.end(), later.history.begin(), later.history.end());
    return *this;
  }

  ComplementarityResidual
  complementarity_residual(const DiscreteProblem &problem, const double epsilon, const Vector &u, const Vector &lambda)
  {
    Vector trace, sizes;
    problem.initialize_point_vector(trace);
    problem.initialize_point_vector(sizes);
    problem.apply_trace(trace, u);
    problem.apply_trace_to_sizes(sizes, u);
    const Vector &s = problem.obstacle(), &w = problem.weights(), &tau = problem.compliance();

    ComplementarityResidual result;
    const double *const Bu_of = trace.begin(), *const size_of = sizes.begin(), *const s_of = s.begin(), *const w_of = w.begin(),
                        *const tau_of = tau.begin(), *const lambda_of = lambda.begin();
    for (std::size_t i = 0, n = trace.locally_owned_size(); i < n; ++i)
    {
      if (!problem.owns_point(i))
        continue;
      const double l = lambda_of[i], per_tau = 1 / tau_of[i], weight = w_of[i] * tau_of[i];
      const double of_gap = l + (Bu_of[i] - s_of[i] - epsilon * l) * per_tau, c = l - std::max(of_gap, 0.);
      double       last_digit = std::numeric_limits<double>::epsilon() * (size_of[i] + std::abs(s_of[i])) * per_tau;
      if (of_gap < -last_digit) // negative whatever is rounded: c is the pressure
        last_digit = 0;
      result.norm += weight * c * c;
      result.lambda_norm += weight * l * l;
      result.round_off += weight * last_digit * last_digit;
    }
    for (double *const sum : {&result.norm, &result.lambda_norm, &result.round_off})
      *sum = problem.processes().sum(*sum);
    return {std::sqrt(result.norm), std::sqrt(result.lambda_norm), std::sqrt(result.round_off)};
  }

  namespace
  {
    /// r_i = shift tau_i, or 0 where eps alone is as soft as that, up to rounding: eps may be just that multiple of tau.
    void set_shift(Vector &r, const DiscreteProblem &problem, const double epsilon, const double shift)
    {
      const double *const tau = problem.compliance().begin();
      double *const       r_of = r.begin();
      for (std::size_t i = 0, n = r.locally_owned_size(); i < n; ++i)
        r_of[i] = epsilon >= (1 - 1e-12) * shift * tau[i] ? 0. : shift * tau[i];
    }

    /// An energy norm of the solution that vanishes only when everything does.
    double energy_scale(const DiscreteProblem &problem, const Vector &u, const Vector &Au, const double lambda_norm)
    {
      return std::sqrt(std::abs(problem.dot(u, Au)) + std::abs(problem.dot(u, problem.load())) + lambda_norm * lambda_norm);
    }

    /// A tolerance can be asked for that double precision does not reach.
    std::string reason_to_stop(const MultiplierResult &result, const double tolerance)
    {
      const double worse = std::max(result.equilibrium, result.complementarity);
      return worse <= tolerance ? "equilibrium and complementarity hold to the tolerance"
                                : fmt::format("equilibrium and complementarity hold to round-off, {:.1e}", worse);
    }

    /// (f' diag(A)^-1 f)^1/2: the load in the unit of lambda_norm, for problems whose multiplier is zero.
    double load_norm(const DiscreteProblem &problem)
    {
      const double *const f = problem.load().begin(), *const a = problem.stiffness_diagonal().begin();
      return std::sqrt(problem.sum_over_unknowns([&](const std::size_t j) { return f[j] * f[j] / a[j]; }));
    }

    /// Where only contact holds the solution and linear systems are solved by iteration, steps change many points: a stiffer penalty makes
    /// them short (a ring on a pin that nearly fills it: 200 Newton steps and no end with 1e-3, 18 with 1e-2).
    double shift_to_start_with(const DiscreteProblem &problem, const MultiplierParameters &parameters)
    {
      constexpr double for_free_bodies = 1e-2;
      return problem.null_space().empty() || problem.solves_exactly() ? parameters.shift : std::max(parameters.shift, for_free_bodies);
    }

    /// The method of multipliers with what it remembers from step to step.
    class MethodOfMultipliers
    {
    public:
      MethodOfMultipliers(
        DiscreteProblem &problem, const MultiplierParameters &parameters, std::vector<bool> predicted_active, Vector &u, Vector &lambda)
        : problem(problem), parameters(parameters), predicted_active(std::move(predicted_active)), u(u),
          lambda(lambda), augmented{problem, parameters.epsilon, {}, lambda}, first_shift(shift_to_start_with(problem, parameters)),
          shift(first_shift)
      {
        problem.initialize_point_vector(augmented.shift);
        problem.initialize_dof_vector(Au);
      }

      MultiplierResult solve(Progress &progress)
      {
        start();
        for (; result.outer_iterations < parameters.max_steps; ++result.outer_iterations)
        {
          const Minimisation step = next_minimisation();
          const NewtonResult inner = semismooth_newton(augmented, step.newton, prediction(), u, Au, progress);
          augmented.next_multiplier(lambda, u);
          softened = false;
          const ComplementarityResidual residual = measure(inner, progress);

          if (inner.out_of_steps && step.on_patience_lost != Minimisation::give_up && result.history.size() < parameters.max_newton_steps)
          {
            if (step.on_patience_lost == Minimisation::soften)
              soften();
            else
              approach_by_penalties(progress);
            continue;
          }
          if (const auto reason = why_unusable(inner); reason && polishing)
            return finish_with_unpolished();
          else if (reason)
            return finish(false, *reason);
          const bool complementary = is_complementary(residual);
          if (complementary && !step.exact && inner.residual > step.final_tolerance)
          {
            settled = true; // what is left to do is to solve for u to the tolerance
            continue;
          }
          const bool digits_lost = has_lost_digits(residual);
          if (complementary && digits_lost && !polishing)
          {
            start_polishing();
            continue;
          }
          if (complementary)
            return finish(true, reason_to_stop(result, parameters.tolerance));
          if (polishing && ++polishing_steps == parameters.polishing_steps)
            return finish_with_unpolished();
          reduce_shift_if_slow(inner.history.size());
        }
        result.reason = fmt::format("complementarity is still {:.1e} after {} steps of the method of multipliers", result.complementarity,
                                    result.outer_iterations);
        return result;
      }

    private:
      /// How the next minimisation is to be done.
      struct Minimisation
      {
        NewtonParameters newton;
        double           final_tolerance = 0; ///< of the residual, in the energy norm, when the method ends
        bool             exact = false;       ///< to that tolerance already
        enum
        {
          give_up,
          soften,               ///< a larger shift is possible
          approach_by_penalties ///< something but contact holds the solution
        } on_patience_lost = give_up;
      };

      /// The prediction is improved around its boundary, and A u computed.
      void start()
      {
        set_shift(augmented.shift, problem, parameters.epsilon, first_shift);
        if (problem.processes().any(!predicted_active.empty()))
          relax_near_free_boundary(augmented, predicted_active, u);
        problem.apply_stiffness(Au, u);
        no_pressure = 1e-4 * load_norm(problem);
        inexactness = problem.solves_exactly() ? 0 : std::min(first_shift, 1e-2);
      }

      Minimisation next_minimisation()
      {
        set_shift(augmented.shift, problem, parameters.epsilon, shift);
        augmented.multiplier = lambda;
        if (!problem.symmetric())
          u_before = u;
        if (energy == 0)
          energy = energy_scale(problem, u, Au, no_pressure);

        Minimisation next;
        next.newton.steps_before = result.history.size();
        const bool held = problem.symmetric() && problem.null_space().empty();
        if (held && !approached)
          next.on_patience_lost = Minimisation::approach_by_penalties;
        else if (!held && shift < 0.5 && problem.largest(augmented.shift) > 0)
          next.on_patience_lost = Minimisation::soften;
        next.newton.max_steps = next.on_patience_lost == Minimisation::give_up
                                  ? parameters.max_newton_steps
                                  : std::min<unsigned>(parameters.max_newton_steps, next.newton.steps_before + parameters.patience);
        next.final_tolerance = 0.1 * parameters.tolerance * energy;
        const double for_now = inexactness * std::min(last_complementarity, 1e-3) * energy;
        next.exact = settled || polishing || for_now <= next.final_tolerance || problem.largest(augmented.shift) == 0;
        if (energy == 0 && inexactness > 0) // the bounds alone move a body at rest: the first step tells how much
        {
          next.newton.relative_tolerance = 1e-3 * inexactness;
          next.exact = false;
        }
        next.newton.tolerance = next.exact ? next.final_tolerance : for_now;
        return next;
      }

      /// After a multiplier step the active set is expected to stay: the first Newton step takes it for granted.
      std::vector<bool> prediction() const
      {
        return softened ? std::vector<bool>() : result.outer_iterations > 0 ? positive(lambda) : predicted_active;
      }

      /// Equilibrium and complementarity, relative to the solution; adds the Newton steps to the history.
      ComplementarityResidual measure(const NewtonResult &inner, Progress &progress)
      {
        const auto residual = complementarity_residual(problem, parameters.epsilon, u, lambda);
        pressure_scale = std::max(residual.lambda_norm, no_pressure);
        energy = energy_scale(problem, u, Au, pressure_scale);
        result.complementarity = pressure_scale > 0 ? residual.norm / pressure_scale : 0.;
        result.equilibrium = energy > 0 ? inner.residual / energy : 0.;
        add_to_history(inner, progress);
        return residual;
      }

      void add_to_history(const NewtonResult &inner, Progress &progress)
      {
        result.linear_iterations += inner.linear_iterations;
        result.flipped += inner.flipped;
        for (NewtonStep step : inner.history)
        {
          step.outer = result.outer_iterations;
          step.residual = energy > 0 ? step.residual / energy : 0.;
          result.history.push_back(step);
          progress.newton_step(step);
        }
      }

      /// On a mesh without a coarser one before it the boundary of the contact set may have thousands of cells to go, and with a small
      /// shift it goes a cell a step. With a penalty as soft as the whole domain the set changes everywhere at once: the solutions for
      /// smaller and smaller ones lead to that of the shift.
      void approach_by_penalties(Progress &progress)
      {
        constexpr double relative_to_domain = 0.1, factor = 1. / 30;
        approached = softened = true;
        lambda = augmented.multiplier;
        Vector whole, deflection, rhs, x, no_contact;
        for (Vector *const at_points : {&whole, &deflection, &no_contact})
          problem.initialize_point_vector(*at_points);
        for (Vector *const at_unknowns : {&rhs, &x})
          problem.initialize_dof_vector(*at_unknowns);
        // In one direction, as on a function that is one: bounds from both sides would cancel.
        x = 1;
        problem.apply_trace(whole, x);
        for (std::size_t i = 0, n = whole.locally_owned_size(); i < n; ++i)
          whole(i) = whole(i) < 0 ? -1 : 1;
        x = 0;
        problem.apply_trace_transpose(rhs, whole);
        if (!problem.solve_tangent(no_contact, rhs, {.relative = relative_to_domain}, x).converged)
          return;
        problem.apply_trace(deflection, x);
        double softest = 0; // in units of the local compliance
        for (std::size_t i = 0, n = deflection.locally_owned_size(); i < n; ++i)
          softest = std::max(softest, std::abs(deflection(i)) / problem.compliance()(i));
        softest = relative_to_domain * problem.processes().max(softest);
        for (double penalty = softest; penalty > first_shift && result.history.size() < parameters.max_newton_steps; penalty *= factor)
        {
          set_shift(augmented.shift, problem, parameters.epsilon, penalty);
          const NewtonParameters parts{.relative_tolerance = relative_to_domain,
                                       .max_steps = parameters.max_newton_steps,
                                       .steps_before = unsigned(result.history.size())};
          const NewtonResult     inner = semismooth_newton(augmented, parts, {}, u, Au, progress);
          add_to_history(inner, progress);
          if (!inner.converged)
            return;
        }
      }

      /// A larger shift, hence a softer penalty: for a body that only contact holds, and for forms that are not symmetric, where no energy
      /// guides Newton's method and active sets may repeat. Nor is there an energy that would have fallen on the way: back to the start.
      void soften()
      {
        shift = smallest_shift_for_newton = std::min(10 * shift, 1.);
        lambda = augmented.multiplier; // that of the state before belongs to no minimum
        softened = problem.symmetric();
        if (problem.symmetric())
          return;
        u = u_before;
        problem.apply_stiffness(Au, u);
      }

      /// Why what Newton's method has left is not to be continued with; empty: it may be.
      std::optional<std::string> why_unusable(const NewtonResult &inner) const
      {
        if (!inner.converged)
          return inner.reason;
        if (inner.at_round_off && !(result.equilibrium <= std::max(parameters.largest_round_off, parameters.tolerance)))
          return fmt::format("the linear system is nearly singular: a residual of {:.1e} is left; does something "
                             "hold every part of the solution?",
                             result.equilibrium);
        if (!std::isfinite(result.equilibrium + result.complementarity + energy))
          return "the solution is not finite: is the form a coercive?";
        return {};
      }

      bool is_complementary(const ComplementarityResidual &residual) const
      {
        return result.complementarity <= parameters.tolerance || residual.norm <= 4 * (residual.round_off + parameters.data_round_off);
      }

      /// lambda = (Bu - s + R lambda) / (eps + R) has the last digit of Bu magnified by 1/(eps + R). Where that shows, a few steps with
      /// R = tau, where next to nothing is magnified, wash it out: a step never takes lambda farther from the solution. Not where R had to
      /// be reduced (C_h = 0 or small): there such steps are slow.
      bool has_lost_digits(const ComplementarityResidual &residual) const
      {
        return shift >= first_shift && shift < 1 && (problem.largest(augmented.shift) > 0 || parameters.epsilon > 0) &&
               residual.round_off > 4 * shift * parameters.tolerance * pressure_scale;
      }

      void start_polishing()
      {
        polishing = true;
        shift = 1;
        unpolished = {u, lambda, result.equilibrium, result.complementarity};
      }

      /// A shift that Newton's method has lost patience with is tried again once the active set rests at once: where points are redundant
      /// (C_h = 0) steps with a large shift are slow. Not for bodies: there the energy leads to the minimum with the large shift, too.
      void reduce_shift_if_slow(const std::size_t newton_steps)
      {
        if (!problem.symmetric() && newton_steps == 1)
          smallest_shift_for_newton *= 0.1;
        if (!polishing && result.outer_iterations > 0 && result.complementarity > 0.1 * last_complementarity)
          shift = std::max({0.1 * shift, parameters.smallest_shift, smallest_shift_for_newton});
        last_complementarity = result.complementarity;
      }

      MultiplierResult finish(const bool converged, const std::string &reason)
      {
        ++result.outer_iterations;
        result.converged = converged;
        result.reason = reason;
        return result;
      }

      MultiplierResult finish_with_unpolished()
      {
        u = unpolished.u;
        lambda = unpolished.lambda;
        result.equilibrium = unpolished.equilibrium;
        result.complementarity = unpolished.complementarity;
        return finish(true, reason_to_stop(result, parameters.tolerance));
      }

      DiscreteProblem            &problem;
      const MultiplierParameters &parameters;
      std::vector<bool>           predicted_active;
      Vector                     &u, &lambda, Au;
      Vector                      u_before;  ///< the start of the current step, kept where Newton's method may not come closer
      AugmentedProblem            augmented; ///< of the current step
      MultiplierResult            result;

      const double first_shift;
      double       shift;                         ///< all shifts in units of the local compliance
      double       smallest_shift_for_newton = 0; ///< Newton's method lost patience with a smaller one
      bool         softened = false;              ///< in the last step: the active set is that of u, not of lambda
      bool         approached = false;            ///< see approach_by_penalties()

      /// Pressures below this are nothing: the scale of complementarity when contact is about to vanish.
      double no_pressure = 0;
      double pressure_scale = 0, energy = 0; ///< of the state at hand

      /// As long as the multiplier is to move, a solution far better than the next one is would be lost. A step makes the error of the
      /// multiplier smaller by about the shift, where that is small and B B' diagonal, and hardly more than a hundred times elsewhere.
      double inexactness = 0;
      double last_complementarity = 1;
      bool   settled = false; ///< the multiplier is good enough

      bool     polishing = false;
      unsigned polishing_steps = 0;
      /// The state that polishing starts from holds the tolerance: it is the answer where polishing comes to nothing.
      struct
      {
        Vector u, lambda;
        double equilibrium = 0, complementarity = 0;
      } unpolished;
    };
  } // namespace

  MultiplierResult method_of_multipliers(DiscreteProblem            &problem,
                                         const MultiplierParameters &parameters,
                                         std::vector<bool>           predicted_active,
                                         Vector                     &u,
                                         Vector                     &lambda,
                                         Progress                   &progress)
  {
    MultiplierResult result = MethodOfMultipliers(problem, parameters, std::move(predicted_active), u, lambda).solve(progress);
    if (!result.converged)
      return result;
    if (problem.symmetric())
    {
      Vector shift;
      problem.initialize_point_vector(shift);
      set_shift(shift, problem, parameters.epsilon, parameters.shift);
      restore_balance(problem, std::max(parameters.largest_round_off, round_off_of_pressure(problem, parameters.epsilon, shift, u, lambda)),
                      u, lambda);
    }
    const double tolerance = std::max(parameters.largest_round_off, 100 * parameters.tolerance);
    if (const std::string objection = objection_to_solution(problem, parameters.epsilon, tolerance, u, lambda); !objection.empty())
    {
      result.converged = false;
      result.reason = objection;
    }
    return result;
  }
} // namespace unilateral
