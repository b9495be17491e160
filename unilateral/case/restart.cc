#include "unilateral/case/restart.h"

#include "unilateral/base/sha256.h"
#include "unilateral/case/load_steps.h"
#include "unilateral/case/write_case.h"
#include "unilateral/functions/cell_functions_file.h"
#include "unilateral/output/result_files.h"
#include "unilateral/output/step_files.h"

#include <fmt/format.h>

#include <filesystem>
#include <fstream>
#include <stdexcept>
#include <vector>

namespace unilateral
{
  namespace fs = std::filesystem;
  using Json = nlohmann::ordered_json;

  namespace
  {
    constexpr int         version = 1;
    constexpr const char *restart_file = "restart.json";

    std::string part_name(const std::size_t n_steps, const unsigned process)
    {
      return fmt::format("restart-{}-{}.bin", n_steps, process);
    }

    /// Of what a step is: its case as it stands in a file, but for the title. What files that it names contain is not looked at.
    std::string hash_of(const Case &request, const std::size_t k)
    {
      Case single = case_of_step(request, k);
      single.title.clear();
      return sha256(expand(single));
    }

    InputError refusal(const std::string &message)
    {
      return InputError(SourceLocation(), message, MessageName("nothing-to-resume"));
    }

    Json read_json(const std::string &folder)
    {
      std::ifstream file(fs::path(folder) / restart_file);
      if (!file)
        throw refusal(fmt::format(
          "there is nothing to resume in '{}': no load history was left there unfinished; run the case without --resume", folder));
      Json       json = Json::parse(file, nullptr, /*allow_exceptions=*/false);
      const bool good = json.is_object() && json.value("version", Json()) == version && json.contains("cases") &&
                        json["cases"].is_array() && json.contains("steps") && json["steps"].is_array() &&
                        json["cases"].size() == json["steps"].size() && json.contains("parts") && json["parts"].is_array() &&
                        !json["steps"].empty();
      if (!good)
        throw refusal(fmt::format("'{}/{}' is damaged or of another version; run the case without --resume", folder, restart_file));
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
    const bool        first = processes.rank() == 0;
    const std::string own = part_name(before.n(), processes.rank());
    if (before.previous && has_part)
      write_file_atomically((fs::path(folder) / own).string(), to_bytes(*before.previous));
    std::vector<unsigned> parts;
    if (before.previous && has_part)
      parts.push_back(processes.rank());
    parts = processes.gather(parts); // all are written
    for (std::size_t k = before.cases.size(); k < before.n(); ++k)
      before.cases.push_back(hash_of(request, k));
    if (!first)
      return;
    Json json = {
      {"version", version}, {"cases", before.cases}, {"all_meet", before.all_meet}, {"steps", before.steps}, {"parts", Json::array()}};
    for (const unsigned part : parts)
      json["parts"].push_back(part_name(before.n(), part));
    write_file_atomically((fs::path(folder) / restart_file).string(), json.dump());
    std::error_code       failure;
    std::vector<fs::path> old;
    const std::string     current = fmt::format("restart-{}-", before.n());
    for (const auto &entry : fs::directory_iterator(folder, failure))
      if (const std::string name = entry.path().filename().string();
          is_restart_file(name) && name != restart_file && !name.starts_with(current))
        old.push_back(entry.path());
    for (const fs::path &path : old)
      fs::remove(path, failure);
  }

  StepsBefore read_restart(const std::string &folder, const Case &request)
  {
    const Json  json = read_json(folder);
    StepsBefore before;
    before.steps = json["steps"];
    before.all_meet = json.value("all_meet", Json(true)) == true;
    if (before.n() >= request.steps.size())
      throw refusal(
        fmt::format("there is nothing to resume: '{}' has {} steps, and the case {}", folder, before.n(), request.steps.size()));
    for (std::size_t k = 0; k < before.n(); ++k)
    {
      before.cases.push_back(hash_of(request, k));
      if (json["cases"][k] != before.cases.back())
        throw refusal(fmt::format("step {} of the case is not the one that '{}' has: steps that were solved must stay as they are; run the "
                                  "case without --resume",
                                  k + 1, folder));
    }
    std::vector<std::string> parts;
    for (const Json &part : json["parts"])
    {
      const std::string name = part.is_string() ? part.get<std::string>() : "";
      if (!is_restart_file(name) || name.find('/') != std::string::npos)
        throw refusal(fmt::format("'{}/{}' is damaged; run the case without --resume", folder, restart_file));
      parts.push_back((fs::path(folder) / name).string());
    }
    if (parts.empty() && uses_step_before(request))
      throw refusal(
        fmt::format("'{}' has no solution of step {}, which the next one takes; run the case without --resume", folder, before.n()));
    try
    {
      if (!parts.empty())
        before.previous = read_cell_functions(parts);
    }
    catch (const std::runtime_error &e)
    {
      throw refusal(fmt::format("{}; run the case without --resume", e.what()));
    }
    return before;
  }
} // namespace unilateral
