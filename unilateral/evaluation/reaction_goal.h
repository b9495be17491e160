// A reaction of a body as a functional of its displacement.
#pragma once

#include "unilateral/constraints/constraint_set.h"
#include "unilateral/discretisation/problem.h"

#include <cstddef>
#include <string>
#include <vector>

namespace unilateral
{
  /// The parts of which ForceBalance::reactions has the forces, in its order, whatever the solution.
  template <int dim>
  std::vector<std::string> parts_with_reactions(const Problem<dim> &problem);

  /// w in the finite element space with component @p component of reaction @p number = a(u, w) + (lambda, B w) - f(w): one at the unknowns
  /// of this component at which the part holds the body, zero at the others.
  template <int dim>
  Vector motion_of_support(const Problem<dim> &problem, std::size_t number, unsigned component);

  /// A w in terms of the unknowns that are free, zero at the others, of a function @p w that need not vanish where values are prescribed.
  template <int dim>
  Vector stiffness_times(const Problem<dim> &problem, const ConstraintSet<dim> &constraint_set, const Vector &w);
} // namespace unilateral
