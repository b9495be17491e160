// Unstructured grids in VTK's XML format (VTU), as ParaView, VTK and meshio read it.
#pragma once

#include <array>
#include <cstdint>
#include <ostream>
#include <string>
#include <variant>
#include <vector>

namespace unilateral
{
  /// A named column of numbers, `n_components` to a point or cell.
  struct VtuArray
  {
    std::string                                                                             name;
    std::variant<std::vector<double>, std::vector<std::int32_t>, std::vector<std::uint8_t>> values = std::vector<double>();
    unsigned                                                                                n_components = 1;
  };

  /// Points, linear cells over them, and arrays on both.
  struct VtuGrid
  {
    std::vector<std::array<double, 3>> points;
    std::vector<std::int32_t>          connectivity; ///< point numbers, cell after cell, in VTK's order within a cell
    std::vector<std::int32_t>          offsets;      ///< end of each cell in `connectivity`
    std::vector<std::uint8_t>          cell_types;   ///< VTK's numbers: 1 vertex, 3 line, 5 triangle, 9 quad, 10 tetra, 12 hexahedron
    std::vector<VtuArray>              point_arrays;
    std::vector<VtuArray>              cell_arrays;
  };

  /// XML that describes the arrays, and the arrays behind it as they are in memory ("appended raw"): exact to the last bit, and as quick to
  /// write and read as the disk is.
  void write_vtu(std::ostream &out, const VtuGrid &grid);

  /// The same as a text.
  std::string to_vtu(const VtuGrid &grid);

  /// The file that holds several such grids together, each in a file of its own (PVTU). All have the arrays of @p grid.
  std::string to_pvtu(const VtuGrid &grid, const std::vector<std::string> &files);

  /// A collection (PVD) of such files as a sequence: file k is at time k, or at @p times[k].
  std::string to_pvd(const std::vector<std::string> &files, const std::vector<double> &times = {});
} // namespace unilateral
