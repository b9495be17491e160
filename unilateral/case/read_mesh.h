// The section [mesh].
#pragma once

#include "unilateral/case/case.h"
#include "unilateral/case/table_reader.h"
#include "unilateral/mesh/mesh_outline.h"

#include <string>

namespace unilateral
{
  /// Reads and checks [mesh]; relative paths start from @p folder. Errors go to @p diagnostics.
  /// Returns the outline, of dimension 0 and without names when it cannot be told.
  /// @p given: the mesh that the calling program has, or nothing.
  MeshOutline read_mesh(const TomlValue                       &content,
                        const std::string                     &folder,
                        const std::shared_ptr<const CellList> &given,
                        MeshSpec                              &mesh,
                        Diagnostics                           &diagnostics);
} // namespace unilateral
