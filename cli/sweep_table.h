// What a sweep varies, its steps, and the table that comes of them.
#pragma once

#include "unilateral/output/results.h"

#include <nlohmann/json.hpp>

#include <string>
#include <vector>

namespace unilateral
{
  /// A key of the case and the values it takes in turn.
  struct SweepAxis
  {
    std::string              key;
    std::vector<std::string> values; ///< TOML, or taken as strings
  };

  /// "KEY=FROM:TO:N", N values of equal distance, or "KEY=A,B,C". Throws InputError with what is wrong.
  SweepAxis parse_sweep_axis(const std::string &text);

  /// One run of a sweep.
  struct SweepStep // NOLINT(bugprone-exception-escape): moves of JSON do not throw
  {
    std::string              folder;
    std::vector<std::string> values; ///< by axis
    int                      exit_code = -1;
    double                   seconds = 0;
    std::string              message; ///< why it failed
    nlohmann::ordered_json   results;
  };

  /// All combinations of values, the first axis slowest, in folders step-001, ... Throws InputError when they are too many.
  std::vector<SweepStep> all_combinations(const std::vector<SweepAxis> &axes);

  /// "solved", "not converged", ...
  const char *status_of(const SweepStep &step);

  /// What a table of runs shows when nothing is asked for.
  std::vector<std::string> default_quantities(const std::vector<SweepStep> &steps);

  /// The keys whose values make no difference to any of the quantities, other keys alike.
  std::vector<std::string>
  keys_without_effect(const std::vector<SweepStep> &steps, const std::vector<SweepAxis> &axes, const std::vector<std::string> &quantities);

  /// sweep.json, of the case with the first value of each key.
  nlohmann::ordered_json sweep_json(const CaseSource               &first,
                                    const std::vector<SweepStep>   &steps,
                                    const std::vector<SweepAxis>   &axes,
                                    const std::vector<std::string> &quantities);

  /// The rows as CSV.
  std::string
  sweep_csv(const std::vector<SweepStep> &steps, const std::vector<SweepAxis> &axes, const std::vector<std::string> &quantities);
} // namespace unilateral
