#include "unilateral/report/report.h"

#include "unilateral/base/diagnostics.h"
#include "unilateral/base/sha256.h"
#include "unilateral/output/result_files.h"
#include "unilateral/output/step_files.h"
#include "unilateral/report/html.h"
#include "unilateral/report/picture.h"
#include "unilateral/report/report_page.h"
#include "unilateral/report/scene.h"
#include "unilateral/report/sections.h"
#include "unilateral/report/verdict.h"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <filesystem>

namespace unilateral
{
  static_assert(std::endian::native == std::endian::little, "the page reads numbers as a little-endian machine writes them");

  namespace
  {
    using Json = ResultsFolder::Json;

    /// What all scenes of a page may hold together.
    constexpr SceneLimits limits_of_page = {.triangles = 60000, .lines = 120000, .cloud = 20000};
    /// Steps of a sweep that are shown as pictures.
    constexpr std::size_t most_steps = 60;

    template <typename T, std::size_t n>
    std::string base64_of(const std::vector<std::array<T, n>> &values)
    {
      return base64(values.data(), values.size() * sizeof(std::array<T, n>));
    }

    Json fields_json(const std::vector<Scene::Field> &fields)
    {
      Json json = Json::array();
      for (const auto &field : fields)
        json.push_back({{"name", field.name},
                        {"components", field.n_components},
                        {"min", field.min},
                        {"max", field.max},
                        {"values", base64(field.values)}});
      return json;
    }

    Json scene_json(const Scene &scene)
    {
      if (scene.empty())
        return nullptr;
      Json        json = {{"dimension", scene.dimension},
                          {"vector", scene.vector},
                          {"axisymmetric", scene.axisymmetric},
                          {"up", std::string(1, "xyz"[scene.upward_axis])},
                          {"points", base64_of(scene.points)},
                          {"triangles", base64_of(scene.triangles)},
                          {"lines", base64_of(scene.lines)},
                          {"fields", fields_json(scene.fields)},
                          {"cell_fields", fields_json(scene.cell_fields)},
                          {"cloud", nullptr},
                          {"decimated", nullptr}};
      const auto &cloud = scene.cloud;
      if (!cloud.points.empty())
        json["cloud"] = {{"points", base64_of(cloud.points)},
                         {"pressure", base64(cloud.pressure)},
                         {"gap", base64(cloud.gap)},
                         {"penetration", base64(cloud.penetration)},
                         {"active", base64(cloud.active)},
                         {"direction", cloud.direction.empty() ? Json() : Json(base64_of(cloud.direction))},
                         {"u_along", cloud.u_along.empty() ? Json() : Json(base64(cloud.u_along))},
                         {"n_in_all", cloud.n_in_all}};
      if (scene.triangles.size() < scene.n_triangles_in_all)
        json["decimated"] = {{"from", scene.n_triangles_in_all}, {"to", scene.triangles.size()}};
      return json;
    }

    /// JSON that can stand in a script element: no "<" in it.
    std::string embedded(const Json &json)
    {
      std::string text;
      for (const char c : json.dump(-1, ' ', true, Json::error_handler_t::replace))
        text += c == '<' ? "\\u003c" : c == '>' ? "\\u003e" : c == '&' ? "\\u0026" : std::string(1, c);
      return text;
    }

    /// The hash of a script as a Content-Security-Policy names it.
    std::string policy_hash(const std::string &script)
    {
      const std::string hex = sha256(script);
      std::string       bytes;
      for (std::size_t k = 0; k + 1 < hex.size(); k += 2)
        bytes += char(std::stoi(hex.substr(k, 2), nullptr, 16));
      return "sha256-" + base64(bytes.data(), bytes.size());
    }

    std::string figures_of(const Scene &scene, const std::string &name, const std::size_t run)
    {
      std::string note = name;
      if (scene.triangles.size() < scene.n_triangles_in_all)
        note += fmt::format("; the surface is shown with {} of its {} triangles", scene.triangles.size(), scene.n_triangles_in_all);
      if (scene.cloud.points.size() < scene.cloud.n_in_all)
        note += fmt::format("; {} of {} integration points are shown", scene.cloud.points.size(), scene.cloud.n_in_all);
      const auto figure = [&](const char *const kind, const std::string &svg, const std::string &caption)
      {
        return svg.empty() ? std::string()
                           : fmt::format("<figure class=\"{}\" data-run=\"{}\">{}<figcaption>{}</figcaption></figure>\n", kind, run, svg,
                                         escaped(caption));
      };
      const std::string section = section_svg(scene);
      // In 1-D the section is the picture.
      if (scene.dimension == 1)
        return figure("section-plot", section, note);
      return figure("viewer", picture_svg(scene, name, {.field = {}, .standalone = false}), note) +
             figure("section-plot", section,
                    scene.vector || scene.dimension == 3
                      ? "Contact pressure at the integration points"
                      : "u against its bounds along a line through the largest pressure, and the pressure");
    }

    /// The table that sets several runs side by side.
    std::string comparison_section(const std::vector<ResultsFolder> &folders)
    {
      std::vector<std::string>                               headings = {""};
      std::vector<std::vector<std::string>>                  rows;
      const std::vector<std::pair<std::string, std::string>> lines = {
        {"status", "/status"},
        {"element", "/space/element"},
        {"unknowns", "/space/n_dofs"},
        {"h, largest", "/mesh/h_max"},
        {"formulation", "/method/formulation"},
        {"epsilon", "/method/epsilon"},
        {"rule", "/constraint/0/quadrature"},
        {"contact force", "/constraint/0/total_contact_force"},
        {"contact measure", "/constraint/0/contact_measure"},
        {"largest pressure", "/constraint/0/max_contact_pressure"},
        {"largest penetration", "/constraint/0/max_penetration"},
        {"energy", "/solution/energy"},
        {"estimated error of the mesh", "/certificate/discretisation_indicator"},
        {"bound of penalty and solver", "/certificate/penalty_error_bound"},
        {"Newton steps", "/solver/newton_iterations"},
        {"seconds", "/timing/total"}};
      for (const auto &folder : folders)
        headings.push_back(folder.name);
      for (const auto &[name, path] : lines)
      {
        rows.push_back({name});
        for (const auto &folder : folders)
        {
          const Json::json_pointer pointer(path);
          const Json               value = folder.results && folder.results->contains(pointer) ? folder.results->at(pointer) : Json();
          rows.back().push_back(value.is_string()           ? value.get<std::string>()
                                : value.is_number_integer() ? value.dump()
                                : value.is_number()         ? number_text(value.get<double>())
                                                            : "–");
        }
      }
      return html_section("comparison", "Side by side", html_table(headings, rows));
    }

    std::string document(const std::string &title, const std::string &subtitle, const std::string &body, const Json &data)
    {
      const std::string script(report_script());
      std::string       links;
      for (std::size_t at = body.find("<section id=\""); at != std::string::npos; at = body.find("<section id=\"", at + 1))
      {
        const std::size_t id = at + 13, id_end = body.find('"', id), heading = body.find("<h2>", at) + 4,
                          heading_end = body.find("</h2>", at);
        links += fmt::format("<a href=\"#{}\">{}</a>\n", body.substr(id, id_end - id), body.substr(heading, heading_end - heading));
      }
      return fmt::format(
        "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n<meta name=\"viewport\" content=\"width=device-width, "
        "initial-scale=1\">\n<meta http-equiv=\"Content-Security-Policy\" content=\"default-src 'none'; img-src data: blob:; style-src "
        "'unsafe-inline'; script-src '{}'\">\n<title>{}</title>\n<style>{}</style>\n</head>\n<body>\n<header>\n<h1>{}</h1>\n<p "
        "class=\"subtitle\">{}</p>\n</header>\n<nav aria-label=\"Sections\">\n{}</nav>\n<main>\n{}</main>\n<script "
        "type=\"application/json\" "
        "id=\"data\">{}</script>\n<script>{}</script>\n</body>\n</html>\n",
        policy_hash(script), escaped(title), report_style(), escaped(title), escaped(subtitle), links, body, embedded(data), script);
    }

    Json run_json(const ResultsFolder &folder, const Scene &scene)
    {
      return {{"name", folder.name}, {"title", folder.title()}, {"scene", scene_json(scene)}};
    }

    std::string sections_of(const ResultsFolder &folder)
    {
      return contact_section(folder) + balance_section(folder) + certificate_section(folder) + convergence_section(folder) +
             adaptive_section(folder) + epsilon_section(folder) + mesh_study_section(folder) + quadrature_section(folder) +
             infsup_section(folder);
    }

    std::string subtitle_of(const ResultsFolder &folder)
    {
      if (folder.results)
        return verdict_sentence(*folder.results);
      return folder.sweep ? "a sweep" : "a study";
    }

    /// The parameters of a step, "mesh.refine = 3, poisson = 0.3".
    std::string step_label(const Json &row)
    {
      std::string label;
      if (row.contains("parameters") && row["parameters"].is_object())
        for (const auto &[key, value] : row["parameters"].items())
          label += fmt::format("{}{} = {}", label.empty() ? "" : ", ", key, value.is_string() ? value.get<std::string>() : value.dump());
      return label;
    }

    /// The runs of a sweep that are there, at most so many, evenly chosen.
    std::vector<ResultsFolder> steps_in(const std::string &directory, const ResultsFolder &sweep)
    {
      std::vector<ResultsFolder> steps;
      const Json                 rows = sweep.sweep->value("rows", Json::array());
      const std::size_t          stride = (rows.size() + most_steps - 1) / most_steps;
      for (std::size_t k = 0; k < rows.size(); k += std::max<std::size_t>(stride, 1))
      {
        const std::string           folder = rows[k].value("folder", std::string());
        const std::filesystem::path path = std::filesystem::path(directory) / folder;
        if (folder.empty() || folder.find('/') != std::string::npos || folder == ".." || !std::filesystem::exists(path / "results.json"))
          continue;
        steps.push_back(read_results(path.string()));
        steps.back().name = step_label(rows[k]);
      }
      return steps;
    }

    /// Those steps of a load history that have a folder, at most so many, evenly chosen.
    std::vector<ResultsFolder> steps_of_history(const std::string &directory, const ResultsFolder &folder)
    {
      std::vector<ResultsFolder>                                 steps;
      std::vector<std::pair<std::filesystem::path, std::string>> found;
      const Json                                                 rows = folder.results->value("steps", Json::array());
      for (std::size_t k = 0; k < rows.size(); ++k)
        for (const std::size_t n : {rows.size(), std::size_t(1000), std::size_t(10000)}) // how many were planned, nobody knows
          if (const auto path = std::filesystem::path(directory) / folder_of_step(k, n); std::filesystem::exists(path / "results.json"))
          {
            const std::string label = step_label(rows[k]);
            found.emplace_back(path, fmt::format("step {}{}{}", k + 1, label.empty() ? "" : ": ", label));
            break;
          }
      if (found.size() < 2)
        return steps;
      // With the last one in any case.
      const std::size_t stride = (found.size() + most_steps - 1) / most_steps;
      for (std::size_t k = (found.size() - 1) % stride; k < found.size(); k += stride)
      {
        steps.push_back(read_results(found[k].first.string()));
        steps.back().name = found[k].second;
      }
      return steps;
    }

    SceneLimits shared_by(const std::size_t n)
    {
      const std::size_t parts = std::max<std::size_t>(n, 1);
      return {std::max<std::size_t>(limits_of_page.triangles / parts, 3000), std::max<std::size_t>(limits_of_page.lines / parts, 5000),
              std::max<std::size_t>(limits_of_page.cloud / parts, 1000)};
    }
  } // namespace

  std::string report_html(const std::vector<ResultsFolder> &folders, const std::vector<ResultsFolder> &steps)
  {
    const ResultsFolder &first = folders.at(0);
    Json                 data = {{"format", 1}, {"kind", "run"}, {"steps", nullptr}, {"runs", Json::array()}};
    std::string          pictures;
    const auto           add_picture = [&](const ResultsFolder &folder, const SceneLimits &limits, const bool shown)
    {
      const Scene scene = make_scene(folder, limits);
      if (shown)
        pictures += figures_of(scene, folders.size() > 1 || !steps.empty() ? folder.name : folder.title(), data["runs"].size());
      data["runs"].push_back(run_json(folder, scene));
    };
    if (folders.size() > 1)
    {
      data["kind"] = "comparison";
      for (const auto &folder : folders)
        add_picture(folder, shared_by(folders.size()), true);
      const std::string picture = pictures.empty() ? "" : html_section("picture", "Picture", pictures);
      std::string       body = comparison_section(folders) + picture;
      for (const auto &folder : folders)
        body += fmt::format("<h2 class=\"run\">{}</h2>\n", escaped(folder.name)) + [&]
        {
          // Each run has its sections; their names differ by the run's number.
          std::string       text = verdict_section(folder) + sections_of(folder) + case_section(folder) + downloads_section(folder);
          const std::string suffix = fmt::format("-{}", &folder - folders.data() + 1);
          for (std::size_t at = text.find("<section id=\""); at != std::string::npos; at = text.find("<section id=\"", at + 1))
            text.insert(text.find('"', at + 13), suffix);
          return text;
        }();
      return document(fmt::format("{} runs side by side", folders.size()), first.title(), body, data);
    }
    if (!steps.empty())
    {
      data["kind"] = "sweep";
      data["steps"] = Json::array();
      for (const auto &step : steps)
      {
        data["steps"].push_back(step.name);
        add_picture(step, shared_by(steps.size()), &step == &steps.back());
      }
    }
    else if (first.results)
      add_picture(first, limits_of_page, true);
    const std::string picture = pictures.empty() ? "" : html_section("picture", "Picture", pictures);
    return document(first.title(), subtitle_of(first),
                    verdict_section(first) + sweep_section(first) + steps_section(first) + picture + sections_of(first) +
                      case_section(first) + downloads_section(first),
                    data);
  }

  void write_report(const std::string &directory, const std::string &of)
  {
    ResultsFolder folder = read_results(directory);
    if (!of.empty())
      folder.take_studies_of(of);
    const auto steps = folder.sweep                                          ? steps_in(directory, folder)
                       : folder.results && folder.results->contains("steps") ? steps_of_history(of.empty() ? directory : of, folder)
                                                                             : std::vector<ResultsFolder>();
    write_file_atomically((std::filesystem::path(directory) / "report.html").string(), report_html({folder}, steps));
  }
} // namespace unilateral
