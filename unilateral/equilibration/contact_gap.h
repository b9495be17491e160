// The gap of a contact condition as a function of position.
#pragma once

#include "unilateral/constraints/constraint_set.h"

#include <deal.II/base/point.h>
#include <deal.II/base/tensor.h>

#include <optional>

namespace unilateral
{
  /// How far a point of the surface can move along @p normal before it meets the obstacle; nothing where it never does. Throws InputError
  /// where the function of the case has no value.
  template <int dim>
  std::optional<double>
  contact_gap(const UnilateralCondition &condition, const dealii::Point<dim> &x, const dealii::Tensor<1, dim> &normal);

  /// Its gradient, @p gap being its value: the distance t to a surface with the normal N has the derivatives -N/(N.normal), N in x + t
  /// normal.
  template <int dim>
  dealii::Tensor<1, dim> gradient_of_contact_gap(const UnilateralCondition    &condition,
                                                 const dealii::Point<dim>     &x,
                                                 const dealii::Tensor<1, dim> &normal,
                                                 double                        gap);

} // namespace unilateral
