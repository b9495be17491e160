// How Gmsh orders the nodes of its elements.
#pragma once

#include "unilateral/mesh/cell_list.h"

#include <vector>

namespace unilateral
{
  /// The number in deal.II's order of the corner that Gmsh has as number @p corner: Gmsh goes around a quadrilateral, deal.II goes along x,
  /// then y, then z.
  unsigned corner_of_gmsh(CellKind kind, unsigned corner);

  /// Of a cell with all nodes of order 2 those that are no corners, in Gmsh's order: the corners, by Gmsh's numbers, in whose middle each
  /// lies.
  const std::vector<std::vector<unsigned>> &corners_around_middle_nodes(CellKind kind);
} // namespace unilateral
