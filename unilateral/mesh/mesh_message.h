// Cells and names as bytes, between the process that reads a mesh file and the one that wants it.
#pragma once

#include "unilateral/mesh/cell_list.h"
#include "unilateral/mesh/mesh_outline.h"

#include <optional>
#include <string>
#include <utility>

namespace unilateral
{
  std::string to_bytes(const MeshOutline &outline);
  std::string to_bytes(const CellList &list);
  std::string to_bytes(const MeshOutline &outline, const std::optional<CellList> &list);

  // The other way, from bytes that may be anything. Throw std::runtime_error when they are not what the functions above make, or when
  // they name vertices, parts or regions that are not there.
  MeshOutline                                     outline_of_bytes(const std::string &bytes);
  CellList                                        cells_of_bytes(const std::string &bytes);
  std::pair<MeshOutline, std::optional<CellList>> outline_and_cells_of_bytes(const std::string &bytes);
} // namespace unilateral
