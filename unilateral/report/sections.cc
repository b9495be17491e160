#include "unilateral/report/sections.h"

#include "unilateral/report/html.h"
#include "unilateral/report/svg_plot.h"
#include "unilateral/report/verdict.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>

namespace unilateral
{
  namespace
  {
    using Json = ResultsFolder::Json;
    using Row = std::vector<std::string>;

    /// The entry at @p path, or null.
    const Json &at(const Json &json, const std::string &path)
    {
      static const Json        null;
      const Json::json_pointer pointer(path);
      return json.contains(pointer) ? json.at(pointer) : null;
    }

    /// Any value as people read it.
    std::string shown(const Json &value)
    {
      if (value.is_number_integer() || value.is_number_unsigned())
        return value.dump();
      if (value.is_number())
        return number_text(value.get<double>());
      if (value.is_string())
        return value.get<std::string>();
      if (value.is_boolean())
        return value.get<bool>() ? "yes" : "no";
      if (value.is_array())
      {
        std::string text;
        for (const Json &entry : value)
          text += (text.empty() ? "" : ", ") + shown(entry);
        return "(" + text + ")";
      }
      return "–";
    }

    std::string shown(const Json &json, const std::string &path)
    {
      return shown(at(json, path));
    }

    /// The texts KEY=VALUE of an array by their keys: in which order keys are set makes no difference, unless one is set twice.
    std::vector<std::string> by_key(const Json &settings)
    {
      std::vector<std::string> texts;
      if (settings.is_array())
        for (const Json &setting : settings)
          texts.push_back(shown(setting));
      const auto key = [](const std::string &text) { return text.substr(0, text.find('=')); };
      std::stable_sort(texts.begin(), texts.end(), [&](const std::string &a, const std::string &b) { return key(a) < key(b); });
      return texts;
    }

    /// What a study was made of, where that is not what the run on the same page was made of: a folder keeps what earlier commands left.
    std::string origin(const ResultsFolder &folder, const Json &study)
    {
      const Json &settings = at(study, "/case/settings");
      const bool  has_settings = settings.is_array() && !settings.empty();
      if (!folder.results)
        return has_settings ? fmt::format("<p>With --set {}.</p>\n", escaped(shown(settings))) : "";
      std::string text;
      if (at(*folder.results, "/case/sha256") != at(study, "/case/sha256"))
        text += "The case file has changed between this study and the run on this page. ";
      if (by_key(at(*folder.results, "/case/settings")) != by_key(settings))
        text += has_settings ? fmt::format("The study is with --set {}, other than the run.", shown(settings))
                             : "The study is of the case as it stands, the run with settings of its own.";
      return text.empty() ? "" : fmt::format("<p>{}</p>\n", escaped(text));
    }

    double number(const Json &json, const std::string &path)
    {
      const Json &value = at(json, path);
      return value.is_number() ? value.get<double>() : std::nan("");
    }

    /// A table of the entries of an array; columns that no entry has are left out.
    struct Column
    {
      std::string heading, path;
    };

    std::string table_of(const Json &entries, const std::vector<Column> &columns)
    {
      if (!entries.is_array() || entries.empty())
        return "";
      std::vector<Column> used;
      for (const Column &column : columns)
        if (std::any_of(entries.begin(), entries.end(), [&](const Json &entry) { return !at(entry, column.path).is_null(); }))
          used.push_back(column);
      Row headings;
      for (const Column &column : used)
        headings.push_back(column.heading);
      std::vector<Row> rows;
      for (const Json &entry : entries)
      {
        rows.emplace_back();
        for (const Column &column : used)
          rows.back().push_back(shown(entry, column.path));
      }
      return html_table(headings, rows);
    }

    /// A list of names and values; what is missing is left out.
    std::string list_of(const Json &json, const std::vector<Column> &entries)
    {
      std::vector<Row> rows;
      for (const Column &entry : entries)
        if (!at(json, entry.path).is_null())
          rows.push_back({entry.heading, shown(json, entry.path)});
      return rows.empty() ? "" : html_table({"", ""}, rows);
    }

    std::string figure(const Plot &plot, const std::string &caption)
    {
      const std::string svg = to_svg(plot);
      return svg.empty() ? "" : fmt::format("<figure class=\"plot\">{}<figcaption>{}</figcaption></figure>\n", svg, escaped(caption));
    }

    /// A series over the entries of an array.
    PlotSeries
    series_of(const Json &entries, const std::string &name, const std::string &x, const std::string &y, const bool dashed = false)
    {
      PlotSeries series{.name = name, .x = {}, .y = {}, .dashed = dashed};
      if (entries.is_array())
        for (const Json &entry : entries)
        {
          series.x.push_back(number(entry, x));
          series.y.push_back(number(entry, y));
        }
      return series;
    }

    bool has_points(const PlotSeries &series)
    {
      return std::any_of(series.y.begin(), series.y.end(), [](const double y) { return std::isfinite(y) && y > 0; });
    }

    std::string download(const std::string &name, const std::string &type, const std::string &content)
    {
      return content.empty() ? ""
                             : fmt::format("<li><a download=\"{0}\" href=\"data:{1};base64,{2}\">{0}</a></li>\n", escaped(name), type,
                                           base64(content.data(), content.size()));
    }
  } // namespace

  std::string verdict_section(const ResultsFolder &folder)
  {
    if (!folder.results)
      return "";
    std::string html =
      "<div class=\"scroll\" tabindex=\"0\"><table class=\"verdict\">\n<thead><tr><th scope=\"col\">What</th><th "
      "scope=\"col\">Found</th><th scope=\"col\">Held against</th><th scope=\"col\">What to do</th></tr></thead>\n<tbody>\n";
    for (const VerdictItem &item : verdict_of(*folder.results))
    {
      const char *const kind = item.kind == VerdictItem::Kind::good ? "good" : item.kind == VerdictItem::Kind::bad ? "bad" : "warn";
      html += fmt::format("<tr class=\"{}\"><th scope=\"row\">{}</th><td class=\"number\">{}</td><td class=\"threshold\">{}</td><td "
                          "class=\"next\">{}</td></tr>\n",
                          kind, escaped(item.what), escaped(item.number), escaped(item.threshold), escaped(item.next));
    }
    return html_section("verdict", "Verdict", html + "</tbody></table></div>\n");
  }

  std::string contact_section(const ResultsFolder &folder)
  {
    if (!folder.results)
      return "";
    std::string html = table_of(at(*folder.results, "/constraint"), {{"on", "/on"},
                                                                     {"bound", "/side"},
                                                                     {"rule", "/quadrature"},
                                                                     {"points", "/n_points"},
                                                                     {"in contact", "/n_active"},
                                                                     {"contact measure", "/contact_measure"},
                                                                     {"total force", "/total_contact_force"},
                                                                     {"force", "/contact_force"},
                                                                     {"moment", "/contact_moment"},
                                                                     {"largest pressure", "/max_contact_pressure"},
                                                                     {"largest penetration", "/max_penetration"},
                                                                     {"off the obstacle", "/n_missed"}});
    html += table_of(at(*folder.results, "/solution/probes"), {{"at", "/point"},
                                                               {"u", "/value"},
                                                               {"von Mises stress", "/von_mises"},
                                                               {"stress xx, yy, zz, xy, xz, yz", "/stress"},
                                                               {"moments", "/moments"}});
    std::vector<Row> functionals;
    for (const auto &[name, value] : at(*folder.results, "/solution/functionals").items())
      functionals.push_back({name, shown(value)});
    if (!functionals.empty())
      html += html_table({"functional", "value"}, functionals);
    html += list_of(*folder.results, {{"energy", "/solution/energy"},
                                      {"smallest u", "/solution/min"},
                                      {"largest u", "/solution/max"},
                                      {"largest von Mises stress", "/solution/max_von_mises"},
                                      {"cells", "/mesh/n_cells"},
                                      {"unknowns", "/space/n_dofs"},
                                      {"element", "/space/element"}});
    return html.empty() ? "" : html_section("contact", "Contact and solution", html);
  }

  std::string balance_section(const ResultsFolder &folder)
  {
    if (!folder.results || at(*folder.results, "/balance").is_null())
      return "";
    const Json      &balance = at(*folder.results, "/balance");
    std::vector<Row> rows;
    for (const auto &[name, path] : std::vector<std::pair<std::string, std::string>>{
           {"loads", "/load"}, {"springs", "/springs"}, {"contact", "/contact"}, {"supports", "/reaction"}})
      if (at(balance, path).is_array())
      {
        rows.push_back({name});
        for (const Json &component : at(balance, path))
          rows.back().push_back(shown(component));
      }
    Row headings = {"resultant force of"};
    for (std::size_t d = 0; !rows.empty() && d + 1 < rows[0].size(); ++d)
      headings.push_back(std::string(1, "xyz"[d % 3]));
    return html_section(
      "balance", "Balance of forces",
      html_table(headings, rows) + table_of(at(balance, "/reactions"), {{"support on", "/on"}, {"force on the body", "/force"}}) +
        table_of(at(*folder.results, "/platens"), {{"rigid platen on", "/on"},
                                                   {"moves by", "/translation"},
                                                   {"turns by", "/rotation"},
                                                   {"force on the body", "/force"},
                                                   {"moment", "/moment"},
                                                   {"about", "/about"}}) +
        table_of(at(*folder.results, "/periodic"), {{"periodic parts", "/parts"}, {"force on the second", "/force"}}) +
        list_of(balance, {{"out of balance, relative", "/residual"}, {"side conditions bear, relative", "/side_conditions"}}));
  }

  std::string certificate_section(const ResultsFolder &folder)
  {
    if (!folder.results)
      return "";
    std::string html =
      list_of(*folder.results, {{"penalty parameter epsilon", "/method/epsilon"},
                                {"chosen because", "/method/epsilon_reason"},
                                {"duality gap", "/certificate/energy_gap"},
                                {"bound of the error of penalty and solver, energy norm", "/certificate/penalty_error_bound"},
                                {"of it rounding", "/certificate/round_off"},
                                {"bound by Theorem 3", "/certificate/theorem3_bound"},
                                {"no bound by Theorem 3", "/certificate/theorem3_reason"},
                                {"bound without C_h", "/certificate/lbb_free_bound"},
                                {"estimated error of the mesh, energy norm", "/certificate/discretisation_indicator"},
                                {"total error, energy norm", "/estimate/total"},
                                {"it is a bound", "/estimate/guaranteed"},
                                {"it is no bound, since", "/estimate/reason"},
                                {"over the true error", "/estimate/effectivity"},
                                {"true error, energy norm", "/errors/energy"},
                                {"energy norm of the solution", "/solution/norm_energy"},
                                {"error in L2", "/errors/L2"},
                                {"error in the H1 seminorm", "/errors/H1_semi"},
                                {"largest error at a node", "/errors/max_nodal"},
                                {"error of the pressure in L2", "/errors/pressure_L2"}});
    return html.empty() ? "" : html_section("certificate", "Certificate and errors", html);
  }

  std::string convergence_section(const ResultsFolder &folder)
  {
    if (!folder.results)
      return "";
    const Json &solver = at(*folder.results, "/solver");
    Plot        plot{.title = "Residual by Newton step",
                     .x_label = "Newton step",
                     .y_label = "residual",
                     .y_log = true,
                     .series = {},
                     .slopes = {},
                     .height = 300};
    if (const Json &history = at(solver, "/history"); history.is_array())
    {
      double step = 0;
      Json   level;
      for (const Json &entry : history)
      {
        if (plot.series.empty() || at(entry, "/level") != level)
        {
          level = at(entry, "/level");
          plot.series.push_back({.name = "level " + shown(level), .x = {}, .y = {}});
        }
        plot.series.back().x.push_back(++step);
        plot.series.back().y.push_back(number(entry, "/residual"));
      }
    }
    std::string html = figure(plot, "Residual in the energy norm, relative, step by step; each level starts from the one before.");
    html += table_of(at(solver, "/levels"), {{"level", "/level"},
                                             {"cells", "/n_cells"},
                                             {"unknowns", "/n_dofs"},
                                             {"points", "/n_points"},
                                             {"in contact", "/n_active"},
                                             {"Newton steps", "/newton_iterations"},
                                             {"linear iterations", "/linear_iterations"},
                                             {"residual", "/residual"},
                                             {"converged", "/converged"}});
    html += list_of(*folder.results, {{"linear solver", "/method/solver_reason"},
                                      {"seconds, total", "/timing/total"},
                                      {"mesh", "/timing/mesh"},
                                      {"set-up", "/timing/setup"},
                                      {"solve", "/timing/solve"},
                                      {"certificate", "/timing/certify"},
                                      {"memory, bytes", "/memory/peak_bytes"}});
    return html_section("convergence", "Convergence", html);
  }

  std::string epsilon_section(const ResultsFolder &folder)
  {
    if (!folder.study_epsilon)
      return "";
    const Json &study = *folder.study_epsilon, &rows = at(study, "/rows");
    Plot        plot{.title = "Error of the penalty method by epsilon",
                     .x_label = "epsilon",
                     .y_label = "error",
                     .x_log = true,
                     .y_log = true,
                     .series = {},
                     .slopes = {1}};
    plot.series = {series_of(rows, "|u_h - u_eps|_V", "/epsilon", "/u_error_V"),
                   series_of(rows, "|p_h - p_eps|_0", "/epsilon", "/p_error_L2"),
                   series_of(rows, "bound of u by the duality gap", "/epsilon", "/bound_u_gap", true),
                   series_of(rows, "bound of u by Theorem 3", "/epsilon", "/bound_u", true),
                   series_of(rows, "bound of p by Theorem 3", "/epsilon", "/bound_p", true)};
    std::erase_if(plot.series, [](const PlotSeries &series) { return !has_points(series); });
    std::vector<Row> holds;
    if (const Json &found = at(study, "/holds"); found.is_object())
      for (const auto &[name, value] : found.items())
        holds.push_back({name, value.is_null() ? "cannot be said" : shown(value)});
    return html_section(
      "epsilon-study", "Study of the penalty parameter",
      origin(folder, study) +
        figure(plot, "Solid: differences to the mixed solution on the same mesh. Dashed: what bounds them. The triangle has slope 1.") +
        (holds.empty() ? "" : html_table({"theorem", "holds"}, holds)) +
        table_of(rows, {{"epsilon", "/epsilon"},
                        {"error of u, V", "/u_error_V"},
                        {"error of p, L2", "/p_error_L2"},
                        {"slope of u", "/slope_u"},
                        {"bound of u (22)", "/bound_u"},
                        {"by the gap", "/bound_u_gap"},
                        {"largest penetration", "/max_penetration"},
                        {"contact force", "/total_contact_force"},
                        {"Newton steps", "/newton_iterations"}}) +
        list_of(study, {{"m", "/constants/m"},
                        {"M", "/constants/M"},
                        {"C_h", "/constants/C_h"},
                        {"beta_h", "/constants/beta_h"},
                        {"no constants", "/constants/missing"}}));
  }

  std::string adaptive_section(const ResultsFolder &folder)
  {
    if (!folder.results)
      return "";
    const Json &cycles = at(*folder.results, "/estimate/cycles");
    if (!cycles.is_array() || cycles.empty())
      return "";
    Plot plot{
      .title = "Error by unknowns", .x_label = "unknowns", .y_label = "error", .x_log = true, .y_log = true, .series = {}, .slopes = {}};
    if (auto series = series_of(cycles, "relative to the energy norm", "/n_dofs", "/relative"); has_points(series))
      plot.series.push_back(std::move(series));
    if (auto series = series_of(cycles, "of the goal", "/n_dofs", "/goal/relative"); has_points(series))
      plot.series.push_back(std::move(series));
    std::string goals;
    if (!at(*folder.results, "/estimate/goal").is_null())
      goals = table_of(cycles, {{"unknowns", "/n_dofs"},
                                {"goal", "/goal/quantity"},
                                {"value", "/goal/value"},
                                {"its error, estimated", "/goal/error"},
                                {"relative", "/goal/relative"},
                                {"correction", "/goal/correction"}});
    return html_section("adaptive", "Adaptive refinement",
                        figure(plot, "Error in the energy norm, relative to that of u, by the number of unknowns.") + goals +
                          table_of(cycles, {{"level", "/level"},
                                            {"cells", "/n_cells"},
                                            {"unknowns", "/n_dofs"},
                                            {"relative error", "/relative"},
                                            {"error", "/total"},
                                            {"of the mesh", "/discretisation"},
                                            {"of the penalty", "/penalty"},
                                            {"of the solver", "/algebraic"},
                                            {"guaranteed", "/guaranteed"}}));
  }

  std::string mesh_study_section(const ResultsFolder &folder)
  {
    if (!folder.study_mesh)
      return "";
    const Json &study = *folder.study_mesh, &rows = at(study, "/rows");
    Plot plot{.title = "Errors by mesh size", .x_label = "h", .y_label = "error", .x_log = true, .y_log = true, .series = {}, .slopes = {}};
    std::vector<Column>       columns = {{"level", "/level"}, {"h", "/h"}, {"unknowns", "/n_dofs"}, {"epsilon", "/epsilon"}};
    const std::vector<Column> errors = {{"H1 seminorm", "/errors/H1_semi"},
                                        {"L2", "/errors/L2"},
                                        {"largest at a node", "/errors/max_nodal"},
                                        {"pressure L2", "/errors/pressure_L2"},
                                        {"difference, H1 seminorm", "/differences/H1_semi"},
                                        {"difference, L2", "/differences/L2"},
                                        {"estimated, energy norm", "/discretisation_indicator"}};
    for (const Column &error : errors)
    {
      columns.push_back(error);
      if (auto series = series_of(rows, error.heading, "/h", error.path); has_points(series))
        plot.series.push_back(std::move(series));
    }
    if (const Json &rates = at(study, "/rates/H1_semi"); rates.is_array() && !rates.empty() && rates.back().is_number())
      plot.slopes = {std::max(1., std::round(2 * rates.back().get<double>()) / 2)};
    for (const Column &more : std::vector<Column>{{"contact force", "/total_contact_force"},
                                                  {"contact area", "/contact_measure"},
                                                  {"largest pressure", "/max_contact_pressure"},
                                                  {"largest von Mises stress", "/max_von_mises"},
                                                  {"energy", "/energy"},
                                                  {"seconds", "/seconds"}})
      columns.push_back(more);
    std::vector<Row> rates;
    if (const Json &found = at(study, "/rates"); found.is_object())
      for (const auto &[name, values] : found.items())
        rates.push_back({name, shown(values)});
    const Json &adaptive = at(study, "/adaptive");
    std::string refined;
    if (adaptive.is_object())
    {
      const Json &meshes = at(adaptive, "/rows");
      Plot        by_unknowns{.title = "Errors by the number of unknowns",
                              .x_label = "unknowns",
                              .y_label = "energy norm",
                              .x_log = true,
                              .y_log = true,
                              .series = {},
                              .slopes = {}};
      by_unknowns.series = {series_of(meshes, "refined by the error: error", "/n_dofs", "/errors/energy"),
                            series_of(meshes, "refined by the error: estimate", "/n_dofs", "/discretisation_indicator", true),
                            series_of(rows, "uniform: error", "/n_dofs", "/errors/energy"),
                            series_of(rows, "uniform: estimate", "/n_dofs", "/discretisation_indicator", true)};
      std::erase_if(by_unknowns.series, [](const PlotSeries &series) { return !has_points(series); });
      refined =
        "<h3>Refined by the error</h3>\n" +
        figure(by_unknowns, "The error in the energy norm, or its estimate, on uniform meshes and on those that are refined where it is.") +
        table_of(meshes, {{"cells", "/n_cells"},
                          {"unknowns", "/n_dofs"},
                          {"estimate", "/discretisation_indicator"},
                          {"error", "/errors/energy"},
                          {"of the norm", "/estimate/relative"},
                          {"guaranteed", "/estimate/guaranteed"},
                          {"contact force", "/total_contact_force"},
                          {"seconds", "/seconds"}});
    }
    return html_section("mesh-study", "Study of the mesh",
                        origin(folder, study) + figure(plot, "Errors, or differences between levels, by mesh size.") +
                          table_of(rows, columns) + (rates.empty() ? "" : html_table({"rate in h of", "from level to level"}, rates)) +
                          refined);
  }

  std::string quadrature_section(const ResultsFolder &folder)
  {
    if (!folder.study_quadrature)
      return "";
    return html_section("quadrature-study", "Study of the rules",
                        origin(folder, *folder.study_quadrature) +
                          table_of(at(*folder.study_quadrature, "/rows"), {{"rule", "/rule"},
                                                                           {"exact pairing", "/exact_pairing"},
                                                                           {"points", "/n_points"},
                                                                           {"C_h", "/C_h"},
                                                                           {"beta_h", "/beta_h"},
                                                                           {"nullity", "/nullity"},
                                                                           {"verdict", "/verdict"},
                                                                           {"contact force", "/total_contact_force"},
                                                                           {"pressure oscillation", "/pressure_oscillation"},
                                                                           {"error L2", "/errors/L2"},
                                                                           {"error of the pressure", "/errors/pressure_L2"},
                                                                           {"cannot be used", "/refused"}}));
  }

  std::string infsup_section(const ResultsFolder &folder)
  {
    if (!folder.infsup)
      return "";
    const Json &study = *folder.infsup, &rows = at(study, "/rows");
    Plot        plot{.title = "Inf-sup constants by mesh size",
                     .x_label = "h",
                     .y_label = "constant",
                     .x_log = true,
                     .y_log = true,
                     .series = {},
                     .slopes = {1},
                     .height = 340};
    plot.series = {series_of(rows, "C_h", "/h", "/C_h_nonzero"), series_of(rows, "beta_h", "/h", "/beta_h_nonzero"),
                   series_of(at(study, "/contact_rows"), "C_h in the contact zone", "/h", "/C_h_nonzero", true),
                   series_of(at(study, "/contact_rows"), "beta_h in the contact zone", "/h", "/beta_h_nonzero", true)};
    std::erase_if(plot.series, [](const PlotSeries &series) { return !has_points(series); });
    const std::vector<Column> columns = {{"level", "/level"},     {"h", "/h"},
                                         {"unknowns", "/n_dofs"}, {"points", "/n_points"},
                                         {"rank", "/rank"},       {"nullity", "/nullity"},
                                         {"C_h", "/C_h"},         {"smallest > 0", "/C_h_nonzero"},
                                         {"beta_h", "/beta_h"},   {"beta_h > 0", "/beta_h_nonzero"}};
    std::string               contact = table_of(at(study, "/contact_rows"), columns);
    return html_section(
      "infsup-study", "Inf-sup constants",
      origin(folder, study) +
        list_of(study, {{"verdict", "/verdict"}, {"because", "/advice"}, {"in the contact zone", "/contact_verdict"}}) +
        figure(
          plot,
          "Smallest values other than 0. A constant that falls like h is as well as a pair can do in the L2 norm; beta_h should stay.") +
        table_of(rows, columns) + (contact.empty() ? "" : "<h3>In the contact zone</h3>\n" + contact));
  }

  std::string sweep_section(const ResultsFolder &folder)
  {
    if (!folder.sweep)
      return "";
    const Json &sweep = *folder.sweep, &rows = at(sweep, "/rows");
    const Json &keys = at(sweep, "/over"), &quantities = at(sweep, "/quantities");
    if (!rows.is_array() || !keys.is_array() || !quantities.is_array())
      return "";
    const auto entry = [](const Json &row, const char *const group, const std::string &name) -> Json
    { return row.contains(group) && row[group].contains(name) ? row[group][name] : Json(); };
    Row headings, names;
    for (const Json &key : keys)
      headings.push_back(shown(at(key, "/key")));
    for (const Json &quantity : quantities)
      names.push_back(shown(quantity));
    const std::size_t n_keys = headings.size();
    headings.insert(headings.end(), names.begin(), names.end());
    headings.push_back("status");
    std::vector<Row> table;
    for (const Json &row : rows)
    {
      table.emplace_back();
      for (std::size_t k = 0; k < n_keys; ++k)
        table.back().push_back(shown(entry(row, "parameters", headings[k])));
      for (const std::string &name : names)
        table.back().push_back(shown(entry(row, "quantities", name)));
      table.back().push_back(shown(row, "/status"));
    }
    std::string plots;
    if (n_keys > 0)
      for (const std::string &name : names)
      {
        // One line for each combination of the other keys.
        Plot                     plot{.title = name, .x_label = headings[0], .y_label = name, .series = {}, .slopes = {}, .height = 300};
        std::vector<std::string> lines;
        for (const Json &row : rows)
        {
          std::string line;
          for (std::size_t k = 1; k < n_keys; ++k)
            line += fmt::format("{}{} = {}", line.empty() ? "" : ", ", headings[k], shown(entry(row, "parameters", headings[k])));
          const Json x = entry(row, "parameters", headings[0]), y = entry(row, "quantities", name);
          if (!x.is_number() || !y.is_number())
            continue;
          const auto found = std::find(lines.begin(), lines.end(), line);
          if (found == lines.end())
          {
            lines.push_back(line);
            plot.series.push_back({.name = line.empty() ? name : line, .x = {}, .y = {}});
          }
          PlotSeries &series =
            plot.series[std::size_t(found - lines.begin()) < plot.series.size() && found != lines.end() ? std::size_t(found - lines.begin())
                                                                                                        : plot.series.size() - 1];
          series.x.push_back(x.get<double>());
          series.y.push_back(y.get<double>());
        }
        if (!plot.series.empty() && plot.series[0].x.size() > 1)
          plots += figure(plot, name);
      }
    return html_section("sweep", "Sweep", html_table(headings, table) + plots);
  }

  std::string case_section(const ResultsFolder &folder)
  {
    const Json *json = nullptr;
    for (const auto *const found :
         {&folder.results, &folder.study_epsilon, &folder.study_mesh, &folder.study_quadrature, &folder.infsup, &folder.sweep})
      if (*found && !json)
        json = &**found;
    std::string html = list_of(*json, {{"case", "/case/path"},
                                       {"SHA-256 of the file", "/case/sha256"},
                                       {"command", "/command"},
                                       {"program", "/program/name"},
                                       {"version", "/program/version"},
                                       {"deal.II", "/program/dealii"},
                                       {"compiler", "/program/compiler"},
                                       {"processes", "/program/mpi_ranks"}});
    if (const Json &text = at(*json, "/case/expanded"); text.is_string())
      html += html_details("The case with its defaults", text.get<std::string>());
    if (!folder.log.empty())
      html +=
        html_details("run.log", folder.log.size() > 200000 ? folder.log.substr(0, 200000) + "\n... (the rest is in run.log)" : folder.log);
    return html_section("case", "Input, log, versions", html);
  }

  std::string downloads_section(const ResultsFolder &folder)
  {
    std::string list;
    for (const auto &[name, json] :
         {std::pair("results.json", &folder.results), std::pair("sweep.json", &folder.sweep),
          std::pair("study_epsilon.json", &folder.study_epsilon), std::pair("study_mesh.json", &folder.study_mesh),
          std::pair("study_quadrature.json", &folder.study_quadrature), std::pair("infsup.json", &folder.infsup)})
      if (*json)
        list += download(name, "application/json", (*json)->dump(2, ' ', false, Json::error_handler_t::replace));
    for (const auto &[name, text] : folder.csv)
      list += download(name, "text/csv", text);
    return html_section("downloads", "Downloads", "<ul>\n" + list + "</ul>\n");
  }
} // namespace unilateral
