#include "unilateral/case/solve_history.h"

#include "unilateral/base/stopwatch.h"
#include "unilateral/case/case_results.h"
#include "unilateral/case/load_steps.h"
#include "unilateral/case/problem_of_case.h"
#include "unilateral/case/write_case.h"
#include "unilateral/discretisation/problem.h"
#include "unilateral/solution_functions.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace unilateral
{
  namespace
  {
    using HistoryJson = nlohmann::ordered_json;

    InputError in_step(const InputError &e, const std::size_t k)
    {
      std::vector<Diagnostic> named = e.diagnostics;
      for (Diagnostic &diagnostic : named)
        diagnostic.message = fmt::format("in step {}: {}", k + 1, diagnostic.message);
      return InputError(std::move(named));
    }
  } // namespace

  template <int dim>
  HistoryJson solve_history(const Case &request, LoadStepping<dim> &stepping, const OnStep<dim> &on_step, const StepsBefore &before)
  {
    HistoryJson steps = before.steps;
    StepFields  fields;
    fields.has_steps = true;
    fields.previous = before.previous;
    const bool needs_functions = uses_step_before(request);
    for (std::size_t k = before.n(); k < request.steps.size(); ++k)
      try
      {
        Stopwatch              watch;
        const Case             single = case_of_step(request, k);
        Diagnostics            diagnostics;
        const ProblemStatement statement = problem_of(single, diagnostics, fields);
        diagnostics.throw_if_errors();
        const bool     planned_last = k + 1 == request.steps.size();
        Solution<dim> &solution = stepping.solve(statement, diagnostics, /*bound_error=*/planned_last);
        const bool     last = planned_last || !solution.result.converged;
        if (auto &estimate = solution.result.estimate; needs_functions && k > 0 && estimate && estimate->guaranteed)
        {
          estimate->guaranteed = false;
          estimate->reason = "the solution of the step before, with an error of its own, is taken as exact";
        }
        std::shared_ptr<const CellFunctions> functions;
        if (needs_functions && !last)
        {
          fields.previous = functions = functions_of(solution);
          // On adapted meshes parts change.
          if (const auto &space = solution.problem->space; statement.mesh.adapt && space.subdomain)
            fields.previous = together(*functions, space.processes());
        }
        const double seconds = watch.lap();
        steps.push_back(step_json(solution.result, request, k, seconds));
        if (on_step)
          on_step({k, last, single, solution, diagnostics, seconds, functions}, steps);
        if (last)
          break;
      }
      catch (const InputError &e)
      {
        throw in_step(e, k);
      }
    return steps;
  }

  template <int dim>
  void check_history(const Case &request, Diagnostics &diagnostics)
  {
    if (uses_step_before(request))
      return;
    StepFields fields;
    fields.has_steps = true;
    std::unique_ptr<Problem<dim>> problem;
    for (std::size_t k = 0; k < request.steps.size(); ++k)
      try
      {
        Diagnostics            of_step;
        const ProblemStatement statement = problem_of(case_of_step(request, k), of_step, fields);
        of_step.throw_if_errors();
        if (problem)
          problem->restate(statement, of_step);
        else
          problem = std::make_unique<Problem<dim>>(statement, of_step);
        of_step.throw_if_errors();
        problem->make_constraint_set();
        for (const Diagnostic &warning : of_step.all())
          if (std::none_of(diagnostics.all().begin(), diagnostics.all().end(),
                           [&](const Diagnostic &known)
                           { return known.message == warning.message && known.where.line == warning.where.line; }))
            diagnostics.warning(warning.where, warning.message, warning.name);
      }
      catch (const InputError &e)
      {
        throw in_step(e, k);
      }
  }

#define INSTANTIATE(dim)                                                                                                                   \
  template HistoryJson solve_history(const Case &, LoadStepping<dim> &, const OnStep<dim> &, const StepsBefore &);                         \
  template void        check_history<dim>(const Case &, Diagnostics &);
  INSTANTIATE(1)
  INSTANTIATE(2)
  INSTANTIATE(3)
#undef INSTANTIATE
} // namespace unilateral
