// The section [mesh].
#pragma once

#include "unilateral/table_reader.h"

#include <string>

namespace unilateral
{
  /// Reads and checks [mesh]; relative paths start from @p folder. Errors go to @p diagnostics.
  /// Returns the space dimension, 0 when it cannot be told.
  unsigned read_mesh(const TomlValue &content, const std::string &folder, MeshSpec &mesh, Diagnostics &diagnostics);
} // namespace unilateral
