// What the rules of cells miss of data that jump or vary much within them.
#pragma once

#include "unilateral/algebra/vector.h"
#include "unilateral/discretisation/problem.h"

#include <vector>

namespace unilateral
{
  /// By active cell (f - a(u, .))(z) by a rule on halved cells, less the same by the rule that makes A and f: what integration makes of
  /// a number with the adjoint solution @p z. Of bodies f alone. Zero where the load, and the coefficients of a membrane, differ by less
  /// than 20 % at the points and next to the corners of a cell; beams and plates have it wherever data are no constants. What lies between
  /// all points of the finer rule stays unknown: the finer rule cuts a cell into 32 in 1-D, 64 in the plane, 8 in space.
  template <int dim>
  std::vector<double> work_of_unresolved_load(const Problem<dim> &problem, const Vector &u, const Vector &z);
} // namespace unilateral
