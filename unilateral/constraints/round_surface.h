// The circle, sphere or cylinder that the facets of a boundary part stand for.
#pragma once

#include "unilateral/base/processes.h"

#include <deal.II/base/point.h>
#include <deal.II/base/tensor.h>
#include <deal.II/grid/tria.h>

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

  /// A face of the part: its corners and its outward normal, of unit length.
  template <int dim>
  struct Facet
  {
    std::vector<dealii::Point<dim>> corners;
    dealii::Tensor<1, dim>          normal;
  };

  /// Those of the active cells. In space a facet is the plane through three of its corners.
  template <int dim>
  std::vector<Facet<dim>> facets_of_part(const dealii::Triangulation<dim> &mesh, dealii::types::boundary_id part);

  /// Those of all processes, @p own ones of each.
  template <int dim>
  std::vector<Facet<dim>> gather_facets(std::vector<Facet<dim>> own, const Processes &processes);

  /// The cylinder with this @p axis, or else the circle or sphere, on which all corners lie, to a part in a million of its radius. Nothing
  /// where there is none, where the facets turn by more than 56 degrees from one to the next, as those of a nut, and where all of them lie
  /// in one plane. @p on_manifold: refinement follows a curve, so that even the sides of a square may stand for a circle.
  ///
  /// At a node the normal of a facet departs from that of the surface by half the angle between facets, and the mean of two facets by a
  /// part of it unless they are equally long. Contact forces along such normals have a moment about the axis of a pin, which without
  /// friction they must not have.
  template <int dim>
  std::optional<RoundSurface>
  round_surface_of(const std::vector<Facet<dim>> &facets, const std::optional<std::array<double, 3>> &axis, bool on_manifold = false);
} // namespace unilateral
