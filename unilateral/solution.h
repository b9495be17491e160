// A solved problem in memory.
#pragma once

#include "unilateral/constraints/constraint_set.h"
#include "unilateral/discretisation/problem.h"
#include "unilateral/evaluation/estimator.h"
#include "unilateral/evaluation/run_result.h"
#include "unilateral/inequality/discrete_problem.h"

#include <memory>
#include <optional>
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
} // namespace unilateral
