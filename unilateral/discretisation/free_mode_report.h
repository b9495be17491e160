// Do contact and the load hold what supports leave free?
#pragma once

#include "unilateral/constraints/constraint_set.h"

#include <Eigen/Core>

#include <string>

namespace unilateral
{
  template <int dim>
  class Problem;

  /// What contact and the load make of the modes that supports leave free.
  struct FreeModeReport
  {
    /// Why there is no solution: a mode r that no obstacle stops, Br <= 0, and the load drives, f(r) > 0; or a load without a resultant
    /// that presses the body anywhere, unless contact stops it whichever way it goes. Empty when there is one.
    std::string error;
    /// The load presses only just: a small change of it would lift or tip the body.
    std::string warning;
    /// Modes that contact does not feel, Br = 0, and the load does not drive: the solution is unique but for them. Coefficients as in
    /// free_modes().
    Eigen::MatrixXd indifferent;
  };

  /// By linear programming in the few free rigid body modes: f must lie in the cone of the contact forces, which non-negative least squares
  /// decide, and its residual is the mode that escapes. @p free: from free_modes(), not empty.
  template <int dim>
  FreeModeReport judge_free_modes(const Problem<dim> &problem, const ConstraintSet<dim> &constraint_set, const Eigen::MatrixXd &free);
} // namespace unilateral
