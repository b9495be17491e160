// TOML <-> Case. Every error at once, each at file:line:column.
#pragma once

#include "unilateral/case/case.h"

#include <string>
#include <utility>
#include <vector>

namespace unilateral
{
  /// An override from the command line, e.g. {"mesh.refine", "6"}, {"constraint.0.lower", "\"x^2\""}; the value is TOML, or else taken as a
  /// string.
  using Override = std::pair<std::string, std::string>;

  /// Reads and checks the case at @p path. Warnings go to @p diagnostics.
  /// Throws InputError with all errors: TOML syntax, unknown keys, types, ranges, expressions, files.
  Case read_case(const std::string &path, const std::vector<Override> &overrides, Diagnostics &diagnostics);

  /// The same from a text already in memory; relative paths are taken from the folder of @p path.
  Case parse_case(const std::string &text, const std::string &path, const std::vector<Override> &overrides, Diagnostics &diagnostics);

  /// The case as TOML with every default written out and paths absolute; reading it again gives the same Case.
  std::string expand(const Case &request);
} // namespace unilateral
