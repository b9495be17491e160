// A finished solve in the numbers of results.json.
#pragma once

#include "unilateral/discretisation/problem.h"
#include "unilateral/evaluation/estimator.h"
#include "unilateral/evaluation/run_result.h"
#include "unilateral/inequality/discrete_problem.h"
#include "unilateral/inequality/method_of_multipliers.h"
#include "unilateral/inequality/penalty_parameter.h"

#include <vector>

namespace unilateral
{
  /// A row of the progress table.
  template <int dim>
  LevelReport level_report(unsigned                level,
                           const Problem<dim>     &problem,
                           const DiscreteProblem  &discrete,
                           const MultiplierResult &outcome,
                           const Vector           &lambda,
                           double                  seconds);

  /// Force, pressure, penetration of each side of each constraint; @p u has its Dirichlet values.
  template <int dim>
  std::vector<ConstraintResult> constraint_results(
    const Problem<dim> &problem, const ConstraintSet<dim> &constraint_set, double epsilon, const Vector &u, const Vector &lambda);

  /// Everything about the finest level, and the sums over the levels that @p result already lists. @p flux: of u.
  template <int dim>
  void describe_outcome(RunResult                &result,
                        const Problem<dim>       &problem,
                        const ConstraintSet<dim> &constraint_set,
                        const DiscreteProblem    &discrete,
                        const PenaltyParameter   &penalty,
                        const MultiplierResult   &outcome,
                        const Vector             &u,
                        const Vector             &lambda,
                        const RecoveredFlux<dim> &flux);

  /// Says where load or contact act on a mode that was taken for free and therefore stopped by a side condition: the condition bears a
  /// force.
  void warn_about_side_conditions(const RunResult &result, const ProblemStatement &statement, Diagnostics &diagnostics);
} // namespace unilateral
