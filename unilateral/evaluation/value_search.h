// Values of a function on a part of a cell, with interval arithmetic: those that points may have missed.
#pragma once

#include "unilateral/functions/field_function.h"

#include <deal.II/base/point.h>

#include <array>
#include <optional>
#include <utility>
#include <vector>

namespace unilateral
{
  /// Of a cell or a face.
  template <int dim, typename Object>
  std::vector<dealii::Point<dim>> vertices_of(const Object &object)
  {
    std::vector<dealii::Point<dim>> vertices;
    for (const unsigned v : object->vertex_indices())
      vertices.push_back(object->vertex(v));
    return vertices;
  }

  /// The place of a point of the reference cell in a cell with straight sides.
  template <int dim, typename Cell>
  dealii::Point<dim> straight_place(const Cell &cell, const dealii::Point<dim> &unit)
  {
    dealii::Point<dim> x;
    for (const unsigned v : cell->vertex_indices())
      x += cell->reference_cell().d_linear_shape_function(unit, v) * cell->vertex(v);
    return x;
  }

  /// The value at a point; none where the function has none, as at a pole.
  template <int dim>
  std::optional<double> value_if_any(const FieldFunction &function, const dealii::Point<dim> &x);

  /// Contains every value on the convex hull of the points @p vertices; none where that is not known.
  template <int dim>
  std::optional<Interval> range_on(const FieldFunction &function, const std::vector<dealii::Point<dim>> &vertices);

  /// The two halves of a segment, triangle or tetrahedron (@p simplex), cut at the middle of the longest edge, or of a quadrilateral or
  /// hexahedron with the corners @p vertices (lexicographic), cut across the longest direction.
  template <int dim>
  std::array<std::vector<dealii::Point<dim>>, 2> halves_of(const std::vector<dealii::Point<dim>> &vertices, bool simplex);

  /// A place with a value outside of @p known on a segment, triangle or tetrahedron (@p simplex), quadrilateral or hexahedron with the
  /// corners
  /// @p vertices (lexicographic), of a function with a range_on(). A part of the cell whose range lies in @p known is left out, any other
  /// one evaluated in the middle and halved, so often that its sides are a 250th of those of the cell (in space a 32nd), in 400 steps at
  /// most.
  template <int dim>
  std::optional<std::pair<dealii::Point<dim>, double>>
  find_value_outside(const Interval &known, const FieldFunction &function, const std::vector<dealii::Point<dim>> &vertices, bool simplex);

  /// At least the mean over such a cell of the square of the distance of the values from @p known: of its parts those where that may be
  /// most are halved, 400 times. At poles twice the value in the middle of a part counts.
  template <int dim>
  double
  mean_square_outside(const Interval &known, const FieldFunction &function, const std::vector<dealii::Point<dim>> &vertices, bool simplex);
} // namespace unilateral
