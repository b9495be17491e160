// What a run is worth, item by item: the number, what it is held against, and what to do where it falls short.
#pragma once

#include <nlohmann/json_fwd.hpp>

#include <string>
#include <vector>

namespace unilateral
{
  struct VerdictItem
  {
    enum class Kind
    {
      good,
      doubtful,
      bad
    };
    Kind        kind = Kind::good;
    std::string what, number, threshold, next; ///< plain texts
  };

  /// From results.json; what it does not hold is left out.
  std::vector<VerdictItem> verdict_of(const nlohmann::ordered_json &results);

  /// One sentence: "solved; mesh error about 0.7 % (estimated), penalty and solver at most 2e-06 (guaranteed)".
  std::string verdict_sentence(const nlohmann::ordered_json &results);
} // namespace unilateral
