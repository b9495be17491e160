// Functions of position as they stand in a case file: numbers, expressions, rasters, profiles.
#pragma once

#include "unilateral/case/case.h"
#include "unilateral/case/table_reader.h"

#include <optional>
#include <string>
#include <vector>

namespace unilateral
{
  /// @p file as an absolute path; relative ones start from @p folder. A path with a leading / stays.
  std::string absolute_path(const std::string &file, const std::string &folder);

  /// The function that @p value describes, called @p name in messages; nothing, with an error, when it is none.
  /// Neither compiles expressions nor opens files.
  std::optional<FieldSpec> read_field(const TomlValue &value, const std::string &name, const std::string &folder, Diagnostics &diagnostics);

  /// A list of functions.
  std::optional<std::vector<FieldSpec>>
  read_fields(const TomlValue &value, const std::string &name, const std::string &folder, Diagnostics &diagnostics);

  /// The list of @p dim functions that are the components of a vector, called @p key in messages; in 1-D also a single one. With @p dim =
  /// 0, when the dimension is not known, they are not counted.
  std::optional<std::vector<FieldSpec>>
  read_components(const TomlValue &value, const std::string &key, unsigned dim, const std::string &folder, Diagnostics &diagnostics);
} // namespace unilateral
