// In which direction contact acts where that does not depend on the place.
#pragma once

#include "unilateral/functions/rigid_surface.h"

#include <deal.II/base/tensor.h>

#include <optional>
#include <vector>

namespace unilateral
{
  /// Of all contact of a body alike: what is @p given (`dim` numbers, or none), or, of a plane, minus its normal. Nothing where it is the
  /// normal of the body's surface. @p surface: of the obstacle, if there is one.
  template <int dim>
  std::optional<dealii::Tensor<1, dim>> direction_of_contact(const std::vector<double> &given, const RigidSurface *surface);
} // namespace unilateral
