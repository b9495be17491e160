// Does anything hold the solution as a whole? Rigid body modes, constants of a membrane.
#pragma once

#include "unilateral/constraints/constraint_set.h"
#include "unilateral/inequality/discrete_problem.h"
#include "unilateral/spaces/dirichlet_conditions.h"

#include <Eigen/Core>

#include <string>
#include <vector>

namespace unilateral
{
  template <int dim>
  class Problem;

  /// BilinearForm::rigid_body_modes about the middle of the mesh, scaled to a largest displacement of 1.
  template <int dim>
  std::vector<RigidBodyMode<dim>> rigid_body_modes(const Problem<dim> &problem);

  /// A mode, linear in x, as a function of V_h; prescribed values are not looked at.
  template <int dim>
  Vector interpolate(const Problem<dim> &problem, const RigidBodyMode<dim> &mode);

  /// Several, zero where values are prescribed.
  template <int dim>
  std::vector<Vector> modes_at_unknowns(const Problem<dim> &problem, const std::vector<RigidBodyMode<dim>> &modes);

  /// The functions r of BilinearForm::rigid_body_modes that [boundary] and the coefficients leave free: r = 0 where values are prescribed
  /// and a(r, r) = 0, which springs and a term (c u, v) prevent. Columns: coefficients of an orthonormal basis in terms of the modes, each
  /// scaled to a largest displacement of 1.
  template <int dim>
  Eigen::MatrixXd free_modes(const Problem<dim> &problem);

  /// The same, springs and a term (c u, v) not looked at: what prescribed values leave free.
  template <int dim>
  Eigen::MatrixXd unsupported_modes(const Problem<dim> &problem);

  /// The modes with such coefficients, column by column, as functions of position.
  template <int dim>
  std::vector<RigidBodyMode<dim>> combined_modes(const Problem<dim> &problem, const Eigen::MatrixXd &coefficients);

  /// What contact and the load make of them.
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

  /// As many values at vertices of the boundary as there are indifferent modes, chosen so that prescribing zero there stops each of
  /// them: the load does no work on these modes, so that no force acts at the pins.
  template <int dim>
  std::vector<Pin<dim>> pins_against(const Problem<dim> &problem, const Eigen::MatrixXd &indifferent);
} // namespace unilateral
