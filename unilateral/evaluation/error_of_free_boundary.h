// What is not known of a goal because contact ends between points.
#pragma once

#include "unilateral/algebra/vector.h"
#include "unilateral/constraints/constraint_set.h"
#include "unilateral/discretisation/problem.h"
#include "unilateral/inequality/discrete_problem.h"

#include <vector>

namespace unilateral
{
  /// Where contact ends nobody knows: it may reach up to the next points. By active cell what the goal may change by then, pressure
  /// times weight times |g - (B z)_i| of the points without pressure in cells that have others, with the mean pressure of those. Or
  /// contact may end before the last of its points i, as it does where that has less pressure than the others in its cell, (1 - q) times
  /// theirs: in one dimension at q/2 of the cell from i, with B z falling from there as it does beyond i, which changes the goal by
  /// their pressure times q^2 times half of the weight, the fall of B z over half of the cell. Collective.
  template <int dim>
  std::vector<double> error_of_free_boundary(const Problem<dim>       &problem,
                                             const DiscreteProblem    &discrete,
                                             const ConstraintSet<dim> &K_h,
                                             const Vector             &lambda,
                                             const Vector             &Bz,
                                             double                    g);
} // namespace unilateral
