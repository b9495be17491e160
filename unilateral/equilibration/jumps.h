// Jumps of functions that are known by their values.
#pragma once

#include <deal.II/base/point.h>

#include <functional>

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
} // namespace unilateral
