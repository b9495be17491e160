// Digits of the contact pressure that rounding took, restored from the balance of forces.
#pragma once

#include "unilateral/inequality/discrete_problem.h"

namespace unilateral
{
  /// A multiplier lambda = (Bu - s + R lambda) / (eps + R) carries the last digit of Bu - s magnified by 1/(eps + R), and where only
  /// contact holds a body, its balance with the load shows it: for the modes z_k of the null space, z_k'(f - B'W lambda) = 0 in exact
  /// arithmetic. Scales the pressure by 1 + sum_k y_k B z_k, with y such that these sums vanish, which is the change least in
  ///     sum_i w_i (delta lambda_i)^2 / lambda_i,
  /// and which leaves open points open. Modes that contact does not stop stay as they are. Nothing is done where a pressure would change
  /// by more than the fraction @p largest_change, which is no rounding, or where the balance would not get better.
  /// Returns the largest relative change made.
  double restore_balance(const DiscreteProblem &problem, double largest_change, const Vector &u, Vector &lambda);

  /// How much of the pressure that last digit may be, in the mean over the contact and relative to the pressure; 1e-3 at most, since more
  /// is no rounding that may be passed over. R = @p shift. It is large where an obstacle has moved a body far, for its strains.
  double round_off_of_pressure(const DiscreteProblem &problem, double epsilon, const Vector &shift, const Vector &u, const Vector &lambda);
} // namespace unilateral
