#include "unilateral/solve.h"

#include "unilateral/adaptive_loop.h"
#include "unilateral/base/stopwatch.h"
#include "unilateral/discretisation/dear_functions.h"
#include "unilateral/evaluation/describe_outcome.h"
#include "unilateral/evaluation/probes.h"
#include "unilateral/evaluation/result_warnings.h"
#include "unilateral/first_problem.h"
#include "unilateral/guess_of_former_run.h"
#include "unilateral/inequality/augmented_problem.h"
#include "unilateral/inequality/solution_check.h"
#include "unilateral/level_solve.h"
#include "unilateral/stability/theorem3_bound.h"
#include "unilateral/start_by_degree_1.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace unilateral
{
  namespace
  {
    template <int dim>
    void add_warnings(Solution<dim> &solution, Diagnostics &diagnostics)
    {
      warn_about_fine_rasters(*solution.problem, diagnostics);
      warn_about_side_conditions(solution.result, solution.problem->statement, diagnostics);
      for (const Diagnostic &diagnostic : diagnostics.all())
        if (diagnostic.severity == Severity::warning)
          solution.result.warnings.push_back(diagnostic);
    }

    /// Of the method, all that a PenaltyParameter depends on.
    bool same_penalty(const Method &a, const Method &b)
    {
      return a.formulation == b.formulation && a.epsilon == b.epsilon && a.penalty_tolerance == b.penalty_tolerance &&
             a.tolerance == b.tolerance;
    }
  } // namespace

  template <int dim>
  LoadStepping<dim>::LoadStepping(Progress &progress, const Processes &processes, Watcher on_cycle, Watcher on_level)
    : progress(progress), processes(processes), on_cycle(std::move(on_cycle)), on_level(std::move(on_level))
  {
  }

  /// The coarse mesh, and all that lives as long as the levels made from it.
  template <int dim>
  void LoadStepping<dim>::start(const ProblemStatement &statement, Diagnostics &diagnostics)
  {
    progress.phase("mesh");
    discrete.reset();
    discretisation.reset();
    auto first = make_first_problem<dim>(statement, processes, diagnostics, progress);
    current.problem = std::move(first.problem);
    discretisation = std::move(first.discretisation);
    coarse_faces = std::move(first.coarse_faces);
    guess = {};
    discretisation->share_coarse_mesh(*current.problem, processes, progress);
    penalty.emplace(statement.method, statement.constrains_boundary());
    progress.log("linear solver: " + discretisation->reason());
    reason_at_first = discretisation->reason();
  }

  /// Other data on the mesh as it is. False: it takes another start().
  template <int dim>
  bool LoadStepping<dim>::go_on(const ProblemStatement &statement, Diagnostics &diagnostics)
  {
    auto &[problem, K_h, u, lambda, flux, error_squares, result] = current;
    if (!why_not_this_mesh.empty())
    {
      progress.log(why_not_this_mesh + ": this step begins with the coarse mesh");
      return false;
    }
    progress.phase("setup", "on the mesh of the step before");
    if (!same_penalty(problem->statement.method, statement.method))
      penalty.emplace(statement.method, statement.constrains_boundary());
    guess = guess_from(*problem, K_h, u, lambda);
    const auto unchanged = problem->restate(statement, diagnostics);
    prepare_dear_functions(*problem);
    auto       other_set = problem->make_constraint_set();
    const bool same_points = !problem->space.processes().any(!have_same_points(K_h, other_set));
    K_h = std::move(other_set);
    if (!discretisation->restate(*problem, K_h, unchanged, discrete))
    {
      progress.log("the matrices of all levels change: this step begins with the coarse mesh");
      return false;
    }
    penalty->start_level(*discrete);
    const Vector pressure_before(lambda);
    start_from(guess, *discrete, *problem, K_h, u, lambda);
    if (same_points)
    {
      lambda = pressure_before;
      guess.predicted_active = positive(lambda);
    }
    if (zero_is_a_better_guess(*discrete, u))
      start_from_zero();
    // An empty active set would leave the modes free that contact has to stop.
    if (problem->semicoercive() && discrete->largest(lambda) == 0)
      guess.predicted_active.clear();
    return true;
  }

  template <int dim>
  void LoadStepping<dim>::start_from_zero()
  {
    current.displacement = 0.;
    current.contact_pressure = 0.;
    guess.predicted_active.clear();
  }

  /// Between two steps of division, see Subdomain.
  template <int dim>
  bool LoadStepping<dim>::several_have_each_part() const
  {
    const auto &subdomain = current.problem->space.subdomain;
    return subdomain && subdomain->n_alike > 1;
  }

  /// On whether to stop: all of those that have to agree.
  template <int dim>
  const Processes &LoadStepping<dim>::deciding_processes() const
  {
    return several_have_each_part() ? processes : current.problem->space.processes();
  }

  template <int dim>
  void LoadStepping<dim>::set_up_level(const bool finest)
  {
    const auto &problem = *current.problem;
    progress.phase("setup", fmt::format("level {}", problem.space.level));
    if (finest)
      check_probes(problem);
    prepare_dear_functions(problem);
    current.constraint_set = problem.make_constraint_set();
    stop_if_asked(progress, deciding_processes());
    discrete.reset(); // that of the level before, which takes memory
    discrete = discretisation->on_level(problem, current.constraint_set);
    if (finest && discretisation->reason() != reason_at_first)
      progress.log("linear solver: " + discretisation->reason());
    if (finest)
      discretisation->say_if_not_shared(problem, processes, progress);
    stop_if_asked(progress, deciding_processes());
    penalty->start_level(*discrete);
    if (former && former->level == problem.space.level)
      guess = guess_of(*std::exchange(former, {}), problem, current.constraint_set.blocks.size());
    else if (!former && guess.functions.empty() && !discrete->solves_exactly())
      guess = start_by_degree_1(problem, progress);
    start_from(guess, *discrete, problem, current.constraint_set, current.displacement, current.contact_pressure);
    // Else what remains of a contact that this mesh does not see falls to rounding, which meets no relative tolerance.
    if (discrete->largest(discrete->load()) == 0 && zero_is_a_better_guess(*discrete, current.displacement))
      start_from_zero();
    has_functions_of_mesh = true;
  }

  /// The next mesh, and the functions of the guess on it.
  template <int dim>
  void LoadStepping<dim>::refine(const RefinementByError *const by_error)
  {
    has_functions_of_mesh = false;
    discretisation->refine(*current.problem, guess.functions, processes, progress, by_error);
  }

  /// The next mesh in place of a solution on this one.
  template <int dim>
  void LoadStepping<dim>::refine_until_held(const bool finest)
  {
    auto       &problem = *current.problem;
    const auto &adapt = problem.statement.mesh.adapt;
    if (finest && (!adapt || problem.space.n_unknowns() * std::pow(2., dim) > adapt->max_unknowns))
      throw InputError(problem.statement.model.where, problem.why_not_held(), MessageName("rigid-motion-free"));
    progress.log("nothing is solved on this mesh: " + problem.why_not_held());
    if (discrete->largest(current.contact_pressure) > 0) // elements of degree 1, whose points are the vertices, have a solution
      guess = guess_from(problem, current.constraint_set, current.displacement, current.contact_pressure);
    else
      guess = {};
    refine();
  }

  template <int dim>
  Solution<dim> &LoadStepping<dim>::solve(const ProblemStatement &statement, Diagnostics &diagnostics, const bool bound_error)
  {
    Stopwatch watch, all;
    auto     &result = current.result;
    auto     &K_h = current.constraint_set;
    auto     &u = current.displacement;
    auto     &lambda = current.contact_pressure;
    RunResult before = std::exchange(result, {});
    result.timing = std::move(before.timing);

    bool       ready = current.problem && go_on(statement, diagnostics);
    const bool began_with_coarse_mesh = !ready;
    if (ready)
      result.timing.setup += watch.lap();
    else
    {
      start(statement, diagnostics);
      result.timing.mesh += watch.lap();
    }
    auto        &problem = *current.problem;
    WithoutStops without_stops(progress);
    AdaptiveLoop adaptive(statement.mesh.adapt);
    const bool   with_bounds = bound_error || statement.mesh.adapt;

    for (unsigned level = problem.space.level;; ++level)
    {
      const bool   refined = level >= statement.mesh.n_refinements();
      const bool   follows = refined && adaptive.follows_former_mesh(problem);
      const bool   finest = refined && !follows;
      const double seconds_before = result.timing.setup + result.timing.solve + result.timing.certify;

      if (!std::exchange(ready, false))
      {
        set_up_level(finest);
        adaptive.starts_from(u);
      }
      if (level == statement.mesh.n_refinements())
        n_cells_unrefined = problem.space.n_cells();
      const std::size_t applications_before = discrete->n_operator_applications();
      result.timing.setup += watch.lap();

      if (former || !problem.why_not_held().empty())
      {
        former ? refine() : refine_until_held(finest);
        result.timing.mesh += watch.lap();
        continue;
      }
      const auto outcome =
        solve_on_level(current, discrete, *discretisation, *penalty, guess,
                       {.finest = finest, .bound_below = with_bounds ? adaptive.bound_below(problem) : LevelRequest::never}, watch,
                       several_have_each_part() ? without_stops : progress);
      problem.space.dirichlet.distribute(u);
      const double seconds = result.timing.setup + result.timing.solve + result.timing.certify - seconds_before;
      result.levels.push_back(level_report(level, problem, *discrete, outcome, lambda, seconds));
      result.levels.back().operator_applications -= std::min(applications_before, result.levels.back().operator_applications);
      progress.level_finished(result.levels.back());
      if (finest && adaptive.ends(current, outcome.converged, progress))
      {
        result.solver_reason = discretisation->reason();
        why_not_this_mesh = adaptive.obstacle_to_mesh(problem, current.error_squares, n_cells_unrefined, began_with_coarse_mesh);
        progress.phase("norms");
        if (bound_error)
          add_theorem3_bound(*result.certificate, problem, K_h, penalty->epsilon());
        else
          result.certificate->theorem3_reason = "it is computed for the last step alone";
        describe_outcome(result, problem, K_h, *discrete, *penalty, outcome, u, lambda, *current.flux);
        warn_about_result(result, problem, K_h, *coarse_faces, u, lambda, diagnostics);
        break;
      }
      stop_if_asked(progress, deciding_processes());
      if (finest && on_cycle)
        on_cycle(current);
      if (!refined && on_level && !several_have_each_part())
        on_level(current);
      guess = guess_from(problem, K_h, u, lambda);
      const auto by_error = refined ? adaptive.next_mesh(problem, current.error_squares, processes) : RefinementByError();
      refine(refined ? &by_error : nullptr);
      result.timing.mesh += watch.lap();
    }
    if (!statement.elastic())
      current.flux.reset();
    add_warnings(current, diagnostics);
    result.timing.total += all.lap();
    return current;
  }

  template <int dim>
  Solution<dim> solve(const ProblemStatement                           &statement,
                      Diagnostics                                      &diagnostics,
                      Progress                                         &progress,
                      const Processes                                  &processes,
                      const std::function<void(const Solution<dim> &)> &on_cycle)
  {
    return std::move(LoadStepping<dim>(progress, processes, on_cycle).solve(statement, diagnostics));
  }

  template <int dim>
  Solution<dim> solve(const ProblemStatement &statement, Diagnostics &diagnostics, Progress &progress, const Processes &processes)
  {
    return solve<dim>(statement, diagnostics, progress, processes, nullptr);
  }

#define INSTANTIATE(dim)                                                                                                                   \
  template class LoadStepping<dim>;                                                                                                        \
  template Solution<dim> solve(const ProblemStatement &, Diagnostics &, Progress &, const Processes &);                                    \
  template Solution<dim> solve(const ProblemStatement &, Diagnostics &, Progress &, const Processes &,                                     \
                               const std::function<void(const Solution<dim> &)> &);
  INSTANTIATE(1)
  INSTANTIATE(2)
  INSTANTIATE(3)
#undef INSTANTIATE
} // namespace unilateral
