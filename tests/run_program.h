// The examples solved by the program, with other settings where a test wants them.
#pragma once

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <map>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

#include <sys/wait.h>

namespace verification
{
  using Json = nlohmann::json;
  using Settings = std::vector<std::string>; ///< KEY=VALUE

  /// results.json of examples/@p name.toml with @p settings. The case's own [[expect]] belong to its own mesh: they may fail.
  inline const Json &solve_example(const std::string &name, const Settings &settings)
  {
    static std::map<std::pair<std::string, Settings>, Json> known;
    if (const auto it = known.find({name, settings}); it != known.end())
      return it->second;

    std::string folder = (std::filesystem::temp_directory_path() / "unilateral-verification-XXXXXX").string();
    if (mkdtemp(folder.data()) == nullptr)
      throw std::runtime_error("no temporary folder");
    std::string command = "'" PROGRAM "' run '" PROJECT_DIR "/examples/" + name + ".toml' --json -q -o '" + folder + "'";
    for (const auto &setting : settings)
      command += " --set '" + setting + "'";
    command += " 2> '" + folder + "/err'";
    FILE       *pipe = popen(command.c_str(), "r");
    std::string text;
    char        buffer[4096];
    for (std::size_t n; pipe && (n = fread(buffer, 1, sizeof buffer, pipe)) > 0;)
      text.append(buffer, n);
    const int          status = pipe ? pclose(pipe) : -1;
    std::ostringstream messages;
    messages << std::ifstream(folder + "/err").rdbuf();
    std::filesystem::remove_all(folder);
    const int exit_code = WIFEXITED(status) ? WEXITSTATUS(status) : -1;
    if (exit_code != 0 && exit_code != 4)
      throw std::runtime_error(command + "\nexit code " + std::to_string(exit_code) + "\n" + messages.str());
    Json results = Json::parse(text);
    EXPECT_EQ(results["status"], "converged") << command;
    return known[{name, settings}] = std::move(results);
  }

  /// The same with the mixed method: what remains is the error of the discretisation.
  inline const Json &
  solve_mixed(const std::string &name, const unsigned refine, const std::string &element = "Q1", const Settings &more = {})
  {
    Settings settings = {"method.formulation=mixed", "mesh.refine=" + std::to_string(refine), "model.element=" + element};
    settings.insert(settings.end(), more.begin(), more.end());
    return solve_example(name, settings);
  }

  /// A number by its path, "errors/H1_semi".
  inline double number(const Json &results, const std::string &path)
  {
    return results.at(Json::json_pointer("/" + path)).get<double>();
  }

  /// Products with A on a level before the certificate, smoothing steps and residuals of its V-cycles included, without the finest level.
  inline unsigned most_applications(const Json &results)
  {
    unsigned    most = 0;
    const auto &levels = results["solver"]["levels"];
    for (std::size_t l = 0; l + 1 < levels.size(); ++l)
      most = std::max(most, levels[l]["operator_applications"].get<unsigned>());
    return most;
  }

  inline unsigned most_newton_steps(const Json &results)
  {
    unsigned most = 0;
    for (const auto &level : results["solver"]["levels"])
      most = std::max(most, level["newton_iterations"].get<unsigned>());
    return most;
  }
} // namespace verification
