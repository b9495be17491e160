// Functions on cells in files, to the last bit.
#pragma once

#include "unilateral/functions/cell_functions.h"

#include <memory>
#include <string>
#include <vector>

namespace unilateral
{
  /// The bytes of a file that read_cell_functions() understands, on machines with the same order of bytes.
  std::string to_bytes(const CellFunctions &functions);

  /// The functions in the files @p paths together: those of parts of a mesh become one on all of them. Nothing in the files is trusted.
  /// Throws std::runtime_error with the file's name and what is wrong with it.
  std::shared_ptr<const CellFunctions> read_cell_functions(const std::vector<std::string> &paths);
} // namespace unilateral
