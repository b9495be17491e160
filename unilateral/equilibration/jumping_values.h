// Prescribed values that jump: boundary conditions of two parts that differ where the parts meet, edges of expressions.
#pragma once

#include "unilateral/discretisation/problem.h"

namespace unilateral
{
  /// Do prescribed values jump on a face, or contradict each other where parts meet (FunctionSpace::dropped_values)? Then no function of
  /// finite energy has them, in more than one dimension. On faces it is jumps_on_face() that looks.
  template <int dim>
  bool prescribed_values_jump(const Problem<dim> &problem);
} // namespace unilateral
