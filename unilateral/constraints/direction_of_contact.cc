#include "unilateral/constraints/direction_of_contact.h"

namespace unilateral
{
  using namespace dealii;

  template <int dim>
  std::optional<Tensor<1, dim>> direction_of_contact(const std::vector<double> &given, const RigidSurface *const surface)
  {
    Tensor<1, dim> direction;
    if (!given.empty())
      for (unsigned d = 0; d < dim; ++d)
        direction[d] = given[d];
    else if (const auto normal = surface ? surface->only_direction() : std::nullopt)
      for (unsigned d = 0; d < dim; ++d)
        direction[d] = (*normal)[d];
    else
      return {};
    return direction;
  }

  template std::optional<Tensor<1, 1>> direction_of_contact(const std::vector<double> &, const RigidSurface *);
  template std::optional<Tensor<1, 2>> direction_of_contact(const std::vector<double> &, const RigidSurface *);
  template std::optional<Tensor<1, 3>> direction_of_contact(const std::vector<double> &, const RigidSurface *);
} // namespace unilateral
