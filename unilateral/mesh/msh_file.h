// A .msh file of Gmsh's format 4.1 or 2.2, read once from its beginning to its end.
#pragma once

#include "unilateral/mesh/mesh_outline.h"
#include "unilateral/mesh/msh_index.h"

#include <cstdint>
#include <optional>
#include <string>

namespace unilateral
{
  /// Names and dimension as gmsh_outline() has them, by the head of the file alone in format 4.1, and by one reading in format 2.2.
  /// Nothing: the file is damaged or of another kind, and Gmsh says what it makes of it.
  std::optional<MeshOutline> outline_of_msh(const std::string &file);

  /// Reads the file once from its beginning to its end, in a buffer. Pieces have at most @p most_in_piece nodes or elements. Nothing: the
  /// file is damaged, has elements of other kinds or orders, or of several, without all nodes of their order, or what Gmsh writes for
  /// meshes that it has divided itself; in format 2.2 entities are in one group at most, and their elements stand together.
  std::optional<MshIndex> index_of_msh(const std::string &file, std::uint64_t most_in_piece = 20000);
} // namespace unilateral
