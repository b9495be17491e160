// Rigid motions of a body in words.
#pragma once

#include "unilateral/forms/bilinear_form.h"

#include <Eigen/Core>

#include <string>
#include <vector>

namespace unilateral
{
  /// Of a combination of modes. Of a body's what it does to it, v(x) = t + w x (X - c): "translation along -y" where t is by far the larger
  /// part, else "rotation about z through (1, 0, 0)", with the axis on which v is along w, "with a translation along it" where v is not
  /// zero there. Of modes of plates and membranes the names of the parts: "rotation about x with translation".
  template <int dim>
  std::string motion_name(const Eigen::VectorXd &coefficients, const std::vector<RigidBodyMode<dim>> &modes);

  /// Of all motions that the columns span, in words that do not depend on the basis: translations first, then rotations; those about all
  /// axes through a point as one, "rotation about any axis through (0, 0, 1)".
  template <int dim>
  std::vector<std::string> motion_names(const Eigen::MatrixXd &coefficients, const std::vector<RigidBodyMode<dim>> &modes);
} // namespace unilateral
