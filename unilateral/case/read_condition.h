// What holds on a part of the boundary, as it stands in [boundary].
#pragma once

#include "unilateral/case/case.h"
#include "unilateral/case/table_reader.h"

#include <string>

namespace unilateral
{
  /// Adds to @p condition, whose part and place are set, what @p value says for the kind of @p request.
  void
  read_condition(const TomlValue &value, const Case &request, const std::string &folder, BoundarySpec &condition, Diagnostics &diagnostics);
} // namespace unilateral
