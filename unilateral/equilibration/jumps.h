// Jumps of functions that are known by their values.
#pragma once

#include "unilateral/equilibration/straight_face.h"

#include <deal.II/base/point.h>

#include <functional>
#include <vector>

namespace unilateral
{
  /// A point and the value of a function there.
  template <int dim>
  struct ValueAt
  {
    dealii::Point<dim> x;
    double             value = 0;
  };

  /// Whether @p f jumps between two points by more than 1e-5 of @p size: bisection towards the larger change, where the values differ by
  /// more than twice what @p slope, the larger gradient of both ends, explains. Jumps with the same value at both ends are not found.
  template <int dim>
  bool jumps_between(
    const std::function<double(const dealii::Point<dim> &)> &f, ValueAt<dim> left, ValueAt<dim> right, double slope, double size);
  /// Rows of equidistant points on the reference face: 17 on a side; in space 9 rows of at most 9 in each direction.
  template <int dim>
  std::vector<std::vector<dealii::Point<dim - 1>>> equidistant_rows(bool simplex);

  /// Whether @p f jumps along equidistant_rows() of a face; @p slope: the size of its gradient at a point. What is narrower than the
  /// distance of the points is not seen.
  template <int dim>
  bool jumps_on_face(const StraightFace<dim>                                 &face,
                     bool                                                     simplex,
                     const std::function<double(const dealii::Point<dim> &)> &f,
                     const std::function<double(const ValueAt<dim> &)>       &slope,
                     double                                                   size);
} // namespace unilateral
