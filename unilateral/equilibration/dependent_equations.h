// Which of the equations of composite stresses follow from others.
#pragma once

#include "unilateral/equilibration/composite_stresses.h"

#include <Eigen/Core>

namespace unilateral
{
  /// The columns n with n' E = 0, E the matrix of CompositeStresses::equations(): one for each rigid body mode, since the tractions on a
  /// cell are in balance with its divergence; and on quadrilaterals one for the shear at the crossing of the diagonals. Of the four half
  /// diagonals the tractions across any three being continuous, this shear is continuous across the last one as well.
  Eigen::MatrixXd dependent_equations(const CompositeStresses<2> &stresses);
} // namespace unilateral
