// Cells of a mesh file that do not share whole faces.
#pragma once

#include "unilateral/mesh/cell_table.h"

#include <deal.II/base/point.h>

#include <optional>
#include <vector>

namespace unilateral
{
  /// A vertex of the boundary in the middle of an edge or face of the boundary: the neighbour there is cut finer, and does not fit.
  template <int dim>
  std::optional<dealii::Point<dim>> hanging_node(const std::vector<VerticesOfFace>     &boundary,
                                                 const std::vector<dealii::Point<dim>> &points);

  /// The vertices of a face that it has.
  std::span<const unsigned> vertices_of(const VerticesOfFace &face);
} // namespace unilateral
