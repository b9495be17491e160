#include "cli/summary.h"

#include <fmt/format.h>

#include <algorithm>
#include <numeric>
#include <sstream>

namespace unilateral
{
  namespace
  {
    using Row = std::vector<std::string>;

    constexpr std::size_t line_width = 100;

    /// Columns as wide as their widest entry, the first @p n_left to the left, the rest to the right.
    std::string aligned(const std::vector<Row> &rows, const std::size_t n_left)
    {
      std::vector<std::size_t> widths;
      for (const Row &row : rows)
      {
        widths.resize(std::max(widths.size(), row.size()));
        for (std::size_t column = 0; column < row.size(); ++column)
          widths[column] = std::max(widths[column], row[column].size());
      }
      std::string text;
      for (const Row &row : rows)
      {
        std::string line;
        for (std::size_t column = 0; column < row.size(); ++column)
          line +=
            column < n_left ? fmt::format("  {:<{}}", row[column], widths[column]) : fmt::format("  {:>{}}", row[column], widths[column]);
        line.erase(line.find_last_not_of(' ') + 1);
        text += (text.empty() ? "" : "\n") + line;
      }
      return text;
    }

    std::string six_digits(const double value)
    {
      return fmt::format("{:#.6g}", value);
    }

    std::string plural(const std::size_t n, const std::string &noun)
    {
      return fmt::format("{} {}{}", n, noun, n == 1 ? "" : "s");
    }

    std::string errors_text(const Errors &errors)
    {
      Row        parts;
      const auto add = [&parts](const char *name, const std::optional<double> &value)
      {
        if (value)
          parts.push_back(fmt::format("{} {:.3e}", name, *value));
      };
      add("L2", errors.L2);
      add("H1 seminorm", errors.H1_semi);
      add("largest at a node", errors.max_nodal);
      add("mean at the nodes", errors.mean_nodal);
      add("pressure L2", errors.pressure_L2);
      return fmt::format("{}", fmt::join(parts, ", "));
    }

    /// The bound, and what it is of the energy norm.
    std::string error_text(const Certificate &certificate)
    {
      const double bound = certificate.penalty_error_bound, norm = certificate.energy_norm;
      return fmt::format("{:.1e}", bound) + (norm > 0 ? fmt::format(" ({:.0e} of the energy norm)", bound / norm) : "");
    }

    /// @p text in lines of at most @p width characters, those after the first indented by four.
    std::string wrapped(const std::string &text, const std::size_t width)
    {
      std::istringstream words(text);
      std::string        result, line, word;
      while (words >> word)
      {
        if (!line.empty() && line.size() + 1 + word.size() > width)
        {
          result += line + "\n";
          line = "   ";
        }
        line += (line.empty() ? "" : " ") + word;
      }
      return result + line;
    }
  } // namespace

  std::string summary(const RunResult &result)
  {
    std::string text;
    if (!result.constraints.empty())
    {
      std::vector<Row> rows = {
        {"on", "bound", "rule", "points", "active", "contact force", "contact measure", "max pressure", "penetration"}};
      for (const ConstraintResult &constraint : result.constraints)
        rows.push_back({constraint.on, constraint.side, constraint.quadrature, fmt::format("{}", constraint.n_points),
                        fmt::format("{}", constraint.n_active), six_digits(constraint.total_contact_force),
                        six_digits(constraint.contact_measure), six_digits(constraint.max_contact_pressure),
                        fmt::format("{:.1e}", constraint.max_penetration)});
      text += aligned(rows, 3) + "\n";
    }
    text += fmt::format("  energy {}, u in [{}, {}]", six_digits(result.energy), six_digits(result.min), six_digits(result.max));
    std::string method = result.formulation;
    if (result.epsilon > 0)
      method += fmt::format(", epsilon {:.3g}{}{}", result.epsilon, result.epsilon_reason.empty() ? "" : ": ", result.epsilon_reason);
    text += "\n  " + wrapped(method, line_width);
    if (result.certificate && !result.certificate->available)
      text += "\n  " + wrapped("no certificate: " + result.certificate->reason, line_width);
    for (const ProbeResult &probe : result.probes)
      text += fmt::format("\n  u({:.6g}) = {:.10g}", fmt::join(probe.point, ", "), probe.value);
    if (result.errors)
      text += "\n  errors: " + errors_text(*result.errors);
    for (const ExpectationResult &expectation : result.expect)
      if (expectation.passed)
        text += "\n  ok  " + to_string(expectation);
    return text;
  }

  std::string last_line(const RunResult &result, const std::string &directory)
  {
    if (!result.converged)
      return fmt::format("not converged: {}; the last state is in {}", result.reason.empty() ? "no reason given" : result.reason,
                         directory);
    Row failed;
    for (const ExpectationResult &expectation : result.expect)
      if (!expectation.passed)
        failed.push_back(expectation.asked.quantity);
    if (!failed.empty())
      return fmt::format("solved, but {} of {} {} ({}); results in {}", failed.size(), plural(result.expect.size(), "expectation"),
                         failed.size() == 1 ? "fails" : "fail", fmt::join(failed, ", "), directory);

    std::string numbers;
    if (result.constraints.empty())
      numbers = "energy " + six_digits(result.energy);
    else
    {
      double penetration = 0;
      Row    forces;
      for (const ConstraintResult &constraint : result.constraints)
      {
        penetration = std::max(penetration, constraint.max_penetration);
        forces.push_back(six_digits(constraint.total_contact_force));
      }
      numbers =
        fmt::format("penetration {:.1e}, contact force{} {}", penetration, forces.size() == 1 ? "" : "s", fmt::join(forces, " and "));
    }
    if (result.certificate && !result.certificate_holds)
      return result.certificate->available
               ? fmt::format("solved, but the certificate does not hold: the penalty's error is only known to be below {}; results in {}",
                             error_text(*result.certificate), directory)
               : fmt::format("solved, but there is no certificate, so penalty_tolerance cannot be shown to hold: {}; results in {}",
                             result.certificate->reason, directory);
    if (result.certificate && result.certificate->available)
      numbers += fmt::format(", energy error from the {} at most {}, guaranteed", result.epsilon > 0 ? "penalty" : "solver",
                             error_text(*result.certificate));
    return fmt::format("solved: {}; results in {}", numbers, directory);
  }

  std::string summary(const CheckReport &report, const unsigned dimension)
  {
    std::string text = fmt::format("  {}-D, element {}, h from {:.3g} to {:.3g}\n", dimension, report.element, report.h_min, report.h_max);
    text += fmt::format("  parts of the boundary: {}\n", fmt::join(report.part_names, ", "));
    text += fmt::format("  regions: {}\n", fmt::join(report.region_names, ", "));

    std::vector<Row> rows = {{"level", "cells", "unknowns", "points"}};
    for (const CheckReport::Level &level : report.levels)
      rows.push_back({fmt::format("{}", level.level), fmt::format("{}", level.n_cells), fmt::format("{}", level.n_dofs),
                      fmt::format("{}", level.n_points)});
    text += aligned(rows, 0);

    if (!report.gaps.empty())
    {
      rows = {{"on", "bound", "rule", "exact pairing", "points", "smallest gap", "largest gap", "violated"}};
      for (const CheckReport::Gap &gap : report.gaps)
        rows.push_back({gap.on, gap.side, gap.quadrature, gap.exact_pairing ? "yes" : "no", fmt::format("{}", gap.n_points),
                        six_digits(gap.min), six_digits(gap.max), fmt::format("{:.1f} %", 100 * gap.share_violated)});
      text += "\n  gap between the boundary data, continued by zero, and the bounds:\n" + aligned(rows, 3);
    }
    return text;
  }

  std::string summary(const InfSupStudy &study)
  {
    const auto table = [&](const bool zone)
    {
      std::vector<Row> rows = {{"level", "h", "unknowns", "points", "nullity", "C_h", "smallest > 0", "beta_h"}};
      for (const auto &row : study.rows)
        if (!zone || row.zone)
        {
          const InfSup &c = zone ? *row.zone : row.all;
          rows.push_back({fmt::format("{}", row.level), fmt::format("{:.4g}", row.h), fmt::format("{}", c.n_dofs),
                          fmt::format("{}", c.n_points), fmt::format("{}", c.nullity), fmt::format("{:.4g}", c.C_h),
                          fmt::format("{:.4g}", c.C_h_nonzero), c.beta_h ? fmt::format("{:.4f}", *c.beta_h) : "-"});
        }
      return aligned(rows, 0);
    };
    std::string text =
      fmt::format("  {} with the rule {} on the {}; (q, v) = I_G(q v) {} (equation 14)\n  pressures anywhere:\n{}", study.element,
                  study.quadrature, study.on, study.exact_pairing ? "holds exactly" : "is not exact", table(false));
    if (!study.zone.empty())
      text += fmt::format("\n  pressures where {}:\n{}", study.zone, table(true));
    if (!study.stopped.empty())
      text += "\n  stopped: " + study.stopped;
    if (study.verdict)
      text += "\n  " + study.verdict->advice;
    return text;
  }
} // namespace unilateral
