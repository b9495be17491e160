// Semismooth Newton with exact line search for one step of the method of multipliers.
#pragma once

#include "unilateral/base/progress.h"
#include "unilateral/inequality/augmented_problem.h"

#include <string>
#include <vector>

namespace unilateral
{
  struct NewtonParameters
  {
    double   tolerance = 0;          ///< on the residual in the energy norm (LinearSolve::residual), absolute
    double   relative_tolerance = 0; ///< the same relative to the first step, whichever is larger
    double   forcing = 1e-5;         ///< relative accuracy of linear solves while the active set still changes,
    unsigned enough_iterations = 2;  ///< or so many steps of an iterative solver: more would be lost when the set changes
    unsigned max_steps = 200;        ///< then it is called not converged,
    unsigned steps_before = 0;       ///< these, of earlier problems, included
  };

  struct NewtonResult
  {
    bool                    converged = false;
    bool                    out_of_steps = false; ///< not converged, and nothing else is the matter
    bool                    at_round_off = false; ///< the residual cannot fall any more: it is what rounding makes of zero
    std::string             reason;               ///< why it stopped, for people
    unsigned                linear_iterations = 0;
    std::size_t             flipped = 0;  ///< points that changed sides, summed over the steps
    double                  residual = 0; ///< of the last linear solve, in the energy norm
    std::vector<NewtonStep> history;
  };

  /// Improves u until the active set rests and the residual is below the tolerance, or cannot fall any more: that counts as converged
  /// where the residual is round-off, else not.
  ///
  /// Symmetric a: every step goes to the minimum of the energy along the Newton direction, which cannot cycle and always converged
  /// where the plain active-set iteration cycles (rules with a kernel, small eps). With an iterative solver a step is a few of conjugate
  /// gradients, its direction conjugate to the one before, with the active set and the preconditioner up to date. Where it ends on another
  /// active set, relax_near_free_boundary() follows, which lets points change sides one by one where the line search has to stop at the
  /// first. Non-symmetric a: full steps (policy iteration) until an active set returns, then damping on the residual.
  ///
  /// @p predicted_active, when not empty (N entries): the first step takes this active set for granted and moves there undamped.
  /// A singular tangent or an energy without a minimum is a reason to stop, not an exception. Throws Interrupted.
  NewtonResult semismooth_newton(const AugmentedProblem  &augmented,
                                 const NewtonParameters  &parameters,
                                 const std::vector<bool> &predicted_active,
                                 Vector                  &u,
                                 Progress                &progress);

  /// The same for who has @p Au and needs that of the result.
  NewtonResult semismooth_newton(const AugmentedProblem  &augmented,
                                 const NewtonParameters  &parameters,
                                 const std::vector<bool> &predicted_active,
                                 Vector                  &u,
                                 Vector                  &Au,
                                 Progress                &progress);
} // namespace unilateral
