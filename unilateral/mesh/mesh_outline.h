// What can be said of a mesh before it is built.
#pragma once

#include <memory>
#include <string>
#include <vector>

namespace unilateral
{
  struct CellsReadAhead; // cells_read_ahead.h

  /// What can be said of a mesh before it is built.
  struct MeshOutline
  {
    unsigned dimension = 0;
    /// Every name that a part or a region can have. Of a file: its own names, and "boundary" and "domain", which what has no name is
    /// called if there is any.
    std::vector<std::string> part_names, region_names;

    std::shared_ptr<CellsReadAhead> read_ahead = nullptr; ///< of a .msh file, if they are wanted, see FileAccess
  };
} // namespace unilateral
