// A run of a case as results.json, before and after it.
#pragma once

#include "unilateral/case/case.h"
#include "unilateral/output/results.h"

namespace unilateral
{
  /// results.json of a run of the case.
  nlohmann::ordered_json to_json(const RunResult &result, const Case &request);

  /// The same of a load history, with the block `steps` unless that is empty; the other blocks are those of the last step.
  nlohmann::ordered_json to_json(const RunResult &result, const Case &request, const nlohmann::ordered_json &steps);

  /// The entry of results.json for step @p k, from 0: its number, the values of whatever steps set, the numbers of its solution.
  nlohmann::ordered_json step_json(const RunResult &result, const Case &request, std::size_t k, double seconds);

  /// The keys that steps of @p request set, parameters by their names alone, in the order of their first use; and what they are in step @p
  /// k.
  std::vector<std::string> stepped_keys(const Case &request);
  nlohmann::ordered_json   stepped_values(const Case &request, std::size_t k);

  /// What results.json of a run of this case will hold, with no number in its place: for who asks for one before anything is solved.
  /// Without `case` and `expect`.
  nlohmann::ordered_json blank_json(const Case &request);
} // namespace unilateral
