// Rigid body modes, constants of a membrane: which of them supports leave free.
#pragma once

#include "unilateral/constraints/constraint_set.h"
#include "unilateral/forms/bilinear_form.h"
#include "unilateral/inequality/discrete_problem.h"
#include "unilateral/spaces/dirichlet_conditions.h"

#include <Eigen/Core>

#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace unilateral
{
  template <int dim>
  class Problem;

  /// BilinearForm::rigid_body_modes about the middle of the mesh, scaled to a largest displacement of 1.
  template <int dim>
  std::vector<RigidBodyMode<dim>> rigid_body_modes(const Problem<dim> &problem);

  /// Modes, linear in x, as functions of V_h; prescribed values are not looked at.
  template <int dim>
  std::vector<Vector> interpolate(const Problem<dim> &problem, const std::vector<RigidBodyMode<dim>> &modes);

  /// The same, zero where values are prescribed.
  template <int dim>
  std::vector<Vector> modes_at_unknowns(const Problem<dim> &problem, const std::vector<RigidBodyMode<dim>> &modes);

  /// The modes as functions of V_h, prescribed values not looked at: n x k.
  template <int dim>
  Eigen::MatrixXd mode_matrix(const Problem<dim> &problem, const std::vector<RigidBodyMode<dim>> &modes);

  /// r_k' K r_l of the springs, f(r_k), and the sum of the sizes of what adds up to it.
  struct WorkOnModes
  {
    Eigen::MatrixXd springs;
    Eigen::VectorXd load, load_size;
  };

  /// @p modes: from mode_matrix().
  template <int dim>
  WorkOnModes work_on_modes(const Problem<dim> &problem, const Eigen::MatrixXd &modes);

  /// The functions r of BilinearForm::rigid_body_modes that [boundary] and the coefficients leave free: r = 0 where values are prescribed
  /// and a(r, r) = 0, which springs and a term (c u, v) prevent. Columns: coefficients of an orthonormal basis in terms of the modes, each
  /// scaled to a largest displacement of 1.
  template <int dim>
  Eigen::MatrixXd free_modes(const Problem<dim> &problem);

  /// Of functions whose values at the unknowns are the columns of @p at: an orthonormal basis of the combinations that [boundary] and
  /// springs leave free.
  template <int dim>
  Eigen::MatrixXd free_combinations(const Problem<dim> &problem, const Eigen::MatrixXd &at);

  /// The free modes, springs and a term (c u, v) not looked at: what prescribed values leave free.
  template <int dim>
  Eigen::MatrixXd unsupported_modes(const Problem<dim> &problem);

  /// Of the motions that springs alone hold the one that they hold least, by so little beside the stiffness of the cells that rounding may
  /// hide it: its name, and that share. Nothing where there is none, or for forms of order 4.
  template <int dim>
  std::optional<std::pair<std::string, double>> motion_held_by_weak_springs(const Problem<dim> &problem);

  /// Column i: what a unit pressure at point i does on the modes whose values at the unknowns are the columns of @p at.
  template <int dim>
  Eigen::MatrixXd contact_on_modes(const ConstraintSet<dim> &set, const Eigen::MatrixXd &at);

  /// Contact does not feel a mode, its largest displacement 1, where the mean square of this work over the points is smaller.
  constexpr double not_felt = 1e-7;

  /// The modes with such coefficients, column by column, as functions of position.
  template <int dim>
  std::vector<RigidBodyMode<dim>> combined_modes(const Problem<dim> &problem, const Eigen::MatrixXd &coefficients);

  /// As many values at vertices of the boundary as there are indifferent modes, chosen so that prescribing zero there stops each of
  /// them: the load does no work on these modes, so that no force acts at the pins.
  template <int dim>
  std::vector<Pin<dim>> pins_against(const Problem<dim> &problem, const Eigen::MatrixXd &indifferent);
} // namespace unilateral
