// The minimum of the energy along the few modes that supports leave free, rigid body modes or the constant.
#pragma once

#include "unilateral/inequality/augmented_problem.h"

#include <Eigen/Core>

#include <vector>

namespace unilateral
{
  /// Which points take part: quicker than bits.
  using PointSet = std::vector<unsigned char>;

  /// The energy of an augmented problem restricted to u + span R, R the k <= 6 columns of DiscreteProblem::rigid_body_modes():
  ///     E(z) = 1/2 (u + R z)'A(u + R z) - f'(u + R z) + 1/2 sum_i c_i ((g + B R z)_i^+)^2,   c_i = w_i / (eps + r_i), g the shifted gap at
  ///     u.
  /// Its minimum is found exactly, by Newton's method in k variables with exact line search: from any distance it brings a body into
  /// contact, and at it the residual of u does no work on R, so that forces and moments balance mode by mode whatever a linear solver has
  /// left. The cost is that of a few passes over the points.
  ///
  /// Points of an active set that do not stop every mode leave a singular tangent A + B'DB. With the residual in balance, as many further
  /// points as there are modes left, chosen so that they stop these, may serve as supports: they are statically determinate, carry nothing
  /// of such a residual, and the solution is one of the singular system (supports()).
  ///
  /// For symmetric a; without modes nothing happens.
  class RigidBodyStep
  {
  public:
    /// Keeps references to both. @p penalty: c, N entries > 0.
    RigidBodyStep(const AugmentedProblem &augmented, const Vector &penalty);

    bool has_modes() const { return basis.cols() > 0; }

    /// A direction p besides the modes.
    struct Direction
    {
      const Vector &p, &Ap, &Bp;
      double        slope, curvature; ///< p'(A u - f) and p'A p
    };

    /// Moves u to the minimum along the modes and, where given, @p besides at once, and A u and the shifted gap B u - s + R lambda with it.
    /// Returns how far along that direction. Nothing moves where there is no minimum.
    ///
    /// Newton's direction is determined but for the modes that its active set does not stop: with these as they happen to come, a line
    /// search stops at the first point that they drive into the obstacle, and to minimise in turn takes hundreds of steps.
    double minimise(Vector &u, Vector &Au, Vector &gap, const Direction *besides = nullptr) const;

    /// The points of @p set of all processes, and springs, stop every mode.
    bool all_stopped_by(const PointSet &set) const { return modes_not_stopped_by(set).cols() == 0; }

    /// Points outside @p set that stop the modes that neither it nor springs stop; none when every mode is stopped. Of several processes
    /// each is given those that it has.
    std::vector<std::size_t> supports(const PointSet &set) const;

  private:
    /// In coordinates along R Y, column by column.
    Eigen::MatrixXd modes_not_stopped_by(const PointSet &set) const;

    /// sum_i c_i t_i t_i' over the points of @p set, t_i row i of @p columns.
    Eigen::MatrixXd contact_stiffness(const std::vector<Vector> &columns, const PointSet &set) const;

    /// sum_i c_i g_i t_i over the active points, c the given @p stiffness.
    Eigen::VectorXd
    contact_gradient(const std::vector<Vector> &columns, const Vector &stiffness, const Vector &gap, const PointSet &active) const;

    struct ReducedEnergy;

    /// In coordinates y along R Y.
    ReducedEnergy energy_along_modes(const Vector &u) const;

    /// One more coordinate, along p - R Y alpha. False where that vanishes or is not finite.
    bool add_direction(ReducedEnergy &energy, const Direction &besides) const;

    /// The y of the least energy, by Newton's method. @p gap: the shifted gap at y = 0.
    Eigen::VectorXd minimum_of(const ReducedEnergy &energy, const Vector &gap) const;

    const AugmentedProblem &augmented;
    const DiscreteProblem  &problem;
    const Vector           &penalty;
    std::vector<Vector>     A_modes; ///< A R; none where A vanishes on all modes
    Eigen::MatrixXd         basis;   ///< Y, k x m: with all points in contact the stiffness of R Y is the identity
    Eigen::MatrixXd         springs; ///< Y'R'A R Y, m x m
    std::vector<Vector>     traces;  ///< columns of B R Y
  };
} // namespace unilateral
