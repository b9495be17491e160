#include "unilateral/report/verdict.h"

#include "unilateral/report/html.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <optional>

namespace unilateral
{
  namespace
  {
    using Json = nlohmann::ordered_json;
    using Kind = VerdictItem::Kind;

    std::optional<double> number_in(const Json &json, const std::string &path)
    {
      const Json::json_pointer pointer(path);
      if (!json.contains(pointer) || !json[pointer].is_number())
        return {};
      return json[pointer].get<double>();
    }

    std::string text_in(const Json &json, const std::string &path)
    {
      const Json::json_pointer pointer(path);
      return json.contains(pointer) && json[pointer].is_string() ? json[pointer].get<std::string>() : "";
    }

    bool flag_in(const Json &json, const std::string &path, const bool otherwise)
    {
      const Json::json_pointer pointer(path);
      return json.contains(pointer) && json[pointer].is_boolean() ? json[pointer].get<bool>() : otherwise;
    }

    std::string share(const double part)
    {
      return part >= 1      ? fmt::format("{:.0f} %", 100 * part)
             : part >= 1e-3 ? fmt::format("{:.2g} %", 100 * part)
                            : fmt::format("{:.0e}", part);
    }

    std::optional<double> relative(const Json &results, const std::string &path)
    {
      const auto value = number_in(results, path), norm = number_in(results, "/solution/norm_energy");
      if (!value || !norm || !(*norm > 0) || flag_in(results, "/estimate/nothing_deforms", false))
        return {};
      return *value / *norm;
    }

    VerdictItem convergence(const Json &results)
    {
      const bool  converged = text_in(results, "/status") == "converged";
      VerdictItem item{converged ? Kind::good : Kind::bad, "Solver", text_in(results, "/solver/reason"), "", ""};
      if (const auto tolerance = number_in(results, "/method/tolerance"))
        item.threshold = fmt::format("tolerance {:g}", *tolerance);
      if (const auto levels = results.find("levels"); levels != results.end() && levels->is_array() && !levels->empty())
        if (const auto residual = number_in(levels->back(), "/residual"))
          item.number += fmt::format(" (residual {:.1e})", *residual);
      if (!converged)
        item.next =
          "The last state is shown, not a solution. Look at the log below; a coarser mesh that is refined (mesh.refine) starts closer, "
          "method.max_iterations allows more steps.";
      return item;
    }

    void add_balance(const Json &results, std::vector<VerdictItem> &items)
    {
      if (const auto residual = number_in(results, "/balance/residual"))
        items.push_back({*residual <= 1e-6 ? Kind::good : Kind::bad, "Equilibrium of forces and moments",
                         fmt::format("out of balance by {:.1e} of the forces", *residual), "at most 1e-06",
                         *residual <= 1e-6 ? "" : "Not in equilibrium: check what holds the body, and the log."});
    }

    void add_mesh_error(const Json &results, std::vector<VerdictItem> &items)
    {
      if (const auto mesh = relative(results, "/certificate/discretisation_indicator"))
        items.push_back({*mesh <= 0.1 ? Kind::good : Kind::doubtful, "Error of the mesh (estimated)",
                         fmt::format("about {} of the energy norm", share(*mesh)), "10 %",
                         *mesh <= 0.1 ? "" : "Refine: mesh.refine one higher halves the cells; or a higher degree, model.element."});
    }

    void add_goal(const Json &results, std::vector<VerdictItem> &items)
    {
      const std::string quantity = text_in(results, "/estimate/goal/quantity");
      if (quantity.empty())
        return;
      const std::string title = fmt::format("Error of {} (estimated)", quantity), tolerance = "the tolerance of mesh.adapt";
      const auto        relative = number_in(results, "/estimate/goal/relative");
      if (!relative)
      {
        items.push_back({Kind::bad, title, "cannot be estimated", tolerance,
                         fmt::format("It cannot be estimated, since {}.", text_in(results, "/estimate/goal/reason"))});
        return;
      }
      const bool met = flag_in(results, "/estimate/tolerance_met", true);
      items.push_back(
        {met ? Kind::good : Kind::bad, title, fmt::format("about {} of it", share(*relative)), tolerance,
         met ? "" : "The tolerance of mesh.adapt is not met: raise its max_unknowns, or take a higher degree, model.element."});
    }

    /// No error is a share of an energy norm that is zero.
    void add_nothing_deforms(const Json &results, std::vector<VerdictItem> &items)
    {
      const double norm = number_in(results, "/solution/norm_energy").value_or(0),
                   error = number_in(results, "/estimate/total").value_or(0);
      items.push_back({Kind::good, "Error in the energy norm",
                       flag_in(results, "/estimate/guaranteed", false) ? fmt::format("at most {:.1e}, guaranteed", error)
                                                                       : fmt::format("about {:.1e}, estimated", error),
                       "", fmt::format("Nothing deforms: the energy norm of u, {:.1e}, cannot be told from zero.", norm)});
    }

    void add_errors(const Json &results, std::vector<VerdictItem> &items)
    {
      add_goal(results, items);
      if (flag_in(results, "/estimate/nothing_deforms", false))
      {
        add_nothing_deforms(results, items);
        return;
      }
      if (const auto total = number_in(results, "/estimate/relative"); total && flag_in(results, "/estimate/guaranteed", false))
      {
        const bool  met = flag_in(results, "/estimate/tolerance_met", true) || !text_in(results, "/estimate/goal/quantity").empty();
        std::string next;
        if (!met)
          next = "The tolerance of mesh.adapt is not met: raise its max_unknowns, or take a higher degree, model.element.";
        else if (*total > 0.1)
          next = "Refine: mesh.adapt with a tolerance chooses the cells; or take a higher degree, model.element.";
        items.push_back({!met           ? Kind::bad
                         : *total > 0.1 ? Kind::doubtful
                                        : Kind::good,
                         "Error to the exact solution (guaranteed)", fmt::format("at most {} of the energy norm", share(*total)),
                         "10 %, or the tolerance of mesh.adapt", next});
      }
      else
        add_mesh_error(results, items);
      if (flag_in(results, "/certificate/available", false))
      {
        if (const auto bound = relative(results, "/certificate/penalty_error_bound"))
        {
          const bool holds = flag_in(results, "/certificate/holds", true);
          items.push_back({holds ? Kind::good : Kind::bad, "Error of penalty and solver (guaranteed)",
                           fmt::format("at most {} of the energy norm", share(*bound)), "method.penalty_tolerance, where it is given",
                           holds ? "" : "Choose epsilon = \"auto\" or a smaller epsilon, or a smaller method.tolerance."});
        }
      }
      else if (const std::string reason = text_in(results, "/certificate/reason"); !reason.empty())
        items.push_back({Kind::doubtful, "Error of penalty and solver", "no bound", "", "There is none: " + reason + "."});
    }

    void add_contact(const Json &results, std::vector<VerdictItem> &items)
    {
      if (const auto constraints = results.find("constraint"); constraints != results.end() && constraints->is_array())
        for (const Json &constraint : *constraints)
          if (const auto active = number_in(constraint, "/n_active"), force = number_in(constraint, "/total_contact_force");
              active && force)
            items.push_back({Kind::good, fmt::format("Contact on {}, {} bound", text_in(constraint, "/on"), text_in(constraint, "/side")),
                             *active > 0 ? fmt::format("force {}, {} of {} points", number_text(*force), *active,
                                                       number_in(constraint, "/n_points").value_or(0))
                                         : "none: nothing touches",
                             "", ""});
    }

    void add_expectations(const Json &results, std::vector<VerdictItem> &items)
    {
      const auto expectations = results.find("expect");
      if (expectations == results.end() || !expectations->is_array())
        return;
      for (const Json &expected : *expectations)
      {
        const bool  passed = flag_in(expected, "/passed", false);
        std::string threshold;
        if (const auto value = number_in(expected, "/expected"))
          threshold = fmt::format(
            "{:.10g} ± {}", *value,
            number_text(number_in(expected, "/atol").value_or(0) + number_in(expected, "/rtol").value_or(0) * std::abs(*value)));
        if (const auto low = number_in(expected, "/min"))
          threshold += fmt::format("{}at least {:.10g}", threshold.empty() ? "" : ", ", *low);
        if (const auto high = number_in(expected, "/max"))
          threshold += fmt::format("{}at most {:.10g}", threshold.empty() ? "" : ", ", *high);
        items.push_back(
          {passed ? Kind::good : Kind::bad, "Expected: " + text_in(expected, "/quantity"),
           fmt::format("{:.10g}", number_in(expected, "/value").value_or(std::nan(""))), threshold,
           passed ? "" : "Not as the case expects: is the mesh fine enough (see its error above), is the expectation right?"});
      }
    }
  } // namespace

  std::vector<VerdictItem> verdict_of(const Json &results)
  {
    std::vector<VerdictItem> items = {convergence(results)};
    add_balance(results, items);
    add_errors(results, items);
    add_contact(results, items);
    add_expectations(results, items);
    if (const auto warnings = results.find("warnings"); warnings != results.end() && warnings->is_array())
      for (const Json &warning : *warnings)
        items.push_back({Kind::doubtful, "Warning", text_in(warning, "/message"), "", ""});
    return items;
  }

  std::string verdict_sentence(const Json &results)
  {
    if (text_in(results, "/status") != "converged")
      return "not converged: " + text_in(results, "/solver/reason");
    std::string sentence = "solved";
    const auto  expectations = results.find("expect");
    if (expectations != results.end() && expectations->is_array())
      if (const auto failed = std::count_if(expectations->begin(), expectations->end(),
                                            [](const Json &expected) { return !flag_in(expected, "/passed", false); });
          failed > 0)
        sentence = fmt::format("solved, but {} of {} expectations fail", failed, expectations->size());
    if (flag_in(results, "/estimate/nothing_deforms", false))
      return sentence + "; nothing deforms";
    if (const auto total = number_in(results, "/estimate/relative"); total && flag_in(results, "/estimate/guaranteed", false))
      return sentence + fmt::format("; error to the exact solution at most {} (guaranteed)", share(*total));
    if (const auto mesh = relative(results, "/certificate/discretisation_indicator"))
      sentence += fmt::format("; mesh error about {} (estimated)", share(*mesh));
    if (const auto bound = relative(results, "/certificate/penalty_error_bound");
        bound && flag_in(results, "/certificate/available", false))
      sentence += fmt::format(", penalty and solver at most {} (guaranteed)", share(*bound));
    return sentence;
  }
} // namespace unilateral
