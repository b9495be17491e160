// Energy and forces of a discrete solution: what acts on it, and whether it balances.
#pragma once

#include "unilateral/constraints/constraint_set.h"
#include "unilateral/discretisation/problem.h"
#include "unilateral/evaluation/run_result.h"
#include "unilateral/inequality/discrete_problem.h"

#include <vector>

namespace unilateral
{
  /// J(u) = 1/2 a(u, u) - f(u), springs and boundary loads included; @p u with its prescribed values.
  template <int dim>
  double energy(const Problem<dim> &problem, const Vector &u);

  /// What acts on an elastic body. @p lambda at the points of @p constraint_set. The reactions are what is missing in A u + B'W lambda = f
  /// at the nodes that supports hold, so that their sum balances the rest as well as the free nodes are in equilibrium.
  template <int dim>
  ForceBalance force_balance(const Problem<dim> &problem, const ConstraintSet<dim> &constraint_set, const Vector &u, const Vector &lambda);

  /// What the supports of a beam or plate bear: the forces and, for Hermite elements in 1-D, moments that are missing in A u + B'W lambda =
  /// f at the unknowns that they prescribe, by part and then by support inside. The force on
  /// the structure, in the direction of u; the moment is EI u'' at an end, the jump of EI u'' at a support inside.
  template <int dim>
  std::vector<SupportReaction>
  support_reactions(const Problem<dim> &problem, const ConstraintSet<dim> &constraint_set, const Vector &u, const Vector &lambda);

  /// The force of an obstacle on the body, - sum_i w_i lambda_i n_i, and its moment about the origin (2-D: 1 number, 3-D: 3; none where
  /// axisymmetric).
  struct ContactForce
  {
    std::vector<double> force, moment;
  };
  template <int dim>
  ContactForce
  contact_force(const Problem<dim> &problem, const ConstraintSet<dim> &constraint_set, const ConstraintBlock &block, const Vector &lambda);
} // namespace unilateral
