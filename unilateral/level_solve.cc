#include "unilateral/level_solve.h"

#include "unilateral/discretisation/rigid_body_modes.h"
#include "unilateral/equilibration/total_error.h"
#include "unilateral/evaluation/contact_between_nodes.h"
#include "unilateral/evaluation/crossed_bounds.h"
#include "unilateral/evaluation/data_round_off.h"
#include "unilateral/evaluation/equilibrium.h"
#include "unilateral/evaluation/estimator.h"
#include "unilateral/evaluation/goal_error.h"
#include "unilateral/evaluation/interior_residual.h"
#include "unilateral/evaluation/nodal_pressure.h"
#include "unilateral/evaluation/slope_jumps.h"
#include "unilateral/evaluation/unresolved_reaction.h"
#include "unilateral/evaluation/unresolved_springs.h"
#include "unilateral/evaluation/unresolved_stiffness.h"
#include "unilateral/evaluation/unseen_detail.h"
#include "unilateral/inequality/augmented_problem.h"
#include "unilateral/inequality/certificate.h"
#include "unilateral/inequality/solution_check.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <optional>
#include <utility>

namespace unilateral
{
  void stop_if_asked(const Progress &progress, const Processes &processes)
  {
    if (processes.any(progress.stop_requested()))
      throw Interrupted();
  }

  namespace
  {
    /// What the rules miss of the stiffness, relative to the estimate of the error, that a bound may leave out: it counts by its square.
    constexpr double negligible_detail = 1e-2;

    /// An energy norm of u beside the one of what the pressure does to single nodes, from which on u may be nothing but rounding.
    constexpr double negligible = 1e-6;

    /// What the energy norm of a solution without any energy may come out as. u less its prescribed values has an energy norm of its own,
    /// and what remains of it when these are added is known to no more digits than numbers have, or the solver gives. Where forces meet
    /// their reactions, u is rounding, which is small beside @p of_pressure, the same norm of what the pressure does to single nodes.
    double energy_norm_of_zero(const Certificate &certificate, const double tolerance, const double of_pressure)
    {
      constexpr double digits = 1e-12;
      const double     solver = certificate.available ? std::min(tolerance * certificate.energy_norm, certificate.penalty_error_bound) : 0.;
      const bool       may_be_all_error = certificate.available && certificate.penalty_error_bound >= 0.5 * certificate.energy_norm;
      return std::max({digits * certificate.energy_norm, solver, may_be_all_error ? negligible * of_pressure : 0.});
    }

    /// Bounds that u crosses, and data of which the points of cells show nothing.
    template <int dim>
    void add_what_points_do_not_show(Solution<dim> &solution, const Vector &u)
    {
      const auto  &problem = *solution.problem;
      auto        &result = solution.result;
      auto        &eta = result.discretisation_indicator;
      const auto  &adapt = problem.statement.mesh.adapt;
      const double norm = result.reference_norm(), relative_error = std::max(norm > 0 ? eta / norm : 0, adapt ? adapt->tolerance : 0);
      const auto   crossed = crossed_bounds(problem, solution.constraint_set, u, relative_error);
      const auto   unseen = unseen_details(problem, u, relative_error);
      eta = std::hypot(eta, add_crossed_bounds(problem, crossed, norm, solution.error_squares),
                       add_missed_loads(problem, unseen, norm, solution.error_squares));
      result.unseen_details = crossed.details;
      result.unseen_details.insert(result.unseen_details.end(), unseen.details.begin(), unseen.details.end());
      result.sees_all_data = !problem.space.processes().any(!result.unseen_details.empty());
      result.bounds_searched = !problem.space.processes().any(!crossed.certain);
    }

    /// The flux of u and, from it, how far the mesh is from resolving u.
    template <int dim>
    void estimate(Solution<dim> &solution, const double of_pressure)
    {
      const auto running = solution.problem->time_by_part.run("estimator");
      Vector     u(solution.displacement);
      solution.problem->space.dirichlet.distribute(u);
      solution.flux.emplace(*solution.problem, u);
      auto &eta = solution.result.discretisation_indicator;
      eta = discretisation_indicator(*solution.problem, u, *solution.flux, &solution.error_squares);
      if (solution.problem->form->order() > 1)
        eta = std::hypot(
          eta, add_interior_residuals(*solution.problem, solution.constraint_set, u, solution.contact_pressure, solution.error_squares),
          add_slope_jumps(*solution.problem, u, solution.error_squares));
      eta = std::hypot(
        eta, add_contact_between_nodes(*solution.problem, solution.constraint_set, solution.contact_pressure, solution.error_squares));
      auto &result = solution.result;
      result.unresolved_stiffness = add_unresolved_stiffness(*solution.problem, u, solution.error_squares);
      eta = std::hypot(
        std::hypot(eta, add_unresolved_springs(*solution.problem, u, solution.error_squares)), result.unresolved_stiffness,
        add_unresolved_reaction(*solution.problem, solution.constraint_set, u, solution.contact_pressure, solution.error_squares));
      result.energy_norm = energy_norm(*solution.problem, u);
      result.energy_norm_of_zero = energy_norm_of_zero(*result.certificate, solution.problem->statement.method.tolerance, of_pressure);
      add_what_points_do_not_show(solution, u);
    }

    /// How far load, contact and supports are from balance, relative to them: of bodies, where systems are solved by iteration. Up to
    /// @p enough it is that of the discrete problem, relative to contact alone.
    template <int dim>
    double imbalance_of_forces(const Solution<dim> &solution, const DiscreteProblem &discrete, const double enough)
    {
      const auto &problem = *solution.problem;
      if (problem.form->n_components() == 1 || discrete.solves_exactly())
        return 0;
      const auto &space = problem.space;
      const auto  modes = problem.form->rigid_body_modes(
         space.subdomain ? space.subdomain->some_point : dealii::Point<dim>(space.mesh.triangulation->begin_active()->center()));
      const double imbalance =
        imbalance_with_supports(discrete, modes_at_unknowns(problem, modes), solution.displacement, solution.contact_pressure);
      if (imbalance <= enough)
        return imbalance;
      Vector u(solution.displacement);
      problem.space.dirichlet.distribute(u);
      return force_balance(problem, solution.constraint_set, u, solution.contact_pressure).residual;
    }

    /// The solver stops by the norm of its preconditioner, which need not see everything. The certificate bounds the residual without it:
    /// where that is far above the tolerance asked for, or forces are not in balance, a smaller one is given to the solver.
    class SolverTolerance
    {
    public:
      explicit SolverTolerance(const double asked) : asked(asked), value(asked) {}
      operator double() const { return value; }

      double enough_balance() const { return 30 * asked; }

      void forget_state() { met.reset(); }

      /// Whether to solve again for the balance of forces alone, before there is a certificate.
      bool tighten_for_balance(const double imbalance, const Vector &u, const Vector &lambda, const MultiplierResult &outcome)
      {
        if (!outcome.converged || value <= 1e-3 * asked || imbalance <= enough_balance())
          return false;
        value *= 0.03;
        met = {u, lambda, outcome, std::nullopt, imbalance};
        return true;
      }

      /// Back to what met the tolerance that was asked for, if a smaller one was out of reach and has not brought forces nearer to balance.
      void give_up_balance(const double imbalance, Vector &u, Vector &lambda, MultiplierResult &outcome)
      {
        if (!outcome.converged && met && !met->certificate && !(imbalance < met->imbalance))
          go_back(u, lambda, outcome);
      }

      /// Whether to solve again. Otherwise @p outcome says what came of it.
      /// @p of_pressure: the energy norm of what the pressure does to single nodes, to which the tolerance refers where next to nothing
      /// deforms.
      bool tighten(Certificate &certificate, const double of_pressure, Vector &u, Vector &lambda, MultiplierResult &outcome)
      {
        const bool tightened = value < asked;
        if (!certificate.available || !(outcome.converged || tightened))
          return false;
        if (outcome.converged && value > 1e-4 * asked && residual_of(certificate) > 0.1 * largest_residual(certificate, of_pressure))
        {
          value *= 0.01;
          met = {u, lambda, outcome, certificate, 0};
          return true;
        }
        // Beyond what rounding lets it reach the solver may lose what it had.
        if (!outcome.converged && met && met->certificate && residual_of(*met->certificate) < residual_of(certificate))
        {
          go_back(u, lambda, outcome);
          certificate = *met->certificate;
        }
        // No rest with the smaller tolerance: what was asked for may have been reached.
        const double residual = residual_of(certificate), norm = certificate.energy_norm;
        outcome.converged = residual <= largest_residual(certificate, of_pressure);
        if (!outcome.converged)
          outcome.reason = fmt::format("the residual, bounded without the preconditioner, is {:.1e} of the energy norm", residual / norm);
        return false;
      }

    private:
      static double residual_of(const Certificate &certificate)
      {
        return std::max(0., certificate.algebraic_error - 4 * certificate.round_off);
      }

      double largest_residual(const Certificate &certificate, const double of_pressure) const
      {
        const bool next_to_nothing_deforms = certificate.energy_norm <= negligible * of_pressure;
        return asked * std::max(1000 * certificate.energy_norm, next_to_nothing_deforms ? of_pressure : 0.);
      }

      void go_back(Vector &u, Vector &lambda, MultiplierResult &outcome) const
      {
        u = met->u;
        lambda = met->lambda;
        outcome.converged = true;
        outcome.reason = met->outcome.reason;
        outcome.equilibrium = met->outcome.equilibrium;
        outcome.complementarity = met->outcome.complementarity;
      }

      struct Met
      {
        Vector                     u, lambda;
        MultiplierResult           outcome;
        std::optional<Certificate> certificate;   ///< none: the balance of forces alone was missing
        double                     imbalance = 0; ///< then
      };

      const double       asked;
      double             value;
      std::optional<Met> met; ///< the tolerance of before
    };

    /// How far u is from the solution of the continuous problem: by a bound where there is one, else by the estimate of the mesh's error
    /// and the bound of the rest.
    template <int dim>
    void bound_total_error(Solution<dim> &solution, const double epsilon, const double bound_below)
    {
      auto &[problem, K_h, displacement, lambda, flux, error_squares, result] = solution;
      if (problem->form->order() == 0)
        return;
      const auto          running = problem->time_by_part.run("total error");
      Vector              u(displacement);
      std::vector<Vector> pressures;
      problem->space.dirichlet.distribute(u);
      for (const ConstraintBlock &block : K_h.blocks)
        pressures.push_back(nodal_pressure(*problem, K_h, block, lambda));
      TotalError   total;
      const double norm = result.reference_norm();
      if (!result.sees_all_data)
        total.reason = "data vary within cells by what their points do not show";
      else if (!result.bounds_searched)
        total.reason = "a bound varies within cells by more than could be searched";
      else if (result.unresolved_stiffness > negligible_detail * result.discretisation_indicator)
        total.reason = "the stiffness varies within cells by more than their rules can follow";
      else if (norm == 0 ? bound_below != LevelRequest::never : result.discretisation_indicator <= bound_below * norm)
        total = total_error(*problem, u, pressures, *flux);
      else
        total.reason = "the bound is computed where it decides: near the tolerance, and for the last step of several";
      result.estimate = estimate_of(total, *result.certificate, result.discretisation_indicator, epsilon);
      if (total.available)
        error_squares = std::move(total.cell_squares);
    }

    /// Where a number is the goal of refinement: its error, and the cells that it comes from.
    template <int dim>
    void estimate_goal(Solution<dim> &solution, DiscreteProblem &discrete)
    {
      const auto &adapt = solution.problem->statement.mesh.adapt;
      if (!adapt || !adapt->goal.is_a_number())
        return;
      const auto running = solution.problem->time_by_part.run("goal");
      Vector     u(solution.displacement);
      solution.problem->space.dirichlet.distribute(u);
      auto goal = goal_error(*solution.problem, discrete, solution.constraint_set, u, solution.contact_pressure, *solution.flux,
                             solution.result.certificate->penalty_error_bound);
      solution.result.estimate->goal = goal.estimate;
      if (!goal.cell_squares.empty())
        solution.error_squares = std::move(goal.cell_squares);
    }
  } // namespace

  template <int dim>
  MultiplierResult solve_on_level(Solution<dim>                    &solution,
                                  std::unique_ptr<DiscreteProblem> &discrete,
                                  Discretisation<dim>              &discretisation,
                                  PenaltyParameter                 &penalty,
                                  StartingGuess                    &guess,
                                  const LevelRequest               &request,
                                  Stopwatch                        &watch,
                                  Progress                         &progress)
  {
    const auto      &problem = *solution.problem;
    const auto      &K_h = solution.constraint_set;
    auto            &result = solution.result;
    const double     shift = suitable_shift(K_h.at_nodes());
    SolverTolerance  tolerance(problem.statement.method.tolerance);
    MultiplierResult outcome;
    const bool       factorises = discrete->solves_exactly();
    const auto       predicted = guess.predicted_active;
    const Vector u_before(factorises ? solution.displacement : Vector()), lambda_before(factorises ? solution.contact_pressure : Vector());
    if (guess.predicted_active.empty())
    {
      const auto running = problem.time_by_part.run("solver");
      if (discrete->solve_for_pressure(penalty.epsilon(), solution.displacement, solution.contact_pressure))
        guess.predicted_active = positive(solution.contact_pressure);
    }
    while (true)
    {
      progress.phase("solve", fmt::format("level {}, {} unknowns", problem.space.level, problem.space.n_unknowns()));
      {
        const auto                 running = problem.time_by_part.run("solver");
        const MultiplierParameters parameters{.epsilon = penalty.epsilon(),
                                              .tolerance = tolerance,
                                              .shift = shift,
                                              .max_newton_steps = problem.statement.method.max_iterations,
                                              .data_round_off = data_round_off(problem, K_h, *discrete)};
        outcome +=
          method_of_multipliers(*discrete, parameters, guess.predicted_active, solution.displacement, solution.contact_pressure, progress);
      }
      result.timing.solve += watch.lap();
      guess.predicted_active = positive(solution.contact_pressure);
      if (discretisation.fall_back(problem, *discrete, outcome, progress))
      {
        discrete = discretisation.on_level(problem, K_h);
        const auto sum = [](const Vector &v) { return std::accumulate(v.begin(), v.end(), 0.); };
        if (problem.space.processes().any(!std::isfinite(sum(solution.displacement) + sum(solution.contact_pressure))))
        {
          solution.displacement = 0.;
          solution.contact_pressure = 0.;
          guess.predicted_active.clear();
        }
        // A factorisation without digits may have moved u far along modes that contact hardly stops.
        if (factorises)
        {
          guess.predicted_active = predicted;
          solution.displacement = u_before;
          solution.contact_pressure = lambda_before;
        }
        continue;
      }
      if (!request.finest)
        return outcome;

      progress.phase("certify");
      const double imbalance = imbalance_of_forces(solution, *discrete, tolerance.enough_balance());
      if (tolerance.tighten_for_balance(imbalance, solution.displacement, solution.contact_pressure, outcome))
      {
        result.timing.certify += watch.lap();
        continue;
      }
      tolerance.give_up_balance(imbalance, solution.displacement, solution.contact_pressure, outcome);
      {
        const auto running = problem.time_by_part.run("certificate");
        result.certificate = certify(*discrete, penalty.epsilon(), shift, solution.displacement, solution.contact_pressure, progress);
      }
      stop_if_asked(progress, problem.space.processes());
      const double of_pressure =
        complementarity_residual(*discrete, penalty.epsilon(), solution.displacement, solution.contact_pressure).lambda_norm;
      const bool again = tolerance.tighten(*result.certificate, of_pressure, solution.displacement, solution.contact_pressure, outcome);
      guess.predicted_active = positive(solution.contact_pressure);
      if (again)
      {
        result.timing.certify += watch.lap();
        continue;
      }
      estimate(solution, of_pressure);
      stop_if_asked(progress, problem.space.processes());
      const bool accepted = penalty.accept(*result.certificate, result.discretisation_indicator);
      if (accepted || !outcome.converged)
      {
        progress.phase("estimate");
        bound_total_error(solution, penalty.epsilon(), request.bound_below);
        estimate_goal(solution, *discrete);
        result.timing.certify += watch.lap();
        return outcome;
      }
      tolerance.forget_state(); // it is that of another epsilon
      result.timing.certify += watch.lap();
    }
  }

#define INSTANTIATE(dim)                                                                                                                   \
  template MultiplierResult solve_on_level(Solution<dim> &, std::unique_ptr<DiscreteProblem> &, Discretisation<dim> &, PenaltyParameter &, \
                                           StartingGuess &, const LevelRequest &, Stopwatch &, Progress &);
  INSTANTIATE(1)
  INSTANTIATE(2)
  INSTANTIATE(3)
#undef INSTANTIATE
} // namespace unilateral
