#include "unilateral/equilibration/jumps.h"

#include <algorithm>
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

  template <int dim>
  std::vector<std::vector<Point<dim - 1>>> equidistant_rows(const bool simplex)
  {
    constexpr unsigned                       n = dim == 2 ? 16 : 8;
    std::vector<std::vector<Point<dim - 1>>> rows;
    for (unsigned along = 0; along < dim - 1; ++along)
      for (unsigned row = 0; row <= (dim == 2 ? 0 : n); ++row)
      {
        auto &points = rows.emplace_back();
        for (unsigned k = 0; k <= n - (simplex ? row : 0); ++k)
        {
          Point<dim - 1> point;
          point[along] = double(k) / n;
          if constexpr (dim == 3)
            point[1 - along] = double(row) / n;
          points.push_back(point);
        }
      }
    return rows;
  }

  template <int dim>
  bool jumps_on_face(const StraightFace<dim>                           &face,
                     const bool                                         simplex,
                     const std::function<double(const Point<dim> &)>   &f,
                     const std::function<double(const ValueAt<dim> &)> &slope,
                     const double                                       size)
  {
    for (const auto &row : equidistant_rows<dim>(simplex))
    {
      ValueAt<dim> last;
      double       last_slope = 0;
      for (std::size_t k = 0; k < row.size(); ++k)
      {
        const Point<dim>   x = face.at(row[k]);
        const ValueAt<dim> here{x, f(x)};
        const double       slope_here = slope(here);
        if (k > 0 && jumps_between<dim>(f, last, here, std::max(slope_here, last_slope), size))
          return true;
        last = here;
        last_slope = slope_here;
      }
    }
    return false;
  }

#define INSTANTIATE(dim)                                                                                                                   \
  template std::vector<std::vector<Point<dim - 1>>> equidistant_rows<dim>(bool);                                                           \
  template bool jumps_on_face(const StraightFace<dim> &, bool, const std::function<double(const Point<dim> &)> &,                          \
                              const std::function<double(const ValueAt<dim> &)> &, double);
  INSTANTIATE(2)
  INSTANTIATE(3)
#undef INSTANTIATE

#define INSTANTIATE(dim)                                                                                                                   \
  template bool jumps_between(const std::function<double(const Point<dim> &)> &, ValueAt<dim>, ValueAt<dim>, double, double);
  INSTANTIATE(1)
  INSTANTIATE(2)
  INSTANTIATE(3)
#undef INSTANTIATE
} // namespace unilateral
