#include "unilateral/equilibration/jumping_gaps.h"

#include "unilateral/equilibration/contact_gap.h"
#include "unilateral/equilibration/jumps.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace unilateral
{
  using namespace dealii;

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
  bool JumpingGaps<dim>::jumps_along_rows(const UnilateralCondition &condition, const StraightFace<dim> &geometry) const
  {
    const Tensor<1, dim> &n = geometry.normal;
    const auto            gap = [&](const Point<dim> &x)
    { return contact_gap<dim>(condition, x, n).value_or(std::numeric_limits<double>::quiet_NaN()); }; // out of reach: no jump
    for (const auto &row : equidistant_rows<dim>(simplex))
    {
      ValueAt<dim> last;
      double       last_slope = 0;
      for (std::size_t k = 0; k < row.size(); ++k)
      {
        const Point<dim>   x = geometry.at(row[k]);
        const ValueAt<dim> here{x, gap(x)};
        const double       slope = gradient_of_contact_gap<dim>(condition, x, n, here.value).norm();
        if (k > 0 && jumps_between<dim>(gap, last, here, std::max(slope, last_slope), size))
          return true;
        last = here;
        last_slope = slope;
      }
    }
    return false;
  }

  template <int dim>
  bool
  JumpingGaps<dim>::jumps_on(const UnilateralCondition &condition, const Cell &cell, const unsigned face, const StraightFace<dim> &geometry)
  {
    if (jumps_along_rows(condition, geometry))
      return true;
    bool             jumps = false;
    const Point<dim> center = cell->face(face)->center();
    for (const unsigned v : cell->face(face)->vertex_indices())
    {
      const Point<dim> x = cell->face(face)->vertex(v), inside = x + 1e-6 * (center - x);
      const auto       gap = contact_gap<dim>(condition, inside, geometry.normal);
      if (!gap)
        continue;
      const double change = gradient_of_contact_gap<dim>(condition, inside, geometry.normal, *gap).norm() * x.distance(inside);
      auto        &others = at_vertices[cell->face(face)->vertex_index(v)];
      jumps = jumps || std::any_of(others.begin(), others.end(),
                                   [&](const AtVertex &other)
                                   {
                                     return other.condition == &condition && other.normal * geometry.normal > 1 - 1e-10 &&
                                            std::abs(other.gap - *gap) > 2 * (change + other.change) + 1e-5 * size;
                                   });
      others.push_back({&condition, geometry.normal, *gap, change});
    }
    return jumps;
  }

#define INSTANTIATE(dim)                                                                                                                   \
  template std::vector<std::vector<Point<dim - 1>>> equidistant_rows<dim>(bool);                                                           \
  template class JumpingGaps<dim>;
  INSTANTIATE(2)
  INSTANTIATE(3)
#undef INSTANTIATE
} // namespace unilateral
