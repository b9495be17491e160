// A run as results.json.
#pragma once

#include "unilateral/evaluation/run_result.h"

#include <nlohmann/json_fwd.hpp>

#include <string>
#include <vector>

namespace unilateral
{
  /// The case file that a problem comes from.
  struct CaseSource
  {
    std::string              path;     ///< absolute
    std::string              sha256;   ///< of the file's bytes
    std::string              title;    ///< for people, may be empty
    std::vector<std::string> settings; ///< "KEY=VALUE", what the command line said otherwise
  };

  /// The `case` block of a file of results.
  nlohmann::ordered_json to_json(const CaseSource &source);

  /// results.json; key order as in the documentation. NaN and infinity become null. Times, those of the levels too, are in `timing` alone,
  /// so that two runs differ in `timing` and `memory` only.
  nlohmann::ordered_json to_json(const RunResult &result, const CaseSource &source, const std::string &expanded);

  /// The part of it that is measured: without `status`, `case` and `expect`.
  nlohmann::ordered_json numbers_json(const RunResult &result);

  /// The `errors` block: the norms that are there.
  nlohmann::ordered_json to_json(const Errors &errors);

  /// `program`: name, versions, what it was built for and on how many processes it runs.
  nlohmann::ordered_json program_json(unsigned n_processes);

  /// The text of a JSON file: two-space indent, a newline at the end; bytes that are not UTF-8 are replaced.
  std::string to_text(const nlohmann::ordered_json &json);

  /// The most memory that this process had so far.
  double peak_bytes();
} // namespace unilateral
