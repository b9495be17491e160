// Each level starts from the solution on the one before: O(1) instead of O(1/h) Newton steps.
#pragma once

#include "unilateral/discretisation/problem.h"
#include "unilateral/inequality/discrete_problem.h"

#include <vector>

namespace unilateral
{
  /// The coarser solution, in the end as functions of the finer V_h.
  struct StartingGuess
  {
    std::vector<Vector> functions;        ///< u, then nodal_pressure() per constraint block; empty on the first level
    std::vector<bool>   predicted_active; ///< set by start_from(): see semismooth_newton()
  };

  /// u and the nodal pressures, on the level they were found on: Problem::refine() carries them to the next.
  template <int dim>
  StartingGuess guess_from(const Problem<dim> &problem, const ConstraintSet<dim> &constraint_set, const Vector &u, const Vector &lambda);

  /// Bounds act at the same points, in the same order, be they other bounds.
  template <int dim>
  bool have_same_points(const ConstraintSet<dim> &a, const ConstraintSet<dim> &b);

  /// Sets u (zero where Dirichlet data fix it) and lambda on the new level, for which it uses up the functions, and predicts the active
  /// set: at a rule of nodes where the interpolated pressure and lambda + (B u - s) / tau are positive, tau the local compliance, at others
  /// where the pressure is half of what it is nearby. On the first level both are zero; there, if only contact holds the solution, every
  /// point is predicted active.
  template <int dim>
  void start_from(StartingGuess            &guess,
                  const DiscreteProblem    &discrete,
                  const Problem<dim>       &problem,
                  const ConstraintSet<dim> &constraint_set,
                  Vector                   &u,
                  Vector                   &lambda);
} // namespace unilateral
