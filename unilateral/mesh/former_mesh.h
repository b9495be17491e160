// The mesh that an unfinished run had come to, as another run needs it to come to the same.
#pragma once

#include <array>
#include <vector>

namespace unilateral
{
  struct FormerMesh
  {
    std::vector<std::array<double, 3>> centres; ///< of all cells; coordinates beyond those of the mesh are 0
  };
} // namespace unilateral
