// u and the contact pressure on one level, and on the finest one all that says how good they are.
#pragma once

#include "unilateral/base/processes.h"
#include "unilateral/base/progress.h"
#include "unilateral/base/stopwatch.h"
#include "unilateral/discretisation/solver_choice.h"
#include "unilateral/inequality/method_of_multipliers.h"
#include "unilateral/inequality/penalty_parameter.h"
#include "unilateral/nested_iteration.h"
#include "unilateral/solution.h"

#include <limits>
#include <memory>

namespace unilateral
{
  struct LevelRequest
  {
    static constexpr double always = std::numeric_limits<double>::infinity(), never = -always;

    bool   finest = true; ///< with certificate and estimate
    double bound_below =
      always; ///< the total error is bounded where the estimate of the mesh's, relative to the energy norm, is at most this
  };

  /// Between parts that may take seconds each on a large mesh. Throws Interrupted, on all @p processes or none.
  void stop_if_asked(const Progress &progress, const Processes &processes);

  /// u and lambda on a level, in place of the guess for them. On the finest level this is repeated with smaller epsilon until the
  /// certificate says that the penalty does no harm. Where an iterative solver fails, @p discrete gets a direct one.
  template <int dim>
  MultiplierResult solve_on_level(Solution<dim>                    &solution,
                                  std::unique_ptr<DiscreteProblem> &discrete,
                                  Discretisation<dim>              &discretisation,
                                  PenaltyParameter                 &penalty,
                                  StartingGuess                    &guess,
                                  const LevelRequest               &request,
                                  Stopwatch                        &watch,
                                  Progress                         &progress);
} // namespace unilateral
