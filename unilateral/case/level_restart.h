// What an unfinished run with meshes that are refined as a whole leaves, so that another run goes on from the level it had come to.
#pragma once

#include "unilateral/base/processes.h"
#include "unilateral/case/case.h"
#include "unilateral/functions/former_level.h"

#include <string>

namespace unilateral
{
  /// Writes restart.json and, with the own part of @p former, restart-N-P.bin of each process P, N its level, into @p folder. Collective.
  /// Throws std::runtime_error.
  void write_level_restart(const std::string &folder, const Case &request, const FormerLevel &former, const Processes &processes);

  /// The functions on the whole mesh, for any number of processes. Throws InputError: no such files, damaged ones, or those of another
  /// case. The method, title, files and expectations may be others, and there may be more refinements.
  FormerLevel read_level_restart(const std::string &folder, const Case &request);
} // namespace unilateral
