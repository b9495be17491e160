// What can be said of a mesh before it is built.
#pragma once

#include <string>
#include <vector>

namespace unilateral
{
  /// What can be said of a mesh before it is built.
  struct MeshOutline
  {
    unsigned dimension = 0;
    /// Every name that a part or a region can have. Of a file: its own names, and "boundary" and "domain", which what has no name is
    /// called if there is any.
    std::vector<std::string> part_names, region_names;
  };
} // namespace unilateral
