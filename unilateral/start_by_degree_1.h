// A starting guess for the first mesh of a run, from the elements of degree 1 on it.
#pragma once

#include "unilateral/base/progress.h"
#include "unilateral/discretisation/problem.h"
#include "unilateral/nested_iteration.h"

namespace unilateral
{
  /// A mesh that nobody refines has no coarser one to start from; where it has elements of a higher degree, those of degree 1 have an
  /// eighth of the unknowns (a quarter in the plane) and nearly the same contact set. Solves the problem with these and interpolates
  /// displacement and nodal pressures to the nodes of @p problem, which is that of the whole mesh. Pays where an iterative solver comes
  /// after it. Empty where elements of degree 1 say little, as of nearly incompressible bodies, or where the solver does not converge.
  template <int dim>
  StartingGuess start_by_degree_1(const Problem<dim> &problem, Progress &progress);
} // namespace unilateral
