// TOML -> Case. Every error at once, each at file:line:column.
#pragma once

#include "unilateral/case/case.h"
#include "unilateral/case/toml_document.h"

#include <string>
#include <vector>

namespace unilateral
{
  /// Reads and checks the case at @p path. Warnings go to @p diagnostics.
  /// Throws InputError with all errors: TOML syntax, unknown keys, types, ranges, expressions, files.
  /// @p given: what stands in the overrides by its number alone, see GivenData.
  Case read_case(const std::string &path, const std::vector<Override> &overrides, Diagnostics &diagnostics, const GivenData &given = {});

  /// The same from a text already in memory; relative paths are taken from the folder of @p path.
  Case parse_case(const std::string           &text,
                  const std::string           &path,
                  const std::vector<Override> &overrides,
                  Diagnostics                 &diagnostics,
                  const GivenData             &given = {});
} // namespace unilateral
