// A starting guess for the first mesh of a run, from the elements of degree 1 on it.
#pragma once

#include "unilateral/base/progress.h"
#include "unilateral/discretisation/problem.h"
#include "unilateral/inequality/discrete_problem.h"
#include "unilateral/nested_iteration.h"

namespace unilateral
{
  /// A mesh that nobody refines has no coarser one to start from; where it has elements of a higher degree, those of degree 1 have an
  /// eighth of the unknowns (a quarter in the plane) and nearly the same contact set. Solves the problem with these and interpolates
  /// displacement and nodal pressures to the nodes of @p problem. Empty where it would not pay, as where a factorisation serves for all
  /// contact sets, or does not succeed: on parts of a mesh, with nearly incompressible bodies, or without convergence.
  template <int dim>
  StartingGuess start_by_degree_1(const Problem<dim> &problem, const DiscreteProblem &discrete, Progress &progress);
} // namespace unilateral
