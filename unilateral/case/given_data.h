// Functions and meshes that a program hands over beside the text of a case.
#pragma once

#include "unilateral/case/case.h"
#include "unilateral/case/toml_document.h"

namespace unilateral
{
  /// Replaces each table { given = NUMBER } of @p document, where a function may stand, by the function of that number. A number without a
  /// function is an error: such a case has been stated by a program and cannot be read from a file alone.
  void insert_given_functions(TomlValue &document, const GivenData &given, Diagnostics &diagnostics);
} // namespace unilateral
