// What the system can still give out.
#pragma once

#include <optional>

namespace unilateral
{
  /// In bytes; nothing where the system does not say.
  std::optional<double> available_memory();
} // namespace unilateral
