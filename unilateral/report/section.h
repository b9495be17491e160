// Functions along a line through a scene.
#pragma once

#include "unilateral/report/scene.h"

#include <array>
#include <string>
#include <utility>
#include <vector>

namespace unilateral
{
  struct Section
  {
    std::vector<double>                                      s;      ///< distance from the start; in 1-D x itself
    std::vector<std::pair<std::string, std::vector<double>>> values; ///< by field; scalars only
  };

  /// The line that shows most: in 1-D the mesh; in 2-D parallel to the longer side, through the largest contact pressure.
  std::pair<std::array<double, 2>, std::array<double, 2>> default_section_line(const Scene &scene);

  /// Along the line from @p a to @p b, at its crossings with the edges of triangles: exact for the functions that are shown. 1-D and
  /// 2-D; empty otherwise.
  Section section_along(const Scene &scene, const std::array<double, 2> &a, const std::array<double, 2> &b);
} // namespace unilateral
