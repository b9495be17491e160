// Where the faces of the reference cell are, and what lies outside.
#pragma once

#include <deal.II/base/point.h>
#include <deal.II/grid/reference_cell.h>

#include <optional>
#include <utility>

namespace unilateral
{
  /// The coordinate that a face of the reference cell fixes, and its value; none on the slanted face of a simplex.
  template <int dim>
  std::optional<std::pair<unsigned, double>> fixed_coordinate(dealii::ReferenceCell reference, unsigned face);

  /// How far a point in reference coordinates lies outside the cell: 0 inside.
  template <int dim>
  double distance_outside(const dealii::Point<dim> &x, bool simplex);

  /// Distance of a point in reference coordinates from the plane of a face.
  template <int dim>
  double distance_from_face(dealii::ReferenceCell reference, unsigned face, const dealii::Point<dim> &x);

  template <int dim>
  bool lies_on_face(dealii::ReferenceCell reference, unsigned face, const dealii::Point<dim> &x);
} // namespace unilateral
