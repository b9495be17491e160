// The energy norm of a residual.
#pragma once

#include "unilateral/inequality/support_points.h"

#include <Eigen/Core>

#include <vector>

namespace unilateral
{
  /// The energy norm of a residual, (r'A^-1 r)^1/2, for symmetric A.
  ///
  /// Where A vanishes on modes R of a body that only contact holds, A^-1 r means any x with A x = r, and there is one if r'R = 0. As
  /// many contact points as there are modes, chosen so that they stop each of them, serve as supports: they are statically
  /// determinate, so that they carry nothing of an r in balance, and x solves A x = r all the same. The multiplier at these points is
  /// changed by what brings r into balance.
  class ResidualNorm
  {
  public:
    /// Keeps a reference to the problem. @p shift: of the stiffness of supports, in units of the local compliance. @p lambda: the contact
    /// among which supports are chosen.
    ResidualNorm(DiscreteProblem &problem, double shift, const Vector &lambda);

    /// Contact stops every mode.
    bool exists() const { return n_modes == 0 || available; }

    /// Changes lambda at the supports, and r = A u + B'W lambda - f with it, so that r'R = 0. False where lambda would become negative.
    bool balance(Vector &lambda, Vector &r) const;

    /// Rounded up by what the linear solve leaves open. False where that did not converge.
    bool operator()(const Vector &r, double &norm);

  private:
    void choose_supports(double shift, const Vector &lambda);

    DiscreteProblem          &problem;
    std::size_t               n_modes;
    std::vector<Vector>       traces; ///< B r for each mode
    std::vector<SupportPoint> supports;
    Eigen::MatrixXd           work_of_supports; ///< column i: of a unit pressure at support i on each mode
    Vector                    support_stiffness;
    bool                      available = false;
  };
} // namespace unilateral
