#include "unilateral/case/restart.h"

#include "unilateral/base/sha256.h"
#include "unilateral/case/load_steps.h"
#include "unilateral/case/restart_files.h"
#include "unilateral/case/write_case.h"
#include "unilateral/functions/cell_functions_file.h"

#include <fmt/format.h>

#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

namespace unilateral
{
  using Json = nlohmann::ordered_json;

  namespace
  {
    /// Of what a step is: its case as it stands in a file, but for the title. What files that it names contain is not looked at.
    std::string hash_of(const Case &request, const std::size_t k)
    {
      Case single = case_of_step(request, k);
      single.title.clear();
      return sha256(expand(single));
    }

    Json read_json(const std::string &folder)
    {
      Json json = read_restart_json(folder);
      if (json.contains("mesh") || json.contains("level"))
        throw cannot_resume(fmt::format("what was left unfinished in '{}' is a run without steps", folder));
      const bool good = json.contains("cases") && json["cases"].is_array() && json.contains("steps") && json["steps"].is_array() &&
                        json["cases"].size() == json["steps"].size() && !json["steps"].empty();
      if (!good)
        throw damaged_restart(folder);
      return json;
    }
  } // namespace

  bool uses_step_before(const Case &request)
  {
    // The text of a case is small, and only what names it has the word.
    return expand(request).find("previous = ") != std::string::npos;
  }

  void write_restart(const std::string &folder, const Case &request, StepsBefore &before, const bool has_part, const Processes &processes)
  {
    std::optional<std::string> own;
    if (before.previous && has_part)
      own = to_bytes(*before.previous);
    for (std::size_t k = before.cases.size(); k < before.n(); ++k)
      before.cases.push_back(hash_of(request, k));
    write_restart_files(folder, before.n(), {{"cases", before.cases}, {"all_meet", before.all_meet}, {"steps", before.steps}}, own,
                        processes);
  }

  StepsBefore read_restart(const std::string &folder, const Case &request)
  {
    const Json  json = read_json(folder);
    StepsBefore before;
    before.steps = json["steps"];
    before.all_meet = json.value("all_meet", Json(true)) == true;
    if (before.n() >= request.steps.size())
      throw cannot_resume(
        fmt::format("there is nothing to resume: '{}' has {} steps, and the case {}", folder, before.n(), request.steps.size()));
    for (std::size_t k = 0; k < before.n(); ++k)
    {
      before.cases.push_back(hash_of(request, k));
      if (json["cases"][k] != before.cases.back())
        throw cannot_resume(
          fmt::format("step {} of the case is not the one that '{}' has: steps that were solved must stay as they are", k + 1, folder));
    }
    const std::vector<std::string> parts = restart_parts(folder, json);
    if (parts.empty() && uses_step_before(request))
      throw cannot_resume(fmt::format("'{}' has no solution of step {}, which the next one takes", folder, before.n()));
    try
    {
      if (!parts.empty())
        before.previous = read_cell_functions(parts);
    }
    catch (const std::runtime_error &e)
    {
      throw cannot_resume(e.what());
    }
    return before;
  }
} // namespace unilateral
