// The scalar product of vectors of V_h and of values at the constraint points.
#pragma once

#include "unilateral/discrete_problem.h"

namespace unilateral
{
  double scalar_product(const Vector &a, const Vector &b);
} // namespace unilateral
