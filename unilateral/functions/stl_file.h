// Triangles from STL files, text and binary.
#pragma once

#include <array>
#include <string>
#include <vector>

namespace unilateral
{
  /// Three vertices, counter-clockwise as seen from outside.
  using StlTriangle = std::array<std::array<double, 3>, 3>;

  /// The triangles of @p file, one at least, in its order and its unit, with all coordinates finite. The normals that the file gives are
  /// not looked at: writers leave them zero. Several solids become one.
  /// Throws std::runtime_error: no file, larger than 256 MB, cut short, not STL (with the line), no triangles, a vertex that is none.
  std::vector<StlTriangle> read_stl(const std::string &file);
} // namespace unilateral
