// Small helpers for the JSON of results.
#pragma once

#include <nlohmann/json.hpp>

#include <optional>

namespace unilateral
{
  /// The value, or null.
  template <typename T>
  nlohmann::ordered_json or_null(const std::optional<T> &value)
  {
    return value ? nlohmann::ordered_json(*value) : nlohmann::ordered_json(nullptr);
  }
} // namespace unilateral
