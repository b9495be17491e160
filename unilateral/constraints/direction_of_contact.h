// In which direction contact acts where that does not depend on the place.
#pragma once

#include "unilateral/constraints/constraint_set.h"

#include <deal.II/base/tensor.h>

#include <optional>

namespace unilateral
{
  /// Of all contact of a body alike: what the user gives, or, of a plane, minus its normal. Nothing where it is the normal of the surface.
  template <int dim>
  std::optional<dealii::Tensor<1, dim>> direction_of_contact(const UnilateralCondition &condition);
} // namespace unilateral
