#include "unilateral/output/step_files.h"
#include "unilateral/report/html.h"
#include "unilateral/report/sections.h"
#include "unilateral/report/svg_plot.h"

#include <fmt/format.h>

#include <cmath>
#include <optional>

namespace unilateral
{
  namespace
  {
    using StepsJson = ResultsFolder::Json;

    /// More rows than that are for the CSV file.
    constexpr std::size_t most_rows = 200;

    std::string step_text(const StepsJson &value)
    {
      return value.is_number_integer() ? value.dump()
             : value.is_number()       ? number_text(value.get<double>())
             : value.is_string()       ? value.get<std::string>()
                                       : "–";
    }

    /// One quantity over the steps; nothing where it never changes.
    std::optional<std::string>
    curve_of(const StepsJson &steps, const std::string &path, const std::string &key, const std::vector<double> &x)
    {
      Plot plot{.title = path, .x_label = key, .y_label = path, .series = {{.name = path, .x = x, .y = {}}}, .slopes = {}, .height = 300};
      bool changes = false;
      for (const StepsJson &step : steps)
      {
        plot.series[0].y.push_back(quantity_of_step(step, path));
        changes = changes || plot.series[0].y.back() != plot.series[0].y.front();
      }
      plot.series[0].markers = x.size() <= 60;
      if (!changes)
        return {};
      return fmt::format("<figure>{}<figcaption>{}</figcaption></figure>\n", to_svg(plot), escaped(path));
    }

    /// Those that have a curve: not the counts of the solver, and of a few probes alone.
    bool is_worth_a_curve(const std::string &path)
    {
      for (const char *const start : {"solver.", "timing.", "solution.energy", "estimate."})
        if (path.starts_with(start))
          return false;
      return !path.ends_with(".max_penetration") && !path.ends_with(".n_active");
    }
  } // namespace

  std::string steps_section(const ResultsFolder &folder)
  {
    if (!folder.results || !folder.results->contains("steps") || !(*folder.results)["steps"].is_array() ||
        (*folder.results)["steps"].empty())
      return "";
    const StepsJson          &steps = (*folder.results)["steps"];
    std::string               key;
    const std::vector<double> x = abscissa_of_steps(steps, key);
    std::string               html;
    std::size_t               n_curves = 0;
    std::vector<std::string>  headings = {"step"}, columns;
    if (steps[0].contains("parameters"))
      for (const auto &value : steps[0]["parameters"].items())
        headings.push_back(value.key());
    const std::size_t n_keys = headings.size() - 1;
    for (const std::string &path : quantities_of_steps(steps))
    {
      if (steps.size() > 1 && is_worth_a_curve(path) && n_curves < 12)
        if (const auto curve = curve_of(steps, path, key, x))
        {
          html += *curve;
          ++n_curves;
        }
      if (columns.size() < 8 && path.find("contact_force.") == std::string::npos)
        columns.push_back(path);
    }
    headings.insert(headings.end(), columns.begin(), columns.end());
    headings.emplace_back("status");
    std::vector<std::vector<std::string>> rows;
    const std::size_t                     stride = (steps.size() + most_rows - 1) / most_rows;
    for (std::size_t k = 0; k < steps.size(); k += stride)
    {
      rows.push_back({step_text(steps[k].value("number", StepsJson()))});
      for (std::size_t c = 1; c <= n_keys; ++c)
        rows.back().push_back(step_text(steps[k].value("parameters", StepsJson::object()).value(headings[c], StepsJson())));
      for (const std::string &path : columns)
        rows.back().push_back(number_text(quantity_of_step(steps[k], path)));
      rows.back().push_back(step_text(steps[k].value("status", StepsJson())));
    }
    html += html_table(headings, rows);
    if (stride > 1)
      html += fmt::format("<p>One step in {} is shown; step_history.csv has all of them.</p>\n", stride);
    return html_section("steps", "Load history", html);
  }
} // namespace unilateral
