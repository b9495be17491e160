// Constants of inequalities on triangles and convex quadrilaterals.
#pragma once

#include <deal.II/base/point.h>

#include <vector>

namespace unilateral
{
  /// C with inf over rigid body modes r of ||w - r|| <= C_0 ||eps(w)|| and ||grad (w - r)|| <= C_1 ||eps(w)|| for the same r, in L2 of a
  /// convex polygon of diameter h: C_1 = (1 + 2/beta^2)^(1/2), C_0 = h C_1/pi. r makes the means of w - r and of its rotation a vanish.
  /// |grad w|^2 = |eps|^2 + 2 a^2, the gradient of a consists of derivatives of eps, so that its norm in H^-1 is at most ||eps||, and ||a||
  /// <= ||grad a||_-1 / beta with the inf-sup constant beta of the divergence. In a ball of radius R and star-shaped with respect to a
  /// concentric one of radius rho,
  ///     beta >= rho/(2^(1/2) R) (1 + (1 - rho^2/R^2)^(1/2))^(-1/2).
  /// References: M. Costabel, M. Dauge, Arch. Ration. Mech. Anal. 217 (2015) 873-898, theorem 2.3; C. O. Horgan, L. E. Payne, Arch. Ration.
  /// Mech. Anal. 82 (1983) 165-179; L. E. Payne, H. F. Weinberger, Arch. Ration. Mech. Anal. 5 (1960) 286-292 and M. Bebendorf (2003) for
  /// ||w|| by
  /// ||grad w||.
  struct KornConstant
  {
    double of_value = 0, of_gradient = 0, diameter = 0;
  };

  /// @p ring: the corners, one after the other.
  KornConstant korn_constant(const std::vector<dealii::Point<2>> &ring);
} // namespace unilateral
