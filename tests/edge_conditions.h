// Coefficients and conditions on the edges of plates and the ends of beams.
#pragma once

#include "unilateral/case/case.h"

#include <string>

namespace unilateral
{
  inline FieldSpec text(const std::string &expression)
  {
    return FieldSpec::expression(expression);
  }
  inline FieldSpec number(const double value)
  {
    return FieldSpec::constant(value);
  }

  inline BoundarySpec clamped(const FieldSpec &value = number(0), const FieldSpec &slope = number(0))
  {
    BoundarySpec edge;
    edge.value = value;
    edge.slope = slope;
    return edge;
  }

  inline BoundarySpec supported(const FieldSpec &value = number(0))
  {
    BoundarySpec edge;
    edge.value = value;
    return edge;
  }

  inline BoundarySpec symmetric()
  {
    BoundarySpec edge;
    edge.symmetry = true;
    return edge;
  }
} // namespace unilateral
