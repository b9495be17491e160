// What a boundary condition prescribes of a displacement.
#pragma once

#include "unilateral/spaces/boundary_condition.h"

#include <deal.II/base/tensor.h>

#include <vector>

namespace unilateral
{
  /// The orthonormal directions in which the displacement is given on a flat face: all components with a value, and the normal on a plane
  /// of symmetry.
  template <int dim>
  std::vector<dealii::Tensor<1, dim>> prescribed_directions(const PartCondition &condition, const dealii::Tensor<1, dim> &normal)
  {
    std::vector<dealii::Tensor<1, dim>> directions;
    for (unsigned c = 0; c < condition.components.size() && c < dim; ++c)
      if (condition.components[c])
      {
        directions.emplace_back();
        directions.back()[c] = 1;
      }
    if (!condition.symmetry)
      return directions;
    dealii::Tensor<1, dim> rest = normal;
    for (const auto &direction : directions)
      rest -= (rest * direction) * direction;
    if (rest.norm() > 1e-10)
      directions.push_back(rest / rest.norm());
    return directions;
  }
} // namespace unilateral
