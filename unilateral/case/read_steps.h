// [[step]] and [steps]: a load history.
#pragma once

#include "unilateral/case/case.h"
#include "unilateral/case/toml_document.h"

#include <functional>
#include <string>

namespace unilateral
{
  /// Reads the case in a document that differs from that of the case at hand in what steps may set.
  using StepReader = std::function<Case(const TomlValue &document, Diagnostics &diagnostics)>;

  /// The steps of @p document, whose other sections @p request holds already, each checked as a case of its own. Files in them start from
  /// @p folder.
  void read_steps(const TomlValue &document, const std::string &folder, const StepReader &read, Case &request, Diagnostics &diagnostics);

  /// Warns of what is set from outside (--set, a sweep) although steps set it, or the table it stands in, themselves.
  void warn_about_overrides_in_steps(const Case &request, const std::vector<Override> &overrides, Diagnostics &diagnostics);
} // namespace unilateral
