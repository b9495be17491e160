#include "cli/sweep_table.h"

#include "cli/options.h"

#include "unilateral/base/diagnostics.h"
#include "unilateral/base/processes.h"
#include "unilateral/case/toml_document.h"
#include "unilateral/output/result_files.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <map>
#include <sstream>

namespace unilateral
{
  namespace
  {
    using SweepJson = nlohmann::ordered_json;

    constexpr std::size_t most_runs = 10000;

    /// A number where the text is one, as JSON has it.
    SweepJson as_json(const std::string &text)
    {
      char        *end = nullptr;
      const double value = std::strtod(text.c_str(), &end);
      if (!text.empty() && *end == 0 && std::isfinite(value))
        return value == std::floor(value) && std::abs(value) < 1e15 && text.find_first_of(".eE") == std::string::npos
                 ? SweepJson(long(value))
                 : SweepJson(value);
      if (text == "true" || text == "false")
        return text == "true";
      return text;
    }

    SweepJson quantity_of(const SweepStep &step, const std::string &path)
    {
      std::string pointer;
      for (const std::string &word : split_path(path))
        pointer += "/" + word;
      const SweepJson::json_pointer place(pointer);
      return step.results.is_object() && step.results.contains(place) && step.results.at(place).is_primitive() ? step.results.at(place)
                                                                                                               : SweepJson();
    }

    bool is_number(const std::string &text)
    {
      char *end = nullptr;
      std::strtod(text.c_str(), &end);
      return !text.empty() && *end == 0;
    }

    /// "1:2", "1:2:x", "a:2:3": numbers beside a colon that belongs neither to a string nor to a choice, c ? a : b.
    bool is_half_a_range(const std::string &values)
    {
      if (values.find(':') == std::string::npos || values.find_first_of("?\"'[{") != std::string::npos)
        return false;
      std::istringstream pieces(values);
      for (std::string piece; std::getline(pieces, piece, ':');)
        if (is_number(piece))
          return true;
      return false;
    }

    std::string csv_number(const SweepJson &value)
    {
      return value.is_string() ? value.get<std::string>() : value.is_null() ? "" : value.dump();
    }
  } // namespace

  std::vector<SweepStep> all_combinations(const std::vector<SweepAxis> &axes)
  {
    std::size_t n = 1;
    for (const SweepAxis &axis : axes)
    {
      n *= axis.values.size();
      if (n > most_runs)
        throw InputError({"--over", 0, 0}, fmt::format("these are more than {} runs; take fewer values", most_runs),
                         MessageName("bad-option"));
    }
    std::vector<SweepStep> steps(n);
    for (std::size_t k = 0; k < n; ++k)
    {
      steps[k].folder = fmt::format("step-{:0{}}", k + 1, std::max<std::size_t>(3, std::to_string(n).size()));
      std::size_t rest = k;
      steps[k].values.resize(axes.size());
      for (std::size_t a = axes.size(); a-- > 0; rest /= axes[a].values.size())
        steps[k].values[a] = axes[a].values[rest % axes[a].values.size()];
    }
    return steps;
  }

  SweepAxis parse_sweep_axis(const std::string &text)
  {
    const SourceLocation where{"--over", 0, 0};
    const std::size_t    equals = text.find('=');
    if (equals == std::string::npos || equals == 0 || equals + 1 == text.size())
      throw InputError(where, fmt::format("KEY=FROM:TO:N or KEY=A,B,C is wanted, e.g. --over mesh.refine=2,3,4, not '{}'", text),
                       MessageName("bad-option"));
    SweepAxis         axis{.key = text.substr(0, equals), .values = {}};
    const std::string values = text.substr(equals + 1);
    double            from = 0, to = 0;
    unsigned          n = 0;
    int               end = 0;
    if (std::sscanf(values.c_str(), "%lf:%lf:%u%n", &from, &to, &n, &end) == 3 && std::size_t(end) == values.size())
    {
      if (n < 1 || n > most_runs || !std::isfinite(from) || !std::isfinite(to))
        throw InputError(where, fmt::format("'{}' asks for {} values; 1 to {} are possible", text, n, most_runs),
                         MessageName("bad-option"));
      for (unsigned k = 0; k < n; ++k)
        axis.values.push_back(fmt::format("{:.15g}", n == 1 ? from : from + (to - from) * k / (n - 1)));
      return axis;
    }
    if (is_half_a_range(values))
      throw InputError(
        {"--over " + axis.key, 0, 0},
        fmt::format("FROM:TO:N is wanted, two numbers and how many values, e.g. --over {}=1:2:5, not '{}'", axis.key, values),
        MessageName("bad-option"));
    // At commas outside brackets and quotes, which belong to lists and strings.
    int  depth = 0;
    bool quoted = false;
    axis.values.emplace_back();
    for (const char c : values)
    {
      quoted = quoted != (c == '"');
      depth += (c == '[' || c == '(' || c == '{') - (c == ']' || c == ')' || c == '}');
      if (c == ',' && depth == 0 && !quoted)
        axis.values.emplace_back();
      else
        axis.values.back() += c;
    }
    for (const std::string &value : axis.values)
      if (value.find_first_not_of(' ') == std::string::npos)
        throw InputError(where, fmt::format("a value is missing in '{}'", text), MessageName("bad-option"));
    return axis;
  }

  std::vector<std::string> default_quantities(const std::vector<SweepStep> &steps)
  {
    std::vector<std::string> names;
    for (const SweepStep &step : steps)
      if (step.results.is_object())
      {
        for (std::size_t k = 0; k < step.results.value("constraint", SweepJson::array()).size(); ++k)
          for (const char *const name : {"total_contact_force", "max_contact_pressure", "contact_measure"})
            names.push_back(fmt::format("constraint.{}.{}", k, name));
        names.emplace_back("solution.energy");
        if (step.results.contains("certificate"))
          names.emplace_back("certificate.penalty_error_bound");
        break;
      }
    return names;
  }

  const char *status_of(const SweepStep &step)
  {
    switch (step.exit_code)
    {
    case exit_solved:
      return "solved";
    case exit_not_converged:
      return "not converged";
    case exit_expectation_failed:
      return "expectation failed";
    case exit_bad_input:
      return "bad input";
    default:
      return "failed";
    }
  }

  nlohmann::ordered_json sweep_json(const CaseSource               &first,
                                    const std::vector<SweepStep>   &steps,
                                    const std::vector<SweepAxis>   &axes,
                                    const std::vector<std::string> &quantities)
  {
    SweepJson json;
    json["schema_version"] = 1;
    json["program"] = program_json(Processes::all().size());
    json["case"] = to_json(first);
    json["over"] = SweepJson::array();
    for (const SweepAxis &axis : axes)
    {
      json["over"].push_back({{"key", axis.key}, {"values", SweepJson::array()}});
      for (const std::string &value : axis.values)
        json["over"].back()["values"].push_back(as_json(value));
    }
    json["quantities"] = quantities;
    json["rows"] = SweepJson::array();
    for (const SweepStep &step : steps)
    {
      SweepJson row = {{"folder", step.folder},     {"parameters", SweepJson::object()}, {"quantities", SweepJson::object()},
                       {"status", status_of(step)}, {"exit_code", step.exit_code},       {"seconds", step.seconds},
                       {"message", step.message}};
      for (std::size_t a = 0; a < axes.size(); ++a)
        row["parameters"][axes[a].key] = as_json(step.values[a]);
      for (const std::string &name : quantities)
        row["quantities"][name] = quantity_of(step, name);
      json["rows"].push_back(std::move(row));
    }
    return json;
  }

  std::vector<std::string>
  keys_without_effect(const std::vector<SweepStep> &steps, const std::vector<SweepAxis> &axes, const std::vector<std::string> &quantities)
  {
    std::vector<std::string> keys;
    for (std::size_t a = 0; a < axes.size(); ++a)
    {
      std::map<std::vector<std::string>, SweepJson> seen; // by the values of the other keys
      bool                                          compared = false, differ = false;
      for (const SweepStep &step : steps)
      {
        SweepJson numbers;
        bool      complete = !quantities.empty();
        for (const std::string &name : quantities)
        {
          numbers.push_back(quantity_of(step, name));
          complete = complete && !numbers.back().is_null();
        }
        if (!complete)
          continue;
        std::vector<std::string> others = step.values;
        others.erase(others.begin() + std::ptrdiff_t(a));
        const auto [first, is_new] = seen.try_emplace(others, numbers);
        compared = compared || !is_new;
        differ = differ || first->second != numbers;
      }
      if (compared && !differ)
        keys.push_back(axes[a].key);
    }
    return keys;
  }

  std::string sweep_csv(const std::vector<SweepStep> &steps, const std::vector<SweepAxis> &axes, const std::vector<std::string> &quantities)
  {
    std::string csv = "folder";
    for (const SweepAxis &axis : axes)
      csv += "," + csv_text(axis.key);
    for (const std::string &name : quantities)
      csv += "," + csv_text(name);
    csv += ",status,seconds\n";
    for (const SweepStep &step : steps)
    {
      csv += step.folder;
      for (const std::string &value : step.values)
        csv += "," + csv_text(value);
      for (const std::string &name : quantities)
        csv += "," + csv_text(csv_number(quantity_of(step, name)));
      csv += fmt::format(",{},{:.3f}\n", status_of(step), step.seconds);
    }
    return csv;
  }
} // namespace unilateral
