// [[periodic]]: parts of the boundary of which one repeats the other.
#pragma once

#include "unilateral/case/case.h"
#include "unilateral/case/toml_document.h"

#include <string>
#include <vector>

namespace unilateral
{
  /// Adds the pairs to @p request, whose mesh and kind are known. @p folder: of the case.
  void read_periodic(const std::vector<const TomlValue *> &contents, const std::string &folder, Case &request, Diagnostics &diagnostics);
} // namespace unilateral
