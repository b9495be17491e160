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
  bool
  JumpingGaps<dim>::jumps_on(const UnilateralCondition &condition, const Cell &cell, const unsigned face, const StraightFace<dim> &geometry)
  {
    const Tensor<1, dim> &n = geometry.normal;
    if (jumps_on_face<dim>(
          geometry, simplex,
          [&](const Point<dim> &x) { return contact_gap<dim>(condition, x, n).value_or(std::numeric_limits<double>::quiet_NaN()); },
          [&](const ValueAt<dim> &at) { return gradient_of_contact_gap<dim>(condition, at.x, n, at.value).norm(); }, size))
      return true; // NaN, out of reach: no jump
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

  template class JumpingGaps<2>;
  template class JumpingGaps<3>;
} // namespace unilateral
