#include "unilateral/case/level_restart.h"

#include "unilateral/case/restart_files.h"
#include "unilateral/functions/cell_functions_file.h"

#include <fmt/format.h>

#include <stdexcept>

namespace unilateral
{
  namespace
  {
    /// Of what all levels have in common.
    std::string hash_of_levels(const Case &request)
    {
      Case any_levels = request;
      if (request.mesh.local.empty()) // else the number of a level depends on it
        any_levels.mesh.refine = 0;
      return hash_of_problem(any_levels);
    }
  } // namespace

  void write_level_restart(const std::string &folder, const Case &request, const FormerLevel &former, const Processes &processes)
  {
    write_restart_files(folder, former.level, {{"level", former.level}, {"case", hash_of_levels(request)}}, to_bytes(*former.functions),
                        processes);
  }

  FormerLevel read_level_restart(const std::string &folder, const Case &request)
  {
    const auto json = read_restart_json(folder);
    if (!json.contains("level") || !json["level"].is_number_unsigned())
      throw cannot_resume(fmt::format("what was left unfinished in '{}' is a load history, or refinement by the error, and the case has no "
                                      "steps and no adapt in [mesh]",
                                      folder));
    if (json.value("case", nlohmann::ordered_json()) != hash_of_levels(request))
      throw cannot_resume(fmt::format("the level that was left unfinished in '{}' is that of another case", folder));
    FormerLevel former;
    former.level = json["level"];
    if (former.level > request.mesh.n_refinements())
      throw cannot_resume(fmt::format("the run in '{}' had come to level {}, finer than what the case asks for", folder, former.level));
    try
    {
      former.functions = read_cell_functions(restart_parts(folder, json));
    }
    catch (const std::runtime_error &e)
    {
      throw cannot_resume(e.what());
    }
    return former;
  }
} // namespace unilateral
