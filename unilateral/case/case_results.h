// A run of a case as results.json, before and after it.
#pragma once

#include "unilateral/case/case.h"
#include "unilateral/output/results.h"

namespace unilateral
{
  /// results.json of a run of the case.
  nlohmann::ordered_json to_json(const RunResult &result, const Case &request);

  /// What results.json of a run of this case will hold, with no number in its place: for who asks for one before anything is solved.
  /// Without `case` and `expect`.
  nlohmann::ordered_json blank_json(const Case &request);
} // namespace unilateral
