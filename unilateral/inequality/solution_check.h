// What speaks against a solution, judged by what the solver did not use.
#pragma once

#include "unilateral/inequality/discrete_problem.h"

#include <string>
#include <vector>

namespace unilateral
{
  /// The largest work of f - A u - B'W lambda on a rigid body mode that supports leave free (largest displacement 1), relative to the sum
  /// of the sizes of the nodal forces of the load or of the contact, whichever is larger; 0 without such modes. It depends on no linear
  /// solver and on no internal force: where springs act on such modes, less what rounding leaves of internal forces in A u.
  double imbalance_of_rigid_body_modes(const DiscreteProblem &problem, const Vector &u, const Vector &lambda);

  /// The largest work of f - A u - B'W lambda on one of the @p modes, with zeros at unknowns that supports hold, relative to its largest
  /// entry and to the sum of the sizes of the contact forces at nodes, infinite without contact; f contains what prescribed values do to
  /// a stiff body, which is no measure: how far the reactions of the supports, which are all that the solver leaves out, are from balancing
  /// load and contact.
  double imbalance_with_supports(const DiscreteProblem &problem, const std::vector<Vector> &modes, const Vector &u, const Vector &lambda);

  /// v = 0 keeps the bounds, and J(u) > J(0): after a step to no load, or next to none, a solver that starts from u would find what is left
  /// of it by cancellation, zero but for rounding.
  bool zero_is_a_better_guess(const DiscreteProblem &problem, const Vector &u);

  /// Why (u, lambda) is no solution of the penalty problem (epsilon > 0) or the mixed one, whatever its residual: forces out of balance by
  /// more than @p tolerance of the load, or an energy above that of v = 0 where v = 0 is in K_h. For the solution of (7) and (21) alike,
  ///     J(u) + epsilon/2 lambda'W lambda <= J(v)  for all v in K_h,   J(v) = 1/2 v'Av - f'v.
  /// Empty when nothing speaks against it.
  std::string
  objection_to_solution(const DiscreteProblem &problem, double epsilon, double tolerance, const Vector &u, const Vector &lambda);
} // namespace unilateral
