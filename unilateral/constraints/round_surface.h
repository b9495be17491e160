// The circle, sphere or cylinder that the facets of a boundary part stand for.
#pragma once

#include <deal.II/base/point.h>
#include <deal.II/base/tensor.h>

#include <array>
#include <optional>
#include <vector>

namespace unilateral
{
  /// A round surface of a body. In 2-D, z is 0.
  struct RoundSurface
  {
    std::array<double, 3> centre{}; ///< of a cylinder: a point of its axis
    std::array<double, 3> axis{};   ///< of a cylinder, of unit length; of circles and spheres 0
    double                sign = 1; ///< 1: the body lies inside, -1: around it

    /// The outward normal of the body at a point near the surface.
    template <int dim>
    dealii::Tensor<1, dim> normal(const dealii::Point<dim> &x) const;
  };

  /// A face of the part: its corners and its outward normal.
  template <int dim>
  struct Facet
  {
    std::vector<dealii::Point<dim>> corners;
    dealii::Tensor<1, dim>          normal;
  };

  /// The circle or sphere, or the cylinder with this @p axis, on which all corners lie, to a part in a million of its radius. Nothing where
  /// there is none, where the facets turn by more than 56 degrees from one to the next, as those of a nut, and where all of them lie in one
  /// plane.
  ///
  /// The normal of a facet is up to half a turn off, and the mean of two facets that are not equally long as much as their difference: a
  /// ring with such normals does not turn freely on its pin but hangs on a hook.
  template <int dim>
  std::optional<RoundSurface> round_surface_of(const std::vector<Facet<dim>> &facets, const std::optional<std::array<double, 3>> &axis);
} // namespace unilateral
