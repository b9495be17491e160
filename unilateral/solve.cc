#include "unilateral/solve.h"

#include "unilateral/augmented_problem.h"
#include "unilateral/certificate.h"
#include "unilateral/data_round_off.h"
#include "unilateral/discretisation.h"
#include "unilateral/estimator.h"
#include "unilateral/faceted_surface.h"
#include "unilateral/memory_need.h"
#include "unilateral/method_of_multipliers.h"
#include "unilateral/nested_iteration.h"
#include "unilateral/outcome.h"
#include "unilateral/penalty_parameter.h"
#include "unilateral/point_location.h"
#include "unilateral/result_warnings.h"
#include "unilateral/stopwatch.h"
#include "unilateral/theorem3.h"

#include <fmt/format.h>

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
      const auto running = solution.problem->part_times.run("estimator");
      Vector     u(solution.displacement);
      solution.problem->dirichlet.distribute(u);
      solution.flux.emplace(*solution.problem, u);
      solution.result.discretisation_indicator = discretisation_indicator(*solution.problem, u, *solution.flux);
      solution.result.energy_norm = energy_norm_of_flux(*solution.problem, u);
    }
  } // namespace

  template <int dim>
  Solution<dim> solve(const Case &request, Diagnostics &diagnostics, Progress &progress, const Processes &processes)
  {
    Stopwatch     watch;
    Solution<dim> solution;
    auto         &u = solution.displacement;
    auto         &lambda = solution.contact_pressure;
    auto         &result = solution.result;

    progress.phase("mesh");
    check_memory(request, known_coarse_cells(request));
    solution.problem = std::make_unique<Problem<dim>>(request, diagnostics);
    auto &problem = *solution.problem;
    check_memory(request, problem.growth_in_places() * problem.mesh.triangulation->n_active_cells());
    const FacetedSurface<dim> coarse_faces(problem);
    Discretisation<dim>       discretisation(problem);
    PenaltyParameter          penalty(request.method, request.constrains_boundary());
    StartingGuess             guess;
    progress.log("linear solver: " + discretisation.reason());
    result.timing.mesh = watch.lap();

    for (unsigned level = 0;; ++level)
    {
      const bool finest = level == request.mesh.n_refinements();

      if (finest)
        check_probes(problem);
      stop_if_asked(progress, problem.processes());
      progress.phase("setup", fmt::format("level {}", level));
      auto &K_h = solution.constraint_set = problem.make_constraint_set();
      stop_if_asked(progress, problem.processes());
      auto discrete = discretisation.on_level(problem, K_h);
      stop_if_asked(progress, problem.processes());
      penalty.start_level(*discrete);
      start_from(guess, *discrete, problem, K_h, u, lambda);
      const double shift = suitable_shift(K_h.at_nodes());
      const double setup_time = watch.lap();

      MultiplierResult outcome;
      double           solve_time = 0, certify_time = 0;
      for (bool accepted = false; !accepted;)
      {
        progress.phase("solve", fmt::format("level {}, {} unknowns", level, problem.n_unknowns()));
        const MultiplierParameters parameters{.epsilon = penalty.epsilon(),
                                              .tolerance = request.method.tolerance,
                                              .shift = shift,
                                              .max_newton_steps = request.method.max_iterations,
                                              .data_round_off = data_round_off(problem, K_h, *discrete)};
        {
          const auto running = problem.part_times.run("solver");
          outcome += method_of_multipliers(*discrete, parameters, guess.predicted_active, u, lambda, progress);
        }
        solve_time += watch.lap();
        guess.predicted_active = positive(lambda);
        if (discretisation.fall_back(problem, *discrete, outcome, progress))
        {
          discrete = discretisation.on_level(problem, K_h);
          continue;
        }

        accepted = !finest;
        if (finest)
        {
          progress.phase("certify");
          {
            const auto running = problem.part_times.run("certificate");
            result.certificate = certify(*discrete, penalty.epsilon(), shift, u, lambda, progress);
          }
          stop_if_asked(progress, problem.processes());
          estimate(solution);
          stop_if_asked(progress, problem.processes());
          accepted = penalty.accept(*result.certificate, result.discretisation_indicator) || !outcome.converged;
          certify_time += watch.lap();
        }
      }
      problem.dirichlet.distribute(u);

      result.timing.setup += setup_time;
      result.timing.solve += solve_time;
      result.timing.certify += certify_time;
      result.levels.push_back(level_report(level, problem, *discrete, outcome, lambda, setup_time + solve_time + certify_time));
      progress.level_finished(result.levels.back());
      if (finest)
      {
        result.solver_reason = discretisation.reason();
        add_theorem3_bound(*result.certificate, problem, K_h, penalty.epsilon());
        describe_outcome(result, problem, K_h, *discrete, penalty, outcome, u, lambda, *solution.flux);
        stop_if_asked(progress, problem.processes());
        warn_about_result(result, problem, K_h, coarse_faces, u, lambda, diagnostics);
        if (!request.elastic())
          solution.flux.reset();
        break;
      }
      stop_if_asked(progress, problem.processes());
      guess = guess_from(problem, K_h, u, lambda);
      discretisation.share_work(problem, guess.functions, processes, progress);
      problem.refine(guess.functions, /*smoothly=*/true);
      result.timing.mesh += watch.lap();
    }
    warn_about_fine_rasters(problem, diagnostics);
    warn_about_side_conditions(result, request, diagnostics);
    for (const Diagnostic &diagnostic : diagnostics.all())
      if (diagnostic.severity == Severity::warning)
        result.warnings.push_back(diagnostic);
    result.timing.total = result.timing.mesh + result.timing.setup + result.timing.solve + result.timing.certify + watch.lap();
    return solution;
  }

#define INSTANTIATE(dim) template Solution<dim> solve(const Case &, Diagnostics &, Progress &, const Processes &);
  INSTANTIATE(1)
  INSTANTIATE(2)
  INSTANTIATE(3)
#undef INSTANTIATE
} // namespace unilateral
