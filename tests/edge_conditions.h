// Coefficients and conditions on the edges of plates and the ends of beams.
#pragma once

#include "unilateral/functions/compile_field.h"
#include "unilateral/spaces/boundary_condition.h"

#include <string>

namespace unilateral
{
  inline FieldFunction text(const std::string &expression)
  {
    return compile_field(FieldSpec::expression(expression), {});
  }
  inline FieldFunction number(const double value)
  {
    return value;
  }

  inline BoundaryCondition clamped(const FieldFunction &value = number(0), const FieldFunction &slope = number(0))
  {
    BoundaryCondition edge;
    edge.value = value;
    edge.slope = slope;
    return edge;
  }

  inline BoundaryCondition supported(const FieldFunction &value = number(0))
  {
    BoundaryCondition edge;
    edge.value = value;
    return edge;
  }

  inline BoundaryCondition symmetric()
  {
    BoundaryCondition edge;
    edge.symmetry = true;
    return edge;
  }
} // namespace unilateral
