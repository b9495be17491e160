// Unstructured grids in VTK's XML format (VTU), as ParaView, VTK and meshio read it.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

namespace unilateral
{
  /// A named column of numbers, `n_components` to a point or cell.
  struct VtuArray
  {
    std::string         name;
    std::vector<double> values = {};
    unsigned            n_components = 1;
    bool                integral = false; ///< written as whole numbers (flags, indices)
  };

  /// Points, linear cells over them, and arrays on both.
  struct VtuGrid
  {
    std::vector<std::array<double, 3>> points;
    std::vector<std::int64_t>          connectivity; ///< point numbers, cell after cell, in VTK's order within a cell
    std::vector<std::int64_t>          offsets;      ///< end of each cell in `connectivity`
    std::vector<std::uint8_t>          cell_types;   ///< VTK's numbers: 1 vertex, 3 line, 5 triangle, 9 quad, 10 tetra, 12 hexahedron
    std::vector<VtuArray>              point_arrays;
    std::vector<VtuArray>              cell_arrays;
  };

  /// The file's text: XML around zlib-compressed, base64-coded doubles, exact to the last bit.
  std::string to_vtu(const VtuGrid &grid);
} // namespace unilateral
