// What one step of the method of multipliers minimises.
#pragma once

#include "unilateral/inequality/discrete_problem.h"

#include <vector>

namespace unilateral
{
  /// The convex, C1, piecewise quadratic problem  min_v J(v) + 1/2 | (Bv - s + R lambda)^+ |^2  in the norm W (eps + R)^-1,
  /// J(v) = 1/2 v'Av - f'v, R = diag(shift) >= 0. Its optimality condition, which also makes sense when A is not symmetric:
  ///     A u + B' W lambda_next(u) = f,   lambda_next(u) = (Bu - s + R lambda)^+ / (eps + R).
  /// With shift 0 it is the penalty method (7); eps + shift > 0 is required at every point.
  struct AugmentedProblem
  {
    DiscreteProblem &problem;
    double           epsilon;
    Vector           shift;      ///< diagonal of R, N entries
    Vector           multiplier; ///< lambda, N entries

    /// Bu - s + R lambda: a point is active where this is positive.
    void shifted_gap(Vector &g, const Vector &u) const;

    /// c_i = w_i / (eps + r_i): the stiffness of an active point.
    Vector penalty() const;

    /// lambda_next(u).
    void next_multiplier(Vector &next, const Vector &u) const;
  };

  /// Where q > 0: the active set of a multiplier.
  std::vector<bool> positive(const Vector &q);
} // namespace unilateral
