// A function that a program hands over where a case file has the text of one.
#pragma once

#include "unilateral/functions/field_function.h"

#include <memory>
#include <string>

namespace unilateral
{
  class GivenFunction
  {
  public:
    virtual ~GivenFunction() = default;

    /// The function on a mesh in @p dim dimensions. Throws std::runtime_error with the reason where it is none.
    virtual std::shared_ptr<const FieldFunction::Source> in_dimension(unsigned dim) const = 0;

    /// What an expanded case calls it.
    virtual std::string name() const = 0;
  };
} // namespace unilateral
