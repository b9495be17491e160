#include "unilateral/equilibration/jumps.h"

#include <cmath>

namespace unilateral
{
  using namespace dealii;

  template <int dim>
  bool jumps_between(
    const std::function<double(const Point<dim> &)> &f, ValueAt<dim> left, ValueAt<dim> right, const double slope, const double size)
  {
    if (std::abs(left.value - right.value) <= 2 * slope * left.x.distance(right.x) + 1e-10 * size)
      return false;
    for (unsigned halving = 0; halving < 40; ++halving)
    {
      const Point<dim> middle = left.x + 0.5 * (right.x - left.x);
      const double     value = f(middle);
      (std::abs(value - left.value) > std::abs(right.value - value) ? right : left) = {middle, value};
    }
    return std::abs(left.value - right.value) > 1e-5 * size;
  }

#define INSTANTIATE(dim)                                                                                                                   \
  template bool jumps_between(const std::function<double(const Point<dim> &)> &, ValueAt<dim>, ValueAt<dim>, double, double);
  INSTANTIATE(1)
  INSTANTIATE(2)
  INSTANTIATE(3)
#undef INSTANTIATE
} // namespace unilateral
