#include "unilateral/solve.h"

#include "unilateral/adaptive_loop.h"
#include "unilateral/base/stopwatch.h"
#include "unilateral/discretisation/dear_functions.h"
#include "unilateral/discretisation/memory_estimate.h"
#include "unilateral/discretisation/solver_choice.h"
#include "unilateral/equilibration/total_error.h"
#include "unilateral/evaluation/data_round_off.h"
#include "unilateral/evaluation/describe_outcome.h"
#include "unilateral/evaluation/estimator.h"
#include "unilateral/evaluation/faceted_surface.h"
#include "unilateral/evaluation/functionals.h"
#include "unilateral/evaluation/goal_error.h"
#include "unilateral/evaluation/interior_residual.h"
#include "unilateral/evaluation/probes.h"
#include "unilateral/evaluation/result_warnings.h"
#include "unilateral/inequality/augmented_problem.h"
#include "unilateral/inequality/certificate.h"
#include "unilateral/inequality/method_of_multipliers.h"
#include "unilateral/inequality/penalty_parameter.h"
#include "unilateral/nested_iteration.h"
#include "unilateral/stability/theorem3_bound.h"

#include <fmt/format.h>

#include <cmath>

namespace unilateral
{
  namespace
  {
    /// Between parts that may take seconds each on a large mesh. Throws Interrupted, on all processes or none.
    void stop_if_asked(const Progress &progress, const Processes &processes)
    {
      if (processes.any(progress.stop_requested()))
        throw Interrupted();
    }

    /// The flux of u and, from it, how far the mesh is from resolving u.
    template <int dim>
    void estimate(Solution<dim> &solution)
    {
      const auto running = solution.problem->time_by_part.run("estimator");
      Vector     u(solution.displacement);
      solution.problem->space.dirichlet.distribute(u);
      solution.flux.emplace(*solution.problem, u);
      auto &eta = solution.result.discretisation_indicator;
      eta = discretisation_indicator(*solution.problem, u, *solution.flux, &solution.error_squares);
      if (solution.problem->form->order() > 1)
        eta = std::hypot(
          eta, add_interior_residuals(*solution.problem, solution.constraint_set, u, solution.contact_pressure, solution.error_squares));
      solution.result.energy_norm = energy_norm_of_flux(*solution.problem, u);
    }

    /// How far u is from the solution of the continuous problem: by a bound where there is one, else by the estimate of the mesh's error
    /// and the bound of the rest.
    template <int dim>
    void bound_total_error(Solution<dim> &solution, const double epsilon)
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
      auto total = total_error(*problem, u, pressures, *flux);
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

    /// u and lambda on a level, in place of the guess for them. On the finest level this is repeated with smaller epsilon until the
    /// certificate says that the penalty does no harm. Where an iterative solver fails, @p discrete gets a direct one.
    template <int dim>
    MultiplierResult solve_on_level(Solution<dim>                    &solution,
                                    std::unique_ptr<DiscreteProblem> &discrete,
                                    Discretisation<dim>              &discretisation,
                                    PenaltyParameter                 &penalty,
                                    StartingGuess                    &guess,
                                    const bool                        finest,
                                    Stopwatch                        &watch,
                                    Progress                         &progress)
    {
      const auto      &problem = *solution.problem;
      const auto      &K_h = solution.constraint_set;
      auto            &result = solution.result;
      const double     shift = suitable_shift(K_h.at_nodes());
      MultiplierResult outcome;
      while (true)
      {
        progress.phase("solve", fmt::format("level {}, {} unknowns", problem.space.level, problem.space.n_unknowns()));
        {
          const auto                 running = problem.time_by_part.run("solver");
          const MultiplierParameters parameters{.epsilon = penalty.epsilon(),
                                                .tolerance = problem.statement.method.tolerance,
                                                .shift = shift,
                                                .max_newton_steps = problem.statement.method.max_iterations,
                                                .data_round_off = data_round_off(problem, K_h, *discrete)};
          outcome += method_of_multipliers(*discrete, parameters, guess.predicted_active, solution.displacement, solution.contact_pressure,
                                           progress);
        }
        result.timing.solve += watch.lap();
        guess.predicted_active = positive(solution.contact_pressure);
        if (discretisation.fall_back(problem, *discrete, outcome, progress))
        {
          discrete = discretisation.on_level(problem, K_h);
          continue;
        }
        if (!finest)
          return outcome;

        progress.phase("certify");
        {
          const auto running = problem.time_by_part.run("certificate");
          result.certificate = certify(*discrete, penalty.epsilon(), shift, solution.displacement, solution.contact_pressure, progress);
        }
        stop_if_asked(progress, problem.space.processes());
        estimate(solution);
        stop_if_asked(progress, problem.space.processes());
        const bool accepted = penalty.accept(*result.certificate, result.discretisation_indicator);
        if (accepted || !outcome.converged)
        {
          progress.phase("estimate");
          bound_total_error(solution, penalty.epsilon());
          estimate_goal(solution, *discrete);
          result.timing.certify += watch.lap();
          return outcome;
        }
        result.timing.certify += watch.lap();
      }
    }

    template <int dim>
    void add_warnings(Solution<dim> &solution, Diagnostics &diagnostics)
    {
      warn_about_fine_rasters(*solution.problem, diagnostics);
      warn_about_side_conditions(solution.result, solution.problem->statement, diagnostics);
      for (const Diagnostic &diagnostic : diagnostics.all())
        if (diagnostic.severity == Severity::warning)
          solution.result.warnings.push_back(diagnostic);
    }
  } // namespace

  template <int dim>
  Solution<dim> solve(const ProblemStatement                           &statement,
                      Diagnostics                                      &diagnostics,
                      Progress                                         &progress,
                      const Processes                                  &processes,
                      const std::function<void(const Solution<dim> &)> &on_cycle)
  {
    Stopwatch     watch;
    Solution<dim> solution;
    auto         &u = solution.displacement;
    auto         &lambda = solution.contact_pressure;
    auto         &result = solution.result;

    progress.phase("mesh");
    check_memory(statement, dim, known_coarse_cells(statement, dim));
    solution.problem = std::make_unique<Problem<dim>>(statement, diagnostics);
    auto &problem = *solution.problem;
    check_functionals(problem);
    check_goal(problem);
    check_memory(statement, dim, problem.growth_in_places() * problem.space.mesh.triangulation->n_active_cells());
    const FacetedSurface<dim> coarse_faces(problem);
    Discretisation<dim>       discretisation(problem);
    PenaltyParameter          penalty(statement.method, statement.constrains_boundary());
    StartingGuess             guess;
    AdaptiveLoop              adaptive(statement.mesh.adapt);
    progress.log("linear solver: " + discretisation.reason());
    const std::string reason_at_first = discretisation.reason();
    result.timing.mesh = watch.lap();

    for (unsigned level = 0;; ++level)
    {
      const bool   finest = level >= statement.mesh.n_refinements();
      const double before = result.timing.setup + result.timing.solve + result.timing.certify;

      progress.phase("setup", fmt::format("level {}", level));
      if (finest)
        check_probes(problem);
      prepare_dear_functions(problem);
      auto &K_h = solution.constraint_set = problem.make_constraint_set();
      stop_if_asked(progress, problem.space.processes());
      auto discrete = discretisation.on_level(problem, K_h);
      if (finest && discretisation.reason() != reason_at_first)
        progress.log("linear solver: " + discretisation.reason());
      stop_if_asked(progress, problem.space.processes());
      penalty.start_level(*discrete);
      start_from(guess, *discrete, problem, K_h, u, lambda);
      result.timing.setup += watch.lap();

      const auto outcome = solve_on_level(solution, discrete, discretisation, penalty, guess, finest, watch, progress);
      problem.space.dirichlet.distribute(u);
      const double seconds = result.timing.setup + result.timing.solve + result.timing.certify - before;
      result.levels.push_back(level_report(level, problem, *discrete, outcome, lambda, seconds));
      progress.level_finished(result.levels.back());
      if (finest && adaptive.ends(problem, solution.error_squares, outcome.converged, result, progress))
      {
        result.solver_reason = discretisation.reason();
        progress.phase("norms");
        add_theorem3_bound(*result.certificate, problem, K_h, penalty.epsilon());
        describe_outcome(result, problem, K_h, *discrete, penalty, outcome, u, lambda, *solution.flux);
        warn_about_result(result, problem, K_h, coarse_faces, u, lambda, diagnostics);
        break;
      }
      stop_if_asked(progress, problem.space.processes());
      if (finest && on_cycle)
        on_cycle(solution);
      guess = guess_from(problem, K_h, u, lambda);
      discretisation.refine(problem, guess.functions, processes, progress, finest ? &adaptive.chosen_cells() : nullptr);
      result.timing.mesh += watch.lap();
    }
    if (!statement.elastic())
      solution.flux.reset();
    add_warnings(solution, diagnostics);
    result.timing.total = result.timing.mesh + result.timing.setup + result.timing.solve + result.timing.certify + watch.lap();
    return solution;
  }

  template <int dim>
  Solution<dim> solve(const ProblemStatement &statement, Diagnostics &diagnostics, Progress &progress, const Processes &processes)
  {
    return solve<dim>(statement, diagnostics, progress, processes, nullptr);
  }

#define INSTANTIATE(dim)                                                                                                                   \
  template Solution<dim> solve(const ProblemStatement &, Diagnostics &, Progress &, const Processes &);                                    \
  template Solution<dim> solve(const ProblemStatement &, Diagnostics &, Progress &, const Processes &,                                     \
                               const std::function<void(const Solution<dim> &)> &);
  INSTANTIATE(1)
  INSTANTIATE(2)
  INSTANTIATE(3)
#undef INSTANTIATE
} // namespace unilateral
