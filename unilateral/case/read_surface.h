// Surfaces of rigid obstacles as they stand in a case file: plane, sphere, cylinder, STL file.
#pragma once

#include "unilateral/case/table_reader.h"
#include "unilateral/functions/surface_description.h"

#include <optional>
#include <string>

namespace unilateral
{
  /// @p value is a table with one of the keys plane, sphere, cylinder and stl; whether read_surface() or read_field() is to read it.
  bool is_surface(const TomlValue &value);

  /// The surface that @p value describes, called @p name in messages; nothing, with an error, when anything is wrong with it. One of
  ///   { plane = { point = [0, 0], normal = [0, 1] } }
  ///   { sphere = { center = [0, -1], radius = 1, inside = false } }
  ///   { cylinder = { point = [0, 0, 0], axis = [0, 1, 0], radius = 1, inside = false } }    3-D
  ///   { stl = "tool.stl", scale = 1, shift = [0, 0, 0] }    3-D; relative paths start from @p folder
  /// With @p dim = 0, when the dimension is not known, coordinates are not counted. Does not open files.
  std::optional<SurfaceDescription>
  read_surface(const TomlValue &value, const std::string &name, unsigned dim, const std::string &folder, Diagnostics &diagnostics);

  /// @p spec as TOML that read_surface() understands, defaults included.
  std::string surface_text(const SurfaceDescription &spec);
} // namespace unilateral
