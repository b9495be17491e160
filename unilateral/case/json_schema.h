// The specification of the case file as a JSON Schema (draft 7), for editors: hover texts, completion, mistakes as they are typed.
#pragma once

#include <nlohmann/json_fwd.hpp>

namespace unilateral
{
  /// Accepts whatever the reader accepts, and refuses what can be refused without a mesh and without reading expressions.
  nlohmann::ordered_json json_schema();
} // namespace unilateral
