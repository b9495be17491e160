// What an unfinished load history leaves, so that another run goes on after the last step.
#pragma once

#include "unilateral/base/processes.h"
#include "unilateral/case/case.h"
#include "unilateral/functions/cell_functions.h"

#include <nlohmann/json.hpp>

#include <cstddef>
#include <memory>
#include <string>
#include <vector>

namespace unilateral
{
  /// Steps that have been solved: their entries in `steps` of results.json, and the solution of the last one, where the case uses it.
  struct StepsBefore
  {
    nlohmann::ordered_json               steps = nlohmann::ordered_json::array();
    std::vector<std::string>             cases; ///< a hash of each step as it stands in a file; write_restart() adds what is missing
    std::shared_ptr<const CellFunctions> previous;
    bool                                 all_meet = true; ///< each the tolerances that the case asks for

    std::size_t n() const { return steps.size(); }
  };

  /// Some field of the case is the solution of the step before.
  bool uses_step_before(const Case &request);

  /// Writes restart.json and, for the solution, restart-N-P.bin of each process P that has a part of it, into @p folder: whoever looks
  /// finds the files of this step or those of one before. @p has_part: of this process. Collective. Throws std::runtime_error.
  void write_restart(const std::string &folder, const Case &request, StepsBefore &before, bool has_part, const Processes &processes);

  /// Those steps, for any number of processes. Throws InputError: no such files, damaged ones, or steps of another case.
  StepsBefore read_restart(const std::string &folder, const Case &request);
} // namespace unilateral
