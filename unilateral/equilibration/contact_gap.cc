#include "unilateral/equilibration/contact_gap.h"

#include <array>

namespace unilateral
{
  using namespace dealii;

  namespace
  {
    template <int dim>
    std::array<double, 3> three_numbers(const Tensor<1, dim> &t)
    {
      std::array<double, 3> result{};
      for (unsigned d = 0; d < dim; ++d)
        result[d] = t[d];
      return result;
    }
  } // namespace

  template <int dim>
  std::optional<double> contact_gap(const UnilateralCondition &condition, const Point<dim> &x, const Tensor<1, dim> &normal)
  {
    if (condition.surface)
      return condition.surface->distance(three_numbers<dim>(x), three_numbers<dim>(normal));
    return condition.bound.value(x);
  }

  template <int dim>
  Tensor<1, dim>
  gradient_of_contact_gap(const UnilateralCondition &condition, const Point<dim> &x, const Tensor<1, dim> &normal, const double gap)
  {
    if (!condition.surface)
      return condition.bound.gradient(x);
    Tensor<1, dim> result;
    if (const auto at = condition.surface->normal(three_numbers<dim>(Tensor<1, dim>(x + gap * normal))))
    {
      for (unsigned d = 0; d < dim; ++d)
        result[d] = (*at)[d];
      result /= -(result * normal);
    }
    return result;
  }

#define INSTANTIATE(dim)                                                                                                                   \
  template std::optional<double> contact_gap(const UnilateralCondition &, const Point<dim> &, const Tensor<1, dim> &);                     \
  template Tensor<1, dim>        gradient_of_contact_gap(const UnilateralCondition &, const Point<dim> &, const Tensor<1, dim> &, double);
  INSTANTIATE(2)
  INSTANTIATE(3)
#undef INSTANTIATE
} // namespace unilateral
