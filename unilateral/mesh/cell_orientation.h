// The order of the vertices of a cell, by the sign of its volume.
#pragma once

#include <deal.II/base/point.h>

#include <vector>

namespace unilateral
{
  /// Mirrors the order of the vertices of @p cell, a segment, triangle or tetrahedron or (not @p simplex) a quadrilateral or hexahedron in
  /// deal.II's order, where its volume is negative. False where it is flat, folded or too large for a volume at one of its corners.
  template <int dim>
  bool turn_to_positive_volume(std::vector<unsigned> &cell, bool simplex, const std::vector<dealii::Point<dim>> &points);
} // namespace unilateral
