// The polygons of a grid that can be seen: its plane cells, and the outer faces of solid ones.
#pragma once

#include "unilateral/output/vtu_file.h"

#include <array>
#include <cstdint>
#include <vector>

namespace unilateral
{
  /// A polygon of three or four corners and the cell that it belongs to.
  struct Polygon
  {
    std::array<std::uint32_t, 4> corners{}; ///< counterclockwise, seen from outside
    unsigned                     n = 3;
    std::uint32_t                cell = 0;
  };

  /// For each point of the grid the first one of the same place, but for rounding: pieces of several processes meet in points of their own.
  std::vector<std::uint32_t> numbers_by_place(const VtuGrid &grid);

  /// Plane cells, and the faces that only one solid cell has; @p by_place: numbers_by_place() of the grid.
  std::vector<Polygon> surface_of(const VtuGrid &grid, const std::vector<std::uint32_t> &by_place);
} // namespace unilateral
