#include "unilateral/functions/field_spec.h"

namespace unilateral
{
  FieldSpec FieldSpec::constant(const double value)
  {
    FieldSpec spec;
    spec.kind = Kind::constant;
    spec.value = value;
    return spec;
  }

  FieldSpec FieldSpec::expression(std::string text)
  {
    FieldSpec spec;
    spec.kind = Kind::expression;
    spec.text = std::move(text);
    return spec;
  }
} // namespace unilateral
