// Prescribed values that jump: boundary conditions of two parts that differ where the parts meet, edges of expressions.
#pragma once

#include "unilateral/discretisation/problem.h"

namespace unilateral
{
  /// Do prescribed values jump on a face, or between faces that share a vertex? Then no function of finite energy has them, in more than
  /// one dimension. Looked for at equidistant_rows() of each face; what is narrower than the distance of the points is not seen. Jumps of
  /// less than 1e-5 of the largest value are none.
  template <int dim>
  bool prescribed_values_jump(const Problem<dim> &problem);
} // namespace unilateral
