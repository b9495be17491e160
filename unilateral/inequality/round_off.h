// What rounding leaves open where numbers nearly cancel.
#pragma once

#include "unilateral/inequality/discrete_problem.h"

namespace unilateral
{
  /// A residual of the size and kind that rounding can hide in r = A u + B'W lambda - f: entry j is eps times the terms that cancel
  /// there, the sum of |a_jk u_k|, (B'W lambda)_j and |f_j|, eps = 2^-53. How large the terms of A u are is seen from A applied to u with
  /// random signs (the mean of four times twice the root of the sum of their squares). The signs of the entries are equal if @p alike, as
  /// on a uniform mesh where u is constant, and random otherwise. Its norm (r'A^-1 r)^1/2 is how far u may be from what a zero residual
  /// says.
  Vector residual_round_off(const DiscreteProblem &problem, const Vector &u, const Vector &lambda, bool alike);

  /// The norm of such a residual in diag(A)^-1, cheap and too small where it is smooth: for who only has to know that it does not matter.
  /// @p Au: A u.
  double smallest_round_off(const DiscreteProblem &problem, const Vector &u, const Vector &Au, const Vector &lambda);

  /// What rounding of the entries of A leaves of the energy norm of d, (k eps |d|'|A||d|)^1/2: next to a rigid body motion, which A takes
  /// to zero but for that, it decides. |A| is taken for twice the diagonal, k for 8.
  double energy_round_off(const DiscreteProblem &problem, const Vector &d);

  /// How far the solution may move in the energy norm when the bounds s are known up to rounding.
  ///
  /// A function v that keeps B v <= s but for @p excess keeps it for bounds that differ by as much, s'. If B e = s' - s, the sets of both
  /// are shifts of each other, and their solutions differ by ||u' - u||_a <= 2 ||e||_a. The cheapest e moves nodes one by one, which takes
  /// (s'_i - s_i)^2 w_i / tau_i each at the points that decide, tau the local compliance; moving neighbours against each other
  /// takes a few times that, 4 here. @p decides: the points that are in contact or next to it.
  double bound_round_off(const DiscreteProblem &problem, const std::vector<bool> &decides, double excess);
} // namespace unilateral
