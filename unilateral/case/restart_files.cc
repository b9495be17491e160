#include "unilateral/case/restart_files.h"

#include "unilateral/base/sha256.h"
#include "unilateral/case/write_case.h"
#include "unilateral/output/result_files.h"
#include "unilateral/output/step_files.h"

#include <fmt/format.h>

#include <filesystem>
#include <fstream>
#include <utility>

namespace unilateral
{
  namespace
  {
    namespace files = std::filesystem;
    using RestartJson = nlohmann::ordered_json;

    constexpr int         restart_version = 1;
    constexpr const char *restart_file = "restart.json";
  } // namespace

  void write_restart_files(const std::string                &folder,
                           const std::size_t                 number,
                           RestartJson                       json,
                           const std::optional<std::string> &own_part,
                           const Processes                  &processes)
  {
    const auto part_name = [&](const unsigned process) { return fmt::format("restart-{}-{}.bin", number, process); };
    if (own_part)
      write_file_atomically((files::path(folder) / part_name(processes.rank())).string(), *own_part);
    std::vector<unsigned> parts;
    if (own_part)
      parts.push_back(processes.rank());
    parts = processes.gather(parts); // all are written
    if (processes.rank() > 0)
      return;
    json["version"] = restart_version;
    json["parts"] = RestartJson::array();
    for (const unsigned part : parts)
      json["parts"].push_back(part_name(part));
    write_file_atomically((files::path(folder) / restart_file).string(), json.dump());
    std::error_code          failure;
    std::vector<files::path> old;
    const std::string        current = fmt::format("restart-{}-", number);
    for (const auto &entry : files::directory_iterator(folder, failure))
      if (const std::string name = entry.path().filename().string();
          is_restart_file(name) && name != restart_file && !name.starts_with(current))
        old.push_back(entry.path());
    for (const files::path &path : old)
      files::remove(path, failure);
  }

  std::string hash_of_problem(const Case &request)
  {
    Case problem = request;
    problem.title.clear();
    problem.method = {};
    problem.expect.clear();
    problem.files = {};
    problem.mesh.adapt.reset();
    return sha256(expand(problem));
  }

  RestartJson read_restart_json(const std::string &folder)
  {
    std::ifstream file(files::path(folder) / restart_file);
    if (!file)
      throw cannot_resume(fmt::format("there is nothing to resume in '{}': no unfinished run has left what it takes there", folder));
    RestartJson json = RestartJson::parse(file, nullptr, /*allow_exceptions=*/false);
    if (!json.is_object() || json.value("version", RestartJson()) != restart_version || !json.contains("parts") ||
        !json["parts"].is_array())
      throw damaged_restart(folder);
    return json;
  }

  std::vector<std::string> restart_parts(const std::string &folder, const RestartJson &json)
  {
    std::vector<std::string> parts;
    for (const RestartJson &part : json["parts"])
    {
      const std::string name = part.is_string() ? part.get<std::string>() : "";
      if (!is_restart_file(name) || name.find('/') != std::string::npos)
        throw damaged_restart(folder);
      parts.push_back((files::path(folder) / name).string());
    }
    return parts;
  }

  InputError cannot_resume(const std::string &why)
  {
    return InputError(SourceLocation(), fmt::format("{}; run the case without --resume", why), MessageName("nothing-to-resume"));
  }

  InputError damaged_restart(const std::string &folder)
  {
    return cannot_resume(fmt::format("'{}/{}' is damaged or of another version", folder, restart_file));
  }
} // namespace unilateral
