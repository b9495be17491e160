// The stiffness of springs at points.
#pragma once

#include "unilateral/base/diagnostics.h"
#include "unilateral/functions/field_function.h"

#include <deal.II/base/point.h>

namespace unilateral
{
  /// @p spring at x. Throws InputError where it is negative: the energy might have no minimum.
  template <int dim>
  double spring_at(const FieldFunction &spring, const dealii::Point<dim> &x)
  {
    const double value = spring.value(x);
    if (value < 0)
      throw InputError(spring.where(), "'spring' must not be negative, it is so at a point of the mesh", MessageName("out-of-range"));
    return value;
  }
} // namespace unilateral
