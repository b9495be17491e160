#include "cli/summary.h"

#include "unilateral/base/visible_text.h"
#include "unilateral/case/expectations.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <sstream>

namespace unilateral
{
  namespace
  {
    std::string named(const std::string &text, const MessageName &name)
    {
      return fmt::format("{} [{}]", text, name.text);
    }

    using Row = std::vector<std::string>;

    constexpr std::size_t line_width = 100;

    /// Columns as wide as their widest entry, the first @p n_left to the left, the rest to the right.
    std::string aligned(std::vector<Row> rows, const std::size_t n_left)
    {
      for (Row &row : rows)
        for (std::string &entry : row)
          entry = visible(entry);
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

    /// Without the columns that have a heading and in every row nothing but "-" or nothing at all.
    std::vector<Row> without_empty_columns(const std::vector<Row> &rows)
    {
      std::vector<Row> result(rows.size());
      for (std::size_t column = 0; column < rows.at(0).size(); ++column)
      {
        const auto is_empty = [column](const Row &row) { return column >= row.size() || row[column].empty() || row[column] == "-"; };
        if (rows.size() > 1 && std::all_of(rows.begin() + 1, rows.end(), is_empty))
          continue;
        for (std::size_t k = 0; k < rows.size(); ++k)
          result[k].push_back(column < rows[k].size() ? rows[k][column] : "");
      }
      return result;
    }

    /// "-" for what was not computed, or not from numbers.
    std::string six_digits(const double value)
    {
      return std::isnan(value) ? "-" : fmt::format("{:#.6g}", value);
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

    /// A part of one: "24 %", "0.3 %", "2e-06".
    std::string share_text(const double share)
    {
      return share >= 0.1       ? fmt::format("{:.0f} %", 100 * share)
             : share >= 9.95e-4 ? fmt::format("{:.1f} %", 100 * share)
                                : fmt::format("{:.0e}", share);
    }

    /// What makes the largest part of the error less.
    std::string remedy(const Estimate &estimate)
    {
      if (estimate.discretisation >= std::max(estimate.penalty, estimate.algebraic))
        return "give mesh.adapt a tolerance for less";
      return estimate.penalty >= estimate.algebraic ? "a smaller method.epsilon makes it less" : "a smaller method.tolerance makes it less";
    }

    /// How far u may be from the exact solution, in parts of its energy norm where that is not zero. By a bound where there is one; else,
    /// the largest share first, what the mesh adds, which is an estimate, and what penalty and solver add, which is bounded.
    std::string uncertainty_text(const RunResult &result)
    {
      const double norm = result.reference_norm();
      const auto   size = [norm](const double error) { return norm > 0 ? share_text(error / norm) : fmt::format("{:.1e}", error); };

      if (result.estimate && result.estimate->goal)
      {
        const Estimate::Goal &goal = *result.estimate->goal;
        return std::isfinite(goal.error) ? fmt::format("{} = {} with an error of about {} (estimated, not guaranteed)", goal.quantity,
                                                       six_digits(goal.value), share_text(goal.relative()))
                                         : fmt::format("{} = {}: its error cannot be estimated, since {}", goal.quantity,
                                                       six_digits(goal.value), goal.why_no_error);
      }
      // The flux of a projection is u itself, which it finds point by point: there is nothing to recover it from.
      if (result.nothing_deforms() && result.m > 0)
        return (result.energy_norm > 0
                  ? fmt::format("nothing deforms: the energy norm of u, {:.1e}, cannot be told from zero", result.energy_norm)
                  : "nothing deforms: the energy norm of u is zero") +
               (result.estimate && result.estimate->guaranteed
                  ? fmt::format("; energy error to the exact solution at most {:.1e}, guaranteed", result.estimate->total)
                  : "");
      if (result.estimate && result.estimate->guaranteed)
      {
        const Estimate &estimate = *result.estimate;
        // Where its bound is far from sharp, as of a slender body, the estimate says more of how good the mesh is.
        const double      indicator = result.discretisation_indicator;
        const std::string estimated = norm > 0 && estimate.discretisation > std::max(0.5 * norm, 5 * indicator)
                                        ? fmt::format("; mesh error about {} (estimated)", size(indicator))
                                        : "";
        if (!result.certificate || !result.certificate->available)
          return fmt::format("energy error to the exact solution at most {}, guaranteed (mesh{} and solver together{}){}",
                             size(estimate.total), result.epsilon > 0 ? ", penalty" : "",
                             estimate.total > 0.1 * norm ? "; " + remedy(estimate) : "", estimated);
        return fmt::format("energy error to the exact solution at most {}, guaranteed (mesh {}{}, solver {}{}){}", size(estimate.total),
                           size(estimate.discretisation), result.epsilon > 0 ? ", penalty " + size(estimate.penalty) : "",
                           size(estimate.algebraic), estimate.total > 0.1 * norm ? "; " + remedy(estimate) : "", estimated);
      }
      const double mesh = result.m == 0 ? 0. : result.discretisation_indicator;
      std::string  of_mesh;
      if (result.m > 0)
      {
        of_mesh = fmt::format("mesh error about {}{} (estimated", size(mesh), result.sees_all_data ? "" : ", without what no point shows");
        of_mesh += norm > 0 && mesh > 0.1 * norm ? "; raise mesh.refine, or refine in places by [[mesh.local]])" : ")";
      }
      if (!result.certificate)
        return of_mesh;
      const std::string part = result.epsilon > 0 ? "penalty and solver" : "solver";
      if (!result.certificate->available)
      {
        const std::string none =
          fmt::format("no bound of the {}'s error: {}", result.epsilon > 0 ? "penalty" : "solver", result.certificate->reason);
        return of_mesh.empty() ? none : of_mesh + ", " + none;
      }
      const double      bound = result.certificate->penalty_error_bound;
      const std::string of_penalty = fmt::format("{} at most {} (guaranteed)", part, size(bound));
      if (of_mesh.empty())
        return of_penalty;
      return bound > mesh ? of_penalty + ", " + of_mesh : of_mesh + ", " + of_penalty;
    }

    /// @p text in lines of at most @p width characters, those after the first indented by four.
    std::string folded(const std::string &text, const std::size_t width)
    {
      std::istringstream words(visible(text));
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

  namespace
  {
    /// The pieces of contact, and what concentrated forces mean for the pressure.
    std::string components_text(const ConstraintResult &constraint)
    {
      std::vector<std::string> parts;
      for (const ContactComponent &component : *constraint.components)
      {
        if (parts.size() == 8)
        {
          parts.push_back(fmt::format("{} more", constraint.components->size() - parts.size()));
          break;
        }
        std::string place = fmt::format("{:.4g}", fmt::join(component.lower, ", "));
        if (component.n_points > 1)
          place = component.lower.size() == 1
                    ? fmt::format("{:.4g} to {:.4g}", component.lower[0], component.upper[0])
                    : fmt::format("({:.4g}) to ({:.4g})", fmt::join(component.lower, ", "), fmt::join(component.upper, ", "));
        parts.push_back(fmt::format("{}: {:.6g}{}", place, component.force,
                                    component.concentrated > 0 && component.distributed > 0
                                      ? fmt::format(" ({:.4g} of it concentrated)", component.concentrated)
                                      : ""));
      }
      return fmt::format(
        "contact at {}{}", fmt::join(parts, "; "),
        constraint.concentrated ? "; forces concentrated at points or lines: largest pressure and its norm grow with refinement" : "");
    }

    /// "forces: load (0, -20), contact (0, 20), out of balance by 7e-16"
    std::string forces_text(const ForceBalance &balance)
    {
      std::vector<std::string> parts;
      const auto               add = [&](const char *const name, const std::vector<double> &force)
      {
        if (std::any_of(force.begin(), force.end(), [](const double component) { return component != 0; }))
          parts.push_back(std::any_of(force.begin(), force.end(), [](const double component) { return std::isnan(component); })
                            ? fmt::format("{} unknown", name)
                            : fmt::format("{} ({:.6g})", name, fmt::join(force, ", ")));
      };
      add("load", balance.load);
      add("springs", balance.springs);
      add("supports", balance.reaction);
      add("contact", balance.contact);
      if (parts.empty())
        return "no forces";
      std::string text = fmt::format("forces on the body: {}; out of balance by {:.1e}", fmt::join(parts, ", "), balance.residual);
      if (!balance.side_conditions_on.empty())
        text += fmt::format("; neither contact nor load knows of a {}: a side condition stops it and bears {:.1e} of the load",
                            fmt::join(balance.side_conditions_on, " and a "), balance.side_conditions);
      return text;
    }

    /// "(0, -0.01)"; what is rounding beside the largest entry, or beside @p size, is 0.
    std::string vector_text(std::vector<double> values, double size = 0)
    {
      for (const double value : values)
        size = std::max(size, std::abs(value));
      for (double &value : values)
        if (std::abs(value) <= 1e-10 * size)
          value = 0;
      return fmt::format("({:.6g})", fmt::join(values, ", "));
    }

    /// "platen on top: moves by (0, -0.01), turns by (0.002); force on the body (0, -20), moment (1)". @p length: of the body's cells.
    std::string platen_text(const PlatenResult &platen, const double length)
    {
      double force = 0, motion = 0;
      for (const double component : platen.force)
        force = std::max(force, std::abs(component));
      for (const double component : platen.translation)
        motion = std::max(motion, std::abs(component));
      std::string text = fmt::format("platen on {}: moves by {}", platen.on, vector_text(platen.translation));
      if (!platen.rotation.empty())
        text += ", turns by " + vector_text(platen.rotation, motion / length);
      text += "; force on the body " + vector_text(platen.force);
      if (!platen.moment.empty())
        text += ", moment " + vector_text(platen.moment, force * length);
      return text;
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
    if (result.max_von_mises)
      text += fmt::format(", von Mises stress up to {}", six_digits(*result.max_von_mises));
    if (result.balance)
      text += "\n  " + forces_text(*result.balance);
    for (const PlatenResult &platen : result.platens)
      text += "\n  " + folded(platen_text(platen, result.h_max), line_width);
    if (result.reactions && !result.reactions->empty())
    {
      std::vector<std::string> parts;
      for (const SupportReaction &reaction : *result.reactions)
        parts.push_back(fmt::format("{} {:.6g}", reaction.on, reaction.force) +
                        (reaction.moment != 0 ? fmt::format(" (moment {:.6g})", reaction.moment) : ""));
      text += "\n  " + folded(fmt::format("supports bear {}", fmt::join(parts, ", ")), line_width);
    }
    for (const ConstraintResult &constraint : result.constraints)
      if (constraint.components && !constraint.components->empty())
        text += "\n  " + folded(components_text(constraint), line_width);
    std::string method = result.formulation;
    if (result.epsilon > 0)
      method += fmt::format(", epsilon {:.3g}{}{}", result.epsilon, result.epsilon_reason.empty() ? "" : ": ", result.epsilon_reason);
    text += "\n  " + folded(method, line_width);
    if (result.certificate && !result.certificate->available)
      text += "\n  " + folded("no certificate: " + result.certificate->reason, line_width);
    for (const ProbeResult &probe : result.probes)
      text += fmt::format("\n  u({:.6g}) = {:.10g}", fmt::join(probe.point, ", "), fmt::join(probe.value, ", "));
    for (const FunctionalResult &functional : result.functionals)
      text += fmt::format("\n  {} = {:.10g}", visible(functional.name), functional.value);
    if (result.errors)
      text += "\n  errors: " + errors_text(*result.errors);
    for (const ExpectationResult &expectation : result.expect)
      if (expectation.passed)
        text += "\n  ok  " + visible(to_string(expectation));
    return text;
  }

  std::string last_line(const RunResult &result, const std::string &directory)
  {
    if (!result.converged)
      return named(
        fmt::format("not converged: {}; the last state is in {}", result.reason.empty() ? "no reason given" : result.reason, directory),
        result.reason.starts_with("not in equilibrium") ? MessageName("not-in-equilibrium") : MessageName("not-converged"));
    Row failed;
    for (const ExpectationResult &expectation : result.expect)
      if (!expectation.passed)
        failed.push_back(expectation.asked.quantity);
    if (!failed.empty())
      return named(fmt::format("solved, but {} of {} {} ({}); results in {}", failed.size(), plural(result.expect.size(), "expectation"),
                               failed.size() == 1 ? "fails" : "fail", fmt::join(failed, ", "), directory),
                   MessageName("expectation-failed"));

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
               ? named(
                   fmt::format("solved, but the certificate does not hold: the penalty's error is only known to be below {}; results in {}",
                               error_text(*result.certificate), directory),
                   MessageName("certificate-missed"))
               : named(fmt::format("solved, but there is no certificate, so penalty_tolerance cannot be shown to hold: {}; results in {}",
                                   result.certificate->reason, directory),
                       MessageName("no-certificate"));
    if (result.estimate && result.estimate->cells_too_small)
      return named(
        fmt::format("solved, but mesh.adapt ends before its tolerance with cells of 1e-12 of the largest one (do prescribed values "
                    "jump, or does a force act at a point?): {}; results in {}",
                    uncertainty_text(result), directory),
        MessageName("tolerance-missed"));
    if (result.estimate && result.estimate->ended_by_rounding)
      return named(
        fmt::format("solved, but mesh.adapt ends before its tolerance, since rounding would make the error larger on finer cells: {}; "
                    "results in {}",
                    uncertainty_text(result), directory),
        MessageName("tolerance-missed"));
    if (result.estimate && !result.estimate->tolerance_met && result.estimate->goal && !result.estimate->goal->why_no_error.empty())
      return named(fmt::format("solved, but the tolerance of mesh.adapt cannot be shown to be met: {}; results in {}",
                               uncertainty_text(result), directory),
                   MessageName("tolerance-missed"));
    if (result.estimate && !result.estimate->tolerance_met)
      return named(fmt::format("solved, but mesh.adapt has reached max_unknowns before its tolerance: {}; results in {}",
                               uncertainty_text(result), directory),
                   MessageName("tolerance-missed"));
    if (const std::string uncertainty = uncertainty_text(result); !uncertainty.empty())
      numbers += "; " + uncertainty;
    if (!result.warnings.empty())
      numbers +=
        result.warnings.size() == 1 ? "; see the warning above" : fmt::format("; see the {} warnings above", result.warnings.size());
    return fmt::format("solved: {}; results in {}", numbers, directory);
  }

  std::string summary(const CheckReport &report, const unsigned dimension)
  {
    std::string text =
      fmt::format("  {}-D, element {}, cells {:.3g} to {:.3g} across\n", dimension, report.element, report.h_min, report.h_max);
    text += fmt::format("  linear solver: {}\n", report.linear_solver);
    text += fmt::format("  regions: {}\n", visible(fmt::format("{}", fmt::join(report.region_names, ", "))));

    std::vector<Row> rows = {{"part", "faces", dimension == 3 ? "area" : dimension == 2 ? "length" : "ends", "centre", "mean normal"}};
    const auto       vector_text = [](const std::vector<double> &v)
    {
      std::vector<std::string> numbers;
      for (const double x : v)
        numbers.push_back(fmt::format("{:.4g}", std::abs(x) < 1e-12 ? 0. : x));
      return v.empty() ? std::string("-") : fmt::format("({})", fmt::join(numbers, ", "));
    };
    for (const CheckReport::Part &part : report.parts)
      rows.push_back({visible(part.name), fmt::format("{}", part.n_faces), fmt::format("{:.5g}", part.measure), vector_text(part.centre),
                      vector_text(part.normal)});
    text += aligned(rows, 1) + "\n";

    rows = {{"level", "cells", "unknowns", "points"}};
    for (const CheckReport::Level &level : report.levels)
      rows.push_back({fmt::format("{}", level.level), fmt::format("{}", level.n_cells), fmt::format("{}", level.n_dofs),
                      fmt::format("{}", level.n_points)});
    text += aligned(rows, 0);

    if (!report.gaps.empty())
    {
      rows = {{"on", "bound", "rule", "exact pairing", "points", "smallest gap", "largest gap", "violated", "off the obstacle"}};
      for (const CheckReport::Gap &gap : report.gaps)
        rows.push_back({gap.on, gap.side, gap.quadrature, gap.exact_pairing ? "yes" : "no", fmt::format("{}", gap.n_points),
                        six_digits(gap.min), six_digits(gap.max), fmt::format("{:.1f} %", 100 * gap.share_violated),
                        gap.n_missed > 0 ? fmt::format("{} points", gap.n_missed) : "-"});
      text += "\n  gap between the boundary data, continued by zero, and the bounds:\n" + aligned(rows, 3);
    }
    for (const InfSupStudy &study : report.stability)
      text += "\n  stability on the coarsest levels:\n" + summary(study);
    return text;
  }

  std::string summary(const InfSupStudy &study)
  {
    const auto table = [&](const auto &constants_of_row)
    {
      std::vector<Row> rows = {{"level", "h", "unknowns", "points", "nullity", "C_h", "smallest > 0", "beta_h", "beta_h > 0"}};
      for (const auto &row : study.rows)
        if (const InfSup *const c = constants_of_row(row))
        {
          const auto optional = [](const std::optional<double> &value) { return value ? fmt::format("{:.4f}", *value) : "-"; };
          rows.push_back({fmt::format("{}", row.level), fmt::format("{:.4g}", row.h), fmt::format("{}", c->n_dofs),
                          fmt::format("{}", c->n_points), fmt::format("{}", c->nullity), fmt::format("{:.4g}", c->C_h),
                          fmt::format("{:.4g}", c->C_h_nonzero), optional(c->beta_h), optional(c->beta_h_nonzero)});
        }
      return rows.size() > 1 ? "\n" + aligned(without_empty_columns(rows), 0) : " none on these levels";
    };
    const auto pointer = [](const std::optional<InfSup> &constants) { return constants ? &*constants : nullptr; };
    const auto has = [&](const auto &member)
    { return std::any_of(study.rows.begin(), study.rows.end(), [&](const auto &row) { return (row.*member).has_value(); }); };
    std::string text = fmt::format("  {} with the rule {} on the {}; (q, v) = I_G(q v) {} (equation 14)\n  pressures anywhere:{}",
                                   study.element, study.quadrature, visible(study.on),
                                   study.exact_pairing ? "holds exactly" : "is not exact", table([](const auto &row) { return &row.all; }));
    if (has(&InfSupStudy::Row::by_L2))
      text +=
        "\n  pressures anywhere, paired by the L2 product instead of I_G:" + table([&](const auto &row) { return pointer(row.by_L2); });
    if (has(&InfSupStudy::Row::contact))
      text += "\n  pressures where the solution is in contact:" + table([&](const auto &row) { return pointer(row.contact); });
    if (!study.zone.empty())
      text += fmt::format("\n  pressures where {}:{}", visible(study.zone), table([&](const auto &row) { return pointer(row.zone); }));
    if (!study.stopped.empty())
      text += "\n  finer levels are left out: " + study.stopped;
    if (study.verdict)
      text += "\n  " + study.verdict->advice;
    if (study.contact_verdict && study.verdict && study.contact_verdict->stability != study.verdict->stability)
      text += fmt::format("\n  in the contact zone: {}: {}", to_string(study.contact_verdict->stability), study.contact_verdict->advice);
    return text;
  }

  namespace
  {
    std::string three_digits(const std::optional<double> &value)
    {
      return value ? fmt::format("{:.3g}", *value) : "-";
    }

    std::string exponent(const std::optional<double> &value)
    {
      return value ? fmt::format("{:.2f}", *value) : "-";
    }

    std::string short_error(const double value)
    {
      return fmt::format("{:.3e}", value);
    }
  } // namespace

  std::string summary(const EpsilonStudy &study)
  {
    const auto &c = study.constants;
    std::string text = fmt::format("  {} with the rule {}, {} unknowns; m = {}, M = {}, C_h = {} (where contact is: {}), beta_h = {}\n",
                                   study.element, study.quadrature, study.n_dofs, three_digits(c.m), three_digits(c.M), three_digits(c.C_h),
                                   three_digits(c.C_h_active), three_digits(c.beta_h));
    if (!c.missing.empty())
      text += "  no constants: " + c.missing + "\n";
    std::vector<Row> rows = {{"epsilon", "|u_h - u|_V", "bound (22)", "without C_h", "|u_h - u|_a", "from the gap", "|p_h - p|_0",
                              "bound (22)", "penetration", "force", "Newton"}};
    for (const auto &row : study.rows)
      rows.push_back({fmt::format("{:.3g}", row.epsilon), short_error(row.u_error_V), three_digits(row.bound_u_active),
                      three_digits(row.bound_u_lbb_free), short_error(row.u_error_energy), three_digits(row.bound_u_gap),
                      short_error(row.p_error_L2), three_digits(row.bound_p_active), fmt::format("{:.1e}", row.max_penetration),
                      six_digits(row.total_contact_force),
                      fmt::format("{}{}", row.newton_iterations,
                                  !row.converged     ? " !"
                                  : row.at_round_off ? " ~"
                                                     : "")});
    text += aligned(without_empty_columns(rows), 0);
    if (std::any_of(study.rows.begin(), study.rows.end(), [](const auto &row) { return row.at_round_off; }))
      text += "\n  ~ below 1e-12 of u: round-off";
    text += fmt::format("\n  mixed method: |p_h|_0 = {}, force {}\n", six_digits(study.reference.norm_p),
                        six_digits(study.reference.total_contact_force));
    text += fmt::format("  slopes at the small end: u {}, p {}\n", exponent(study.slope_u), exponent(study.slope_p));
    const auto &h = study.hypotheses;
    const auto  yes = [](const std::optional<bool> &value) { return !value ? "not computed" : *value ? "yes" : "no"; };
    text += fmt::format("  hypotheses: a coercive (3): {}; (14): {}; s in V_h: {}; C_h > 0 (20): {}, where contact is: {}\n",
                        yes(h.coercive), yes(h.exact_pairing), yes(h.obstacle_in_V_h), yes(h.lbb), yes(h.lbb_active));
    const auto seen = [](const std::optional<bool> &value) { return !value ? "no bound" : *value ? "holds" : "FAILS"; };
    text += fmt::format("  seen: Theorem 1 {}; Theorem 2 {}; Theorem 3 u {}, p {}; bound without C_h {}; duality gap {}",
                        seen(study.holds.theorem1_bounded), seen(study.holds.theorem2), seen(study.holds.theorem3_u),
                        seen(study.holds.theorem3_p), seen(study.holds.lbb_free), seen(study.holds.gap));
    return text;
  }

  std::string conclusion(const EpsilonStudy &study)
  {
    const auto &holds = study.holds;
    Row         held, failed, without;
    const auto  sort = [&](const char *name, const std::optional<bool> &value) {
      (!value ? without : *value ? held : failed).push_back(name);
    };
    sort("1", holds.theorem1_bounded);
    sort("2", holds.theorem2);
    sort("3", holds.theorem3_u && holds.theorem3_p ? std::optional<bool>(*holds.theorem3_u && *holds.theorem3_p) : std::nullopt);
    std::string text;
    const auto  add = [&](const Row &names, const char *verb, const char *verbs)
    {
      if (!names.empty())
      {
        const std::string list =
          names.size() == 3 ? fmt::format("{}, {} and {}", names[0], names[1], names[2]) : fmt::format("{}", fmt::join(names, " and "));
        text +=
          fmt::format("{}Theorem{} {} {}", text.empty() ? "" : ", ", names.size() == 1 ? "" : "s", list, names.size() == 1 ? verb : verbs);
      }
    };
    add(held, "holds", "hold");
    add(failed, "is not seen to hold", "are not seen to hold");
    add(without, "gives no bound here", "give no bound here");
    return text;
  }

  namespace
  {
    std::string adaptive_table(const AdaptiveMeshes &study)
    {
      const bool energy =
        std::any_of(study.rows.begin(), study.rows.end(), [](const auto &row) { return row.errors && row.errors->energy; });
      const auto       order = orders(study);
      std::vector<Row> rows(1, {"cells", "unknowns", "estimated"});
      if (energy)
        rows[0].push_back("energy error");
      rows[0].insert(rows[0].end(), {"order", "of the norm", "force", "seconds"});
      for (std::size_t k = 0; k < study.rows.size(); ++k)
      {
        const auto &row = study.rows[k];
        rows.push_back({fmt::format("{}", row.n_cells), fmt::format("{}", row.n_dofs), short_error(row.discretisation_indicator)});
        if (energy)
          rows.back().push_back(row.errors->energy ? short_error(*row.errors->energy) : "-");
        rows.back().insert(rows.back().end(), {k > 0 ? exponent(order[k - 1]) : "",
                                               fmt::format("{}{:.3g} %", row.guaranteed ? "at most " : "about ", 100 * row.relative),
                                               six_digits(row.total_contact_force), fmt::format("{:.2f}", row.seconds)});
      }
      if (!study.converged)
        rows.back()[1] += " !";
      return fmt::format(
        "\n  refined by the error{}; order: in the number of unknowns\n{}",
        study.tolerance > 0 ? fmt::format(" until it is {:g} of the norm, or {} unknowns", study.tolerance, study.max_unknowns) : "",
        aligned(without_empty_columns(rows), 0));
    }
  } // namespace

  std::string summary(const MeshStudy &study)
  {
    const auto       columns = error_columns(study);
    std::vector<Row> rows(1, {"level", "h", "unknowns", "epsilon"});
    for (const auto &column : columns)
    {
      rows[0].push_back(column.name);
      rows[0].push_back("rate");
    }
    const bool has_stress = std::any_of(study.rows.begin(), study.rows.end(), [](const auto &row) { return row.max_von_mises; });
    rows[0].insert(rows[0].end(), {"force", "area", "max pressure"});
    if (has_stress)
      rows[0].push_back("von Mises");
    rows[0].insert(rows[0].end(), {"Newton", "seconds"});
    for (const auto &row : study.rows)
      rows.push_back({fmt::format("{}", row.level), fmt::format("{:.4g}", row.h), fmt::format("{}", row.n_dofs),
                      row.epsilon > 0 ? fmt::format("{:.2e}", row.epsilon) : "mixed"});
    for (const auto &column : columns)
    {
      const auto rate = rates(study, column);
      for (std::size_t k = 0; k < study.rows.size(); ++k)
      {
        const auto value = column.value(study.rows[k]);
        rows[k + 1].push_back(value ? short_error(*value) : "-");
        rows[k + 1].push_back(k > 0 ? exponent(rate[k - 1]) : "");
      }
    }
    for (std::size_t k = 0; k < study.rows.size(); ++k)
    {
      const auto &row = study.rows[k];
      rows[k + 1].insert(rows[k + 1].end(), {six_digits(row.total_contact_force), fmt::format("{:.4g}", row.contact_measure),
                                             fmt::format("{:.4g}", row.max_contact_pressure)});
      if (has_stress)
        rows[k + 1].push_back(row.max_von_mises ? fmt::format("{:.4g}", *row.max_von_mises) : "-");
      rows[k + 1].insert(rows[k + 1].end(),
                         {fmt::format("{}{}", row.newton_iterations, row.converged ? "" : " !"), fmt::format("{:.2f}", row.seconds)});
    }
    return fmt::format("  {} with the rule {}, epsilon {}\n{}", study.element, study.quadrature, study.epsilon_rule,
                       aligned(without_empty_columns(rows), 0)) +
           (study.adaptive ? adaptive_table(*study.adaptive) : "");
  }

  std::string summary(const QuadratureStudy &study)
  {
    std::vector<Row> rows = {{"rule", "verdict", "(14)", "points", "nullity", "C_h", "beta_h", "force", "oscillation"}};
    const auto       error_of = [](const QuadratureStudy::Row &row, const auto member) -> std::optional<double>
    { return row.errors ? (*row.errors).*member : std::nullopt; };
    const bool errors = std::any_of(study.rows.begin(), study.rows.end(), [](const auto &row) { return row.errors.has_value(); });
    if (errors)
      rows[0].insert(rows[0].end(), {"error L2", "H1", "pressure"});
    std::string refused;
    for (const auto &row : study.rows)
    {
      if (!row.refused.empty())
      {
        refused += fmt::format("\n  {}: {}", row.rule, row.refused);
        continue;
      }
      Row line = {row.rule,
                  row.stability ? to_string(*row.stability) : "-",
                  row.exact_pairing ? "yes" : "no",
                  fmt::format("{}", row.n_points),
                  row.constants ? fmt::format("{}", row.constants->nullity) : "-",
                  row.constants ? fmt::format("{:.4g}", row.constants->C_h) : "-",
                  row.constants ? three_digits(row.constants->beta_h) : "-",
                  six_digits(row.total_contact_force) + (row.converged ? "" : " !"),
                  three_digits(row.pressure_oscillation)};
      if (errors)
        line.insert(line.end(), {three_digits(error_of(row, &Errors::L2)), three_digits(error_of(row, &Errors::H1_semi)),
                                 three_digits(error_of(row, &Errors::pressure_L2))});
      rows.push_back(line);
    }
    return fmt::format("  {}\n{}{}", study.element, aligned(without_empty_columns(rows), 2), refused) +
           (study.missing.empty() ? "" : "\n  no constants: " + study.missing);
  }

  std::string conclusion(const QuadratureStudy &study)
  {
    const auto with = [&study](const std::optional<Stability> stability)
    {
      Row names;
      for (const auto &row : study.rows)
        if (row.refused.empty() && row.stability == stability)
          names.push_back(row.rule);
      return fmt::format("{}", fmt::join(names, ", "));
    };
    Row parts;
    if (const std::string stable = with(Stability::stable); !stable.empty())
      parts.push_back("stable: " + stable);
    if (const std::string weak = with(Stability::weakly_unstable); !weak.empty())
      parts.push_back("pressure may oscillate: " + weak);
    if (const std::string kernel = with(Stability::kernel); !kernel.empty())
      parts.push_back("pressure not unique: " + kernel);
    if (const std::string unknown = with({}); !unknown.empty())
      parts.push_back("too few levels for a verdict: " + unknown);
    return fmt::format("studied {}; {}", plural(study.rows.size(), "rule"), fmt::join(parts, "; "));
  }
} // namespace unilateral
