// What is asked of the solution: [output], [[functional]], [[expect]].
#pragma once

#include "unilateral/case/case.h"
#include "unilateral/case/toml_document.h"

#include <string>
#include <vector>

namespace unilateral
{
  /// Add to @p request what the tables say; mistakes go to the diagnostics.
  void read_output(const TomlValue &content, Case &request, Diagnostics &diagnostics);
  void read_functionals(const std::vector<const TomlValue *> &contents, const std::string &folder, Case &request, Diagnostics &diagnostics);
  void read_expectations(const std::vector<const TomlValue *> &contents, Case &request, Diagnostics &diagnostics);
} // namespace unilateral
