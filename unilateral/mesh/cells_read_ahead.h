// The cells of a mesh file that came along with its names.
#pragma once

#include "unilateral/mesh/cell_list.h"

#include <optional>

namespace unilateral
{
  /// Who makes the mesh first takes them; who makes it again reads the file again.
  struct CellsReadAhead
  {
    std::optional<CellList> cells;
  };
} // namespace unilateral
