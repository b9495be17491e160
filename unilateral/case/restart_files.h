// The files that an unfinished run leaves for another one, whatever they hold.
#pragma once

#include "unilateral/base/diagnostics.h"
#include "unilateral/base/processes.h"
#include "unilateral/case/case.h"

#include <nlohmann/json.hpp>

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

namespace unilateral
{
  /// Writes restart-N-P.bin with @p own_part of each process P that has one, N = @p number, then restart.json with @p json, a version and
  /// their names, and removes those of other numbers: whoever looks finds files that belong to each other. Collective. Throws
  /// std::runtime_error.
  void write_restart_files(const std::string                &folder,
                           std::size_t                       number,
                           nlohmann::ordered_json            json,
                           const std::optional<std::string> &own_part,
                           const Processes                  &processes);

  /// Of what a case without steps solves and what its mesh is refined for: not of its title, method, files and expectations, nor of the
  /// numbers and the goal of `adapt`.
  std::string hash_of_problem(const Case &request);

  /// What restart.json holds. Throws InputError: there is none, or it is damaged or of another version.
  nlohmann::ordered_json read_restart_json(const std::string &folder);

  /// The paths of the parts. Throws InputError where names are none.
  std::vector<std::string> restart_parts(const std::string &folder, const nlohmann::ordered_json &json);

  /// "...; run the case without --resume"
  InputError cannot_resume(const std::string &why);
  InputError damaged_restart(const std::string &folder);
} // namespace unilateral
