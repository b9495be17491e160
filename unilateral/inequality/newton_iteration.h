// The state of Newton's method for the augmented problem, and the steps it can take.
#pragma once

#include "unilateral/inequality/rigid_body_step.h"

#include <vector>

namespace unilateral
{
  /// What Newton's method knows at a point u: everything is updated along a step, nothing is evaluated twice.
  class NewtonIteration
  {
  public:
    NewtonIteration(const AugmentedProblem &augmented, Vector &u, Vector &Au);

    /// residual = f - A u - B' W (g on @p set) / (eps + R); with the true active set that is minus the gradient of the energy.
    void evaluate_residual(const PointSet &set);

    /// Solves the tangent problem on @p set for the next direction, with supports where the set does not stop every rigid body mode. An
    /// inexact solution is combined with the direction of the step before to what is best on that set: while the active set changes
    /// little, steps are those of conjugate gradients.
    LinearSolve solve_for_direction(const PointSet &set, const SolveTolerance &tolerance);

    /// To the minimum of the energy along the direction.
    double energy_step_length();

    /// Halves the step until the residual falls (in the norm of the inverse diagonal of A); 2^-10 when it never does.
    double residual_step_length();

    /// Returns how many points changed sides.
    std::size_t move(double t);

    bool has_rigid_body_modes() const { return rigid_body.has_modes(); }

    /// To the minimum of the energy along the direction and all rigid body modes at once. Returns the number of points that changed sides,
    /// and in @p t how far along the direction.
    std::size_t move_with_rigid_body_modes(double &t);

    /// Moves u along the rigid body modes to where forces and moments balance; see RigidBodyStep.
    void balance_rigid_body_modes();

    /// Together with springs these points stop every rigid body mode.
    bool stops_rigid_body_modes(const PointSet &set) const { return rigid_body.all_stopped_by(set); }

    /// Where a step ends on another active set the boundary of that is not where it belongs: see relax_near_free_boundary().
    void relax();

    /// The energy curves upward and falls along Newton's direction, unless a is not coercive.
    bool shows_lack_of_coercivity() const;

    /// What rounding leaves of the residual of an exact solution, in the norm of diag(A)^-1; the energy norm of smooth parts of it is
    /// larger, hence a factor.
    double round_off();

    std::size_t n_active() const;

    /// The length of Newton's direction in the norm of the energy.
    double decrement() const;

    PointSet active;

  private:
    void          find_active();
    void          evaluate_pressure(Vector &pressure, const PointSet &set) const;
    bool          combine_with_last_direction(const Vector &A_solution, const Vector &gap_of_solution);
    const Vector &counted(const Vector &q);
    double        scaled_residual_norm(double t);

    const AugmentedProblem &augmented;
    DiscreteProblem        &problem;
    Vector                 &u, &Au;
    Vector                  residual, solution, direction, A_direction;
    Vector                  gap, gap_change, stiffness_of_penalty;
    Vector                  penalty; ///< w_i / (eps + r_i): stiffness of an active point
    Vector                  only_counted;
    Vector                  dof_work, point_work; ///< belong to the function that runs; few, since memory is dear to touch
    std::size_t             n_points = 0;
    bool                    has_direction = false;
    double                  curvature = 0, descent = 0; ///< direction' A direction, direction' residual
    RigidBodyStep           rigid_body;
  };
} // namespace unilateral
