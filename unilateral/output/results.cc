#include "unilateral/output/results.h"

#include <deal.II/base/config.h>
#include <deal.II/base/vectorization.h>

#include <nlohmann/json.hpp>

#include <sys/resource.h>

#include <algorithm>
#include <cmath>

namespace unilateral
{
  using Json = nlohmann::ordered_json;

  namespace
  {
    Json number(const double value)
    {
      return std::isfinite(value) ? Json(value) : Json(nullptr);
    }

    Json numbers(const std::vector<double> &values)
    {
      Json array = Json::array();
      for (const double value : values)
        array.push_back(number(value));
      return array;
    }

    Json constraint_json(const ConstraintResult &constraint)
    {
      Json json;
      json["on"] = constraint.on;
      json["side"] = constraint.side;
      json["quadrature"] = constraint.quadrature;
      json["n_points"] = constraint.n_points;
      json["n_active"] = constraint.n_active;
      json["exact_pairing"] = constraint.exact_pairing;
      json["contact_measure"] = number(constraint.contact_measure);
      json["total_contact_force"] = number(constraint.total_contact_force);
      json["max_contact_pressure"] = number(constraint.max_contact_pressure);
      json["pressure_L2"] = number(constraint.pressure_L2);
      json["max_penetration"] = number(constraint.max_penetration);
      json["complementarity"] = number(constraint.complementarity);
      if (constraint.max_violation_between_points)
        json["max_violation_between_points"] = number(*constraint.max_violation_between_points);
      if (constraint.components)
      {
        json["concentrated"] = constraint.concentrated;
        json["components"] = Json::array();
        for (const ContactComponent &component : *constraint.components)
        {
          Json entry;
          entry["n_points"] = component.n_points;
          entry["measure"] = number(component.measure);
          entry["force"] = number(component.force);
          entry["distributed"] = number(component.distributed);
          entry["concentrated"] = number(component.concentrated);
          entry["resolved"] = component.resolved;
          entry["lower"] = numbers(component.lower);
          entry["upper"] = numbers(component.upper);
          json["components"].push_back(std::move(entry));
        }
      }
      if (!constraint.contact_force.empty())
      {
        json["contact_force"] = numbers(constraint.contact_force);
        json["contact_moment"] = numbers(constraint.contact_moment);
        json["n_missed"] = constraint.n_missed;
      }
      return json;
    }

    Json balance_json(const ForceBalance &balance)
    {
      Json json;
      json["load"] = numbers(balance.load);
      json["springs"] = numbers(balance.springs);
      json["contact"] = numbers(balance.contact);
      json["reaction"] = numbers(balance.reaction);
      json["residual"] = number(balance.residual);
      json["side_conditions"] = number(balance.side_conditions);
      json["reactions"] = Json::array();
      for (const auto &reaction : balance.reactions)
      {
        Json entry;
        entry["on"] = reaction.on;
        entry["force"] = numbers(reaction.force);
        json["reactions"].push_back(std::move(entry));
      }
      return json;
    }

    Json platen_json(const PlatenResult &platen)
    {
      Json json;
      json["on"] = platen.on;
      json["about"] = numbers(platen.about);
      json["translation"] = numbers(platen.translation);
      json["rotation"] = numbers(platen.rotation);
      json["force"] = numbers(platen.force);
      json["moment"] = numbers(platen.moment);
      return json;
    }

    Json solution_json(const RunResult &result)
    {
      Json json;
      json["energy"] = number(result.energy);
      json["norm_L2"] = number(result.norm_L2);
      json["norm_H1_semi"] = number(result.norm_H1_semi);
      if (result.norm_H2_semi)
        json["norm_H2_semi"] = number(*result.norm_H2_semi);
      json["norm_energy"] = number(result.energy_norm);
      json["min"] = number(result.min);
      json["max"] = number(result.max);
      if (result.max_von_mises)
        json["max_von_mises"] = number(*result.max_von_mises);
      for (const FunctionalResult &functional : result.functionals)
        json["functionals"][functional.name] = number(functional.value);
      json["probes"] = Json::array();
      for (const ProbeResult &probe : result.probes)
      {
        Json entry;
        entry["point"] = numbers(probe.point);
        entry["value"] = probe.value.size() == 1 ? number(probe.value[0]) : numbers(probe.value);
        if (probe.stress)
        {
          entry["stress"] = numbers({probe.stress->begin(), probe.stress->end()});
          entry["von_mises"] = number(probe.von_mises);
        }
        if (!probe.moments.empty())
          entry["moments"] = numbers(probe.moments);
        json["probes"].push_back(std::move(entry));
      }
      return json;
    }

    Json level_json(const LevelReport &level)
    {
      Json json;
      json["level"] = level.level;
      json["n_cells"] = level.n_cells;
      json["n_dofs"] = level.n_dofs;
      json["n_points"] = level.n_points;
      json["n_active"] = level.n_active;
      json["n_flipped"] = level.n_flipped;
      json["outer_iterations"] = level.outer_iterations;
      json["newton_iterations"] = level.newton_iterations;
      json["linear_iterations"] = level.linear_iterations;
      json["operator_applications"] = level.operator_applications;
      if (level.largest_part > 0)
        json["largest_part"] = number(level.largest_part);
      json["residual"] = number(level.residual);
      json["converged"] = level.converged;
      json["linear_solver"] = level.linear_solver;
      json["reason"] = level.reason;
      return json;
    }

    Json step_json(const LevelReport &level, const NewtonStep &step)
    {
      Json json;
      json["level"] = level.level;
      json["outer"] = step.outer;
      json["active"] = step.active;
      json["flipped"] = step.flipped;
      json["linear_iterations"] = step.linear_iterations;
      json["step_length"] = number(step.step_length);
      json["residual"] = number(step.residual);
      return json;
    }

    Json solver_json(const RunResult &result)
    {
      Json json;
      json["outer_iterations"] = result.outer_iterations;
      json["newton_iterations"] = result.newton_iterations;
      json["linear_iterations"] = result.linear_iterations;
      json["fine_operator_applications"] = result.fine_operator_applications;
      json["reason"] = result.reason;
      json["levels"] = Json::array();
      json["history"] = Json::array();
      for (const LevelReport &level : result.levels)
      {
        json["levels"].push_back(level_json(level));
        for (const NewtonStep &step : level.history)
          json["history"].push_back(step_json(level, step));
      }
      return json;
    }

    Json timing_json(const RunResult &result)
    {
      Json json;
      json["total"] = number(result.timing.total);
      json["mesh"] = number(result.timing.mesh);
      json["setup"] = number(result.timing.setup);
      json["solve"] = number(result.timing.solve);
      json["certify"] = number(result.timing.certify);
      json["output"] = number(result.timing.output);
      json["parts"] = Json::object();
      for (const auto &[part, seconds] : result.timing.parts)
        json["parts"][part] = number(seconds);
      json["levels"] = Json::array();
      for (const LevelReport &level : result.levels)
        json["levels"].push_back(number(level.seconds));
      return json;
    }

    Json number(const std::optional<double> &value)
    {
      return value ? number(*value) : Json(nullptr);
    }

    Json expectation_json(const ExpectationResult &expectation)
    {
      const Expectation &asked = expectation.asked;
      Json               json;
      json["quantity"] = asked.quantity;
      json["value"] = number(expectation.value);
      json["expected"] = number(asked.value);
      json["rtol"] = asked.value ? number(asked.rtol) : Json(nullptr);
      json["atol"] = asked.value ? number(asked.atol) : Json(nullptr);
      json["min"] = number(asked.min);
      json["max"] = number(asked.max);
      json["passed"] = expectation.passed;
      if (!expectation.problem.empty())
        json["problem"] = expectation.problem;
      return json;
    }

    Json certificate_json(const RunResult &result)
    {
      const Certificate &certificate = *result.certificate;
      const auto         if_available = [&](const double value) { return certificate.available ? number(value) : Json(nullptr); };
      Json               json;
      json["available"] = certificate.available;
      json["reason"] = certificate.reason;
      json["energy_gap"] = if_available(certificate.energy_gap);
      json["penalty_error_bound"] = if_available(certificate.penalty_error_bound);
      json["round_off"] = if_available(certificate.round_off);
      json["algebraic_error"] = if_available(certificate.algebraic_error);
      json["theorem3_bound"] = certificate.theorem3_bound ? number(*certificate.theorem3_bound) : Json(nullptr);
      json["theorem3_reason"] = certificate.theorem3_reason;
      json["lbb_free_bound"] = if_available(certificate.lbb_free_bound);
      json["energy_norm"] = number(certificate.energy_norm);
      json["discretisation_indicator"] = number(result.discretisation_indicator);
      json["holds"] = certificate.available ? Json(result.certificate_holds) : Json(nullptr);
      return json;
    }

    Json goal_json(const Estimate::Goal &goal)
    {
      Json json = {{"quantity", goal.quantity},
                   {"value", number(goal.value)},
                   {"error", number(goal.error)},
                   {"relative", number(goal.relative())},
                   {"correction", number(goal.correction)}};
      if (!goal.why_no_error.empty())
        json["reason"] = goal.why_no_error;
      return json;
    }

    Json estimate_json(const RunResult &result)
    {
      const Estimate &estimate = *result.estimate;
      Json            json;
      json["total"] = number(estimate.total);
      json["relative"] = result.reference_norm() > 0 ? number(estimate.total / result.reference_norm()) : Json(nullptr);
      json["nothing_deforms"] = result.nothing_deforms();
      json["discretisation"] = number(estimate.discretisation);
      json["penalty"] = number(estimate.penalty);
      json["algebraic"] = number(estimate.algebraic);
      json["guaranteed"] = estimate.guaranteed;
      if (!estimate.guaranteed)
        json["reason"] = estimate.reason;
      if (estimate.effectivity)
        json["effectivity"] = number(*estimate.effectivity);
      if (estimate.goal)
        json["goal"] = goal_json(*estimate.goal);
      if (!estimate.cycles.empty())
      {
        json["tolerance_met"] = estimate.tolerance_met;
        json["cycles"] = Json::array();
        for (const Estimate::Cycle &cycle : estimate.cycles)
        {
          json["cycles"].push_back({{"level", cycle.level},
                                    {"n_cells", cycle.n_cells},
                                    {"n_dofs", cycle.n_dofs},
                                    {"total", number(cycle.total)},
                                    {"relative", number(cycle.relative)},
                                    {"discretisation", number(cycle.discretisation)},
                                    {"penalty", number(cycle.penalty)},
                                    {"algebraic", number(cycle.algebraic)},
                                    {"guaranteed", cycle.guaranteed}});
          if (cycle.goal)
            json["cycles"].back()["goal"] = goal_json(*cycle.goal);
        }
      }
      return json;
    }

    /// Everything that is measured: the blocks after `case` and before `expect`.
    void add_numbers(Json &json, const RunResult &result)
    {
      json["mesh"]["dimension"] = result.dimension;
      json["mesh"]["n_cells"] = result.n_cells;
      json["mesh"]["n_levels"] = result.n_levels;
      json["mesh"]["h_min"] = number(result.h_min);
      json["mesh"]["h_max"] = number(result.h_max);
      if (result.dimension == 3)
        json["mesh"]["up"] = std::string(1, "xyz"[result.upward_axis]);

      json["space"]["element"] = result.element;
      json["space"]["n_dofs"] = result.n_dofs;
      json["space"]["m"] = result.m;

      json["constraint"] = Json::array();
      for (const ConstraintResult &constraint : result.constraints)
        json["constraint"].push_back(constraint_json(constraint));

      json["method"]["formulation"] = result.formulation;
      json["method"]["epsilon"] = number(result.epsilon);
      json["method"]["epsilon_reason"] = result.epsilon_reason;
      json["method"]["solver"] = result.linear_solver;
      json["method"]["solver_reason"] = result.solver_reason;
      json["method"]["tolerance"] = number(result.tolerance);

      json["solution"] = solution_json(result);
      if (result.balance)
        json["balance"] = balance_json(*result.balance);
      for (const PlatenResult &platen : result.platens)
        json["platens"].push_back(platen_json(platen));
      for (const PeriodicResult &pair : result.periodic)
      {
        Json entry;
        entry["parts"] = pair.parts;
        entry["force"] = numbers(pair.force);
        json["periodic"].push_back(std::move(entry));
      }
      if (result.reactions)
      {
        json["reactions"] = Json::array();
        for (const SupportReaction &reaction : *result.reactions)
        {
          Json entry;
          entry["on"] = reaction.on;
          entry["force"] = number(reaction.force);
          entry["moment"] = number(reaction.moment);
          json["reactions"].push_back(std::move(entry));
        }
      }
      if (result.errors)
        json["errors"] = to_json(*result.errors);
      if (result.certificate)
        json["certificate"] = certificate_json(result);
      if (result.estimate)
        json["estimate"] = estimate_json(result);
      json["warnings"] = Json::array();
      for (const Diagnostic &warning : result.warnings)
        json["warnings"].push_back(
          {{"line", warning.where.line}, {"column", warning.where.column}, {"name", warning.name.text}, {"message", warning.message}});
      json["solver"] = solver_json(result);
      json["timing"] = timing_json(result);
      const double bytes = peak_bytes() + result.memory_of_others;
      json["memory"]["peak_bytes"] = static_cast<std::uint64_t>(bytes);
      json["memory"]["bytes_per_unknown"] = number(bytes / std::max<std::size_t>(result.n_dofs, 1));
    }
  } // namespace

  Json program_json(const unsigned n_processes)
  {
    Json json;
    json["name"] = "unilateral";
    json["version"] = UNILATERAL_VERSION;
    json["dealii"] = DEAL_II_PACKAGE_VERSION;
#if defined(__clang__)
    json["compiler"] = "clang++ " __clang_version__;
#else
    json["compiler"] = "g++ " __VERSION__;
#endif
    json["simd_bits"] = 8 * sizeof(dealii::VectorizedArray<double>);
    json["mpi_ranks"] = n_processes;
    return json;
  }

  Json to_json(const Errors &errors)
  {
    Json       json = Json::object();
    const auto add = [&json](const char *key, const std::optional<double> &value)
    {
      if (value)
        json[key] = number(*value);
    };
    add("L2", errors.L2);
    add("H1_semi", errors.H1_semi);
    add("H2_semi", errors.H2_semi);
    add("energy", errors.energy);
    add("max_nodal", errors.max_nodal);
    add("mean_nodal", errors.mean_nodal);
    add("pressure_L2", errors.pressure_L2);
    return json;
  }

  Json to_json(const CaseSource &source)
  {
    return {{"path", source.path}, {"sha256", source.sha256}, {"title", source.title}, {"settings", source.settings}};
  }

  Json to_json(const RunResult &result, const CaseSource &source, const std::string &expanded)
  {
    Json json;
    json["schema_version"] = 1;
    json["status"] = result.converged ? "converged" : "not_converged";
    json["program"] = program_json(result.n_processes);
    json["case"] = to_json(source);
    json["case"]["expanded"] = expanded;
    add_numbers(json, result);
    json["expect"] = Json::array();
    for (const ExpectationResult &expectation : result.expect)
      json["expect"].push_back(expectation_json(expectation));
    return json;
  }

  Json numbers_json(const RunResult &result)
  {
    Json json;
    json["schema_version"] = 1;
    json["program"] = program_json(result.n_processes);
    add_numbers(json, result);
    return json;
  }

  std::string to_text(const Json &json)
  {
    return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
  }

  double peak_bytes()
  {
    rusage usage = {};
    getrusage(RUSAGE_SELF, &usage);
    return 1024. * static_cast<double>(usage.ru_maxrss); // Linux counts kilobytes
  }
} // namespace unilateral
