// The main path: mesh -> V_h -> K_h -> solve, level by level.
#pragma once

#include "unilateral/base/progress.h"
#include "unilateral/discretisation/problem.h"
#include "unilateral/evaluation/estimator.h"
#include "unilateral/evaluation/run_result.h"
#include "unilateral/inequality/discrete_problem.h"

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace unilateral
{
  /// What a run leaves in memory: the problem on the finest level, the solution on it, and the numbers of results.json.
  template <int dim>
  struct Solution
  {
    std::unique_ptr<Problem<dim>>     problem;
    ConstraintSet<dim>                constraint_set;
    Vector                            displacement;     ///< u, with its Dirichlet values
    Vector                            contact_pressure; ///< lambda at the constraint points
    std::optional<RecoveredFlux<dim>> flux;             ///< of a body: the stress of u
    std::vector<double>               error_squares;    ///< by active cell: its part of the square of the estimated error
    RunResult                         result;           ///< all but timing.output and expect
  };

  /// Solves the problem on each refinement level in turn, each from the one before (nested iteration).
  /// Non-convergence is a result (`result.converged`, `result.reason`).
  /// Where @p processes are several, all of them call this together, and once a mesh is fine enough each has a part of it: the solution is
  /// that on the part, the numbers are those of the whole. A problem that is not worth sharing, or cannot be shared
  /// (FunctionSpace::subdomain is empty then), is solved by each of them. Throws InputError (names that the mesh does not have, data that
  /// violate the obstacle, ...) and Interrupted.
  template <int dim>
  Solution<dim> solve(const ProblemStatement &statement, Diagnostics &diagnostics, Progress &progress, const Processes &processes = {});

  /// The same; @p on_cycle gets the solution on each mesh of adaptive refinement but the last, with its flux and the numbers that were
  /// computed on the way: all but those that describe_outcome() adds.
  template <int dim>
  Solution<dim> solve(const ProblemStatement                           &statement,
                      Diagnostics                                      &diagnostics,
                      Progress                                         &progress,
                      const Processes                                  &processes,
                      const std::function<void(const Solution<dim> &)> &on_cycle);
} // namespace unilateral
