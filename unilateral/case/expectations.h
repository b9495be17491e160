// [[expect]]: are the numbers of a run what the case says they must be?
#pragma once

#include "unilateral/case/case.h"

#include <nlohmann/json_fwd.hpp>

#include <string>
#include <vector>

namespace unilateral
{
  /// "solution.energy = -0.25, expected -0.3 +- 0.01"; ">= 0", "<= 1" for bounds.
  std::string to_string(const ExpectationResult &expectation);

  /// Looks up every [[expect]] in the JSON and fills result.expect; true when all hold.
  /// A quantity is a path of keys and array indices, "solution.probes.0.value"; one that does not exist fails and says what does.
  bool evaluate_expectations(RunResult &result, const Case &request);

  /// The same of a load history; @p steps: what results.json says of its steps, see solve_history().
  bool evaluate_expectations(RunResult &result, const Case &request, const nlohmann::ordered_json &steps);

  /// Before anything is solved: an [[expect]] whose quantity is none of the numbers that a run of this case gives is an error at its
  /// place. Where the case has other errors, so that parts of it could not be read, what may lie in those parts is let pass.
  void check_expectations(const Case &request, Diagnostics &diagnostics);

  /// The same for quantities that are asked for on the command line.
  void check_quantities(const Case &request, const std::vector<std::string> &quantities, Diagnostics &diagnostics);

  /// Every [[expect]] that failed, as an error at its place.
  std::vector<Diagnostic> failed_expectations(const RunResult &result);
} // namespace unilateral
