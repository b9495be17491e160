#include "unilateral/constraints/direction_of_contact.h"

namespace unilateral
{
  using namespace dealii;

  template <int dim>
  std::optional<Tensor<1, dim>> direction_of_contact(const UnilateralCondition &condition)
  {
    Tensor<1, dim> direction;
    if (!condition.direction.empty())
      for (unsigned d = 0; d < dim; ++d)
        direction[d] = condition.direction[d];
    else if (const auto normal = condition.surface ? condition.surface->only_direction() : std::nullopt)
      for (unsigned d = 0; d < dim; ++d)
        direction[d] = (*normal)[d];
    else
      return {};
    return direction;
  }

  template std::optional<Tensor<1, 1>> direction_of_contact(const UnilateralCondition &);
  template std::optional<Tensor<1, 2>> direction_of_contact(const UnilateralCondition &);
  template std::optional<Tensor<1, 3>> direction_of_contact(const UnilateralCondition &);
} // namespace unilateral
