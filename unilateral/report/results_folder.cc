#include "unilateral/report/results_folder.h"

#include "unilateral/base/diagnostics.h"
#include "unilateral/output/vtu_reader.h"

#include <fmt/format.h>

#include <cerrno>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <sstream>

namespace unilateral
{
  namespace
  {
    namespace fs = std::filesystem;

    std::string text_of(const fs::path &path)
    {
      std::ifstream      in(path, std::ios::binary);
      const int          reason = errno;
      std::ostringstream text;
      if (in)
        text << in.rdbuf();
      else if (std::error_code failure; fs::exists(path, failure))
        throw InputError({path.string(), 0, 0}, fmt::format("the file cannot be opened: {}", std::strerror(reason)),
                         MessageName("file-not-found"));
      return std::move(text).str();
    }

    std::optional<ResultsFolder::Json> json_in(const fs::path &path)
    {
      std::error_code failure;
      if (!fs::is_regular_file(path, failure))
        return {};
      const auto json = ResultsFolder::Json::parse(text_of(path), nullptr, false);
      if (!json.is_object())
        throw InputError({path.string(), 0, 0}, "this is not JSON; compute the results anew", MessageName("file-damaged"));
      return json;
    }

    VtuGrid grid_in(const fs::path &directory, const std::string &name)
    {
      std::error_code failure;
      for (const char *const ending : {".vtu", ".pvtu"})
        if (const fs::path path = directory / (name + ending); fs::is_regular_file(path, failure))
          return read_vtu(path.string());
      return {};
    }
  } // namespace

  ResultsFolder read_results(const std::string &directory, const bool with_fields)
  {
    const fs::path  folder = directory;
    std::error_code failure;
    if (!fs::is_directory(folder, failure))
      throw InputError({directory, 0, 0}, "there is no such folder; give the folder that a run has written, membrane.out for example",
                       MessageName("file-not-found"));
    ResultsFolder found;
    found.results = json_in(folder / "results.json");
    found.sweep = json_in(folder / "sweep.json");
    found.take_studies_of(directory);
    if (!found.results && !found.sweep && !found.study_epsilon && !found.study_mesh && !found.study_quadrature && !found.infsup)
      throw InputError({directory, 0, 0}, "the folder holds no results (results.json, sweep.json, study_*.json or infsup.json)",
                       MessageName("file-not-found"));
    found.log = text_of(folder / "run.log");
    if (with_fields && found.results)
    {
      found.solution = grid_in(folder, "solution");
      found.points = grid_in(folder, "constraint-points");
    }
    return found;
  }

  void ResultsFolder::take_studies_of(const std::string &directory)
  {
    const fs::path  folder = directory;
    std::error_code failure;
    name = fs::weakly_canonical(folder, failure).filename().string();
    study_epsilon = json_in(folder / "study_epsilon.json");
    study_mesh = json_in(folder / "study_mesh.json");
    study_quadrature = json_in(folder / "study_quadrature.json");
    infsup = json_in(folder / "infsup.json");
    csv.clear();
    for (const char *const file :
         {"sweep.csv", "step_history.csv", "study_epsilon.csv", "study_mesh.csv", "study_quadrature.csv", "infsup.csv"})
      if (std::string text = text_of(folder / file); !text.empty())
        csv.emplace_back(file, std::move(text));
  }

  std::string ResultsFolder::title() const
  {
    // The title stands in the expanded case; its first line, if it has one.
    for (const auto *const json : {&results, &study_epsilon, &study_mesh, &study_quadrature, &infsup, &sweep})
      if (const Json::json_pointer title("/case/title"); *json && (*json)->contains(title) && (*json)->at(title).is_string())
        if (std::string text = (*json)->at(title); !text.empty())
          return text;
    return name;
  }
} // namespace unilateral
