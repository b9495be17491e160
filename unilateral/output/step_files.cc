#include "unilateral/output/step_files.h"

#include "unilateral/output/result_files.h"
#include "unilateral/output/solution_files.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <limits>

namespace unilateral
{
  namespace
  {
    using StepsJson = nlohmann::ordered_json;

    StepsJson::json_pointer pointer_to(const std::string &path)
    {
      std::string pointer = "/" + path;
      std::replace(pointer.begin(), pointer.end(), '.', '/');
      return StepsJson::json_pointer(pointer);
    }

    /// Adds the paths of all numbers below @p path.
    void add_numbers_below(const StepsJson &step, const std::string &path, std::vector<std::string> &paths)
    {
      const auto pointer = pointer_to(path);
      if (!step.contains(pointer))
        return;
      const StepsJson &node = step.at(pointer);
      if (node.is_number())
        paths.push_back(path);
      else if (node.is_array())
        for (std::size_t i = 0; i < node.size(); ++i)
          add_numbers_below(step, fmt::format("{}.{}", path, i), paths);
      else if (node.is_object())
        for (const auto &entry : node.items())
          add_numbers_below(step, path + "." + entry.key(), paths);
    }

    bool is_step_folder(const std::string &name)
    {
      const std::string start = "step-";
      return name.starts_with(start) && name.size() > start.size() &&
             name.find_first_not_of("0123456789", start.size()) == std::string::npos;
    }
  } // namespace

  std::string folder_of_step(const std::size_t k, const std::size_t n_steps)
  {
    return fmt::format("step-{:0{}}", k + 1, std::max<std::size_t>(3, std::to_string(n_steps).size()));
  }

  namespace
  {
    /// Those that a step has a number for.
    std::vector<std::string> quantities_of_step(const StepsJson &first)
    {
      std::vector<std::string> paths;
      for (std::size_t c = 0; c < first.value("constraint", StepsJson::array()).size(); ++c)
        for (const char *const name :
             {"total_contact_force", "contact_force", "contact_measure", "max_contact_pressure", "max_penetration", "n_active"})
          add_numbers_below(first, fmt::format("constraint.{}.{}", c, name), paths);
      for (const char *const name : {"energy", "min", "max", "max_von_mises", "functionals"})
        add_numbers_below(first, fmt::format("solution.{}", name), paths);
      if (const auto probes = pointer_to("solution.probes"); first.contains(probes))
        for (std::size_t p = 0; p < first.at(probes).size(); ++p)
          add_numbers_below(first, fmt::format("solution.probes.{}.value", p), paths);
      for (std::size_t r = 0; r < first.value("reactions", StepsJson::array()).size(); ++r)
        for (const char *const name : {"force", "moment"})
          add_numbers_below(first, fmt::format("reactions.{}.{}", r, name), paths);
      for (const char *const block : {"platens", "periodic"})
        for (std::size_t p = 0; p < first.value(block, StepsJson::array()).size(); ++p)
          for (const char *const name : {"translation", "rotation", "force", "moment"})
            add_numbers_below(first, fmt::format("{}.{}.{}", block, p, name), paths);
      for (const char *const path : {"balance.reaction", "errors", "estimate.relative", "solver.newton_iterations", "timing.total"})
        add_numbers_below(first, path, paths);
      return paths;
    }
  } // namespace

  std::vector<std::string> quantities_of_steps(const StepsJson &steps)
  {
    std::vector<std::string> paths;
    if (!steps.is_array())
      return paths;
    // A number that is missing in one step, as an error relative to u = 0, may be there in others.
    for (const StepsJson &step : steps)
    {
      const auto of_step = quantities_of_step(step);
      if (paths.size() < of_step.size())
        paths = of_step;
    }
    return paths;
  }

  double quantity_of_step(const StepsJson &step, const std::string &path)
  {
    const auto pointer = pointer_to(path);
    return step.contains(pointer) && step.at(pointer).is_number() ? step.at(pointer).get<double>()
                                                                  : std::numeric_limits<double>::quiet_NaN();
  }

  std::string steps_to_csv(const StepsJson &steps)
  {
    const std::vector<std::string> paths = quantities_of_steps(steps);
    std::string                    text = "step";
    if (!steps.empty())
      for (const auto &value : steps[0]["parameters"].items())
        text += "," + csv_text(value.key());
    for (const std::string &path : paths)
      text += "," + csv_text(path);
    text += ",status\n";
    for (const StepsJson &step : steps)
    {
      text += step["number"].dump();
      for (const StepsJson &value : step["parameters"])
        text += "," + (value.is_null() ? std::string() : csv_text(value.is_string() ? value.get<std::string>() : value.dump()));
      for (const std::string &path : paths)
        if (const double number = quantity_of_step(step, path); std::isfinite(number))
          text += fmt::format(",{}", number);
        else
          text += ",";
      text += "," + step["status"].get<std::string>() + "\n";
    }
    return text;
  }

  std::vector<double> abscissa_of_steps(const StepsJson &steps, std::string &key)
  {
    std::vector<double> numbers;
    const StepsJson     values = steps.empty() ? StepsJson::object() : steps[0].value("parameters", StepsJson::object());
    for (const auto &entry : values.items())
    {
      numbers.clear();
      for (const StepsJson &step : steps)
      {
        const StepsJson value = step.value("parameters", StepsJson::object()).value(entry.key(), StepsJson());
        if (!value.is_number() || (!numbers.empty() && !(value.get<double>() > numbers.back())))
          break;
        numbers.push_back(value.get<double>());
      }
      key = entry.key();
      if (numbers.size() == steps.size())
        return numbers;
    }
    numbers.clear();
    for (std::size_t k = 0; k < steps.size(); ++k)
      numbers.push_back(k + 1);
    key = "step";
    return numbers;
  }

  namespace
  {
    namespace fs = std::filesystem;

    /// The files of a step, and their folder, if it holds no others.
    void remove_step(const fs::path &folder)
    {
      std::error_code       failure;
      std::vector<fs::path> files;
      for (const auto &file : fs::directory_iterator(folder, failure))
        if (const std::string name = file.path().filename().string();
            is_solution_file(name) || name == "results.json" || name == "report.html" || name == "picture.svg")
          files.push_back(file.path());
      for (const fs::path &path : files)
        fs::remove(path, failure);
      fs::remove(folder, failure);
    }
  } // namespace

  bool is_restart_file(const std::string &name)
  {
    return name == "restart.json" || (name.starts_with("restart-") && name.ends_with(".bin"));
  }

  void remove_restart(const std::string &directory)
  {
    std::error_code       failure;
    std::vector<fs::path> files;
    for (const auto &entry : fs::directory_iterator(directory, failure))
      if (is_restart_file(entry.path().filename().string()))
        files.push_back(entry.path());
    for (const fs::path &path : files)
      fs::remove(path, failure);
  }

  void remove_old_steps(const std::string &directory)
  {
    std::error_code failure;
    if (!fs::is_regular_file(fs::path(directory) / "step_history.csv", failure))
      return; // folders of that name may be others', those of a sweep for example
    remove_restart(directory);
    std::vector<fs::path> folders;
    for (const auto &entry : fs::directory_iterator(directory, failure))
      if (is_step_folder(entry.path().filename().string()) && fs::is_directory(entry.symlink_status(failure)))
        folders.push_back(entry.path());
    for (const fs::path &path : folders)
      remove_step(path);
    fs::remove(fs::path(directory) / "step_history.csv", failure);
  }

  void keep_steps(const std::size_t k, const std::size_t n_steps, const std::string &directory)
  {
    std::error_code          failure;
    std::vector<std::string> folders;
    for (const auto &entry : fs::directory_iterator(directory, failure))
      if (const std::string name = entry.path().filename().string();
          is_step_folder(name) && fs::is_directory(entry.symlink_status(failure)))
        folders.push_back(name);
    for (const std::string &name : folders)
    {
      const std::size_t number = std::stoul(name.substr(name.find('-') + 1));
      const fs::path    folder = fs::path(directory) / name;
      if (number > k)
        remove_step(folder);
      else if (number > 0)
        fs::rename(folder, fs::path(directory) / folder_of_step(number - 1, n_steps), failure);
    }
  }
} // namespace unilateral
