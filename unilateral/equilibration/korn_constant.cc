#include "unilateral/equilibration/korn_constant.h"

#include <deal.II/base/tensor.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace unilateral
{
  using namespace dealii;

  KornConstant korn_constant(const std::vector<Point<2>> &ring)
  {
    const std::size_t n = ring.size();
    // Weighted with the lengths of the sides that do not meet there, corners of a triangle give the centre of its inscribed circle.
    Point<2> centre;
    double   sum = 0;
    for (std::size_t k = 0; k < n; ++k)
    {
      const double weight = n == 3 ? ring[(k + 1) % n].distance(ring[(k + 2) % n]) : 1;
      centre += weight * ring[k];
      sum += weight;
    }
    centre /= sum;
    KornConstant result;
    double       outer = 0, inner = std::numeric_limits<double>::max();
    for (std::size_t k = 0; k < n; ++k)
    {
      const Tensor<1, 2> side = ring[(k + 1) % n] - ring[k], to_centre = centre - ring[k];
      inner = std::min(inner, std::abs(side[0] * to_centre[1] - side[1] * to_centre[0]) / side.norm());
      outer = std::max(outer, to_centre.norm());
      for (std::size_t l = 0; l < k; ++l)
        result.diameter = std::max(result.diameter, ring[k].distance(ring[l]));
    }
    const double ratio = std::min(1., inner / outer);
    const double beta_square = ratio * ratio / (2 * (1 + std::sqrt(1 - ratio * ratio)));
    result.of_gradient = std::sqrt(1 + 2 / beta_square);
    result.of_value = result.diameter / std::numbers::pi * result.of_gradient;
    return result;
  }
} // namespace unilateral
