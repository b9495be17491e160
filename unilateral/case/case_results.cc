#include "unilateral/case/case_results.h"

#include "unilateral/case/write_case.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <string>
#include <vector>

namespace unilateral
{
  using Json = nlohmann::ordered_json;

  namespace
  {
    /// A result of @p request with every entry that a run gives it and no number in its place.
    RunResult blank_result(const Case &request)
    {
      RunResult      result;
      const bool     body = request.model.kind == ModelSpec::Kind::elasticity;
      const unsigned n_components = body ? request.dimension : 1;
      for (const ConstraintSpec &constraint : request.constraints)
        result.constraints.resize(result.constraints.size() + constraint.lower.has_value() + constraint.upper.has_value() +
                                  (constraint.gap || constraint.surface));
      if (request.model.kind == ModelSpec::Kind::projection)
        for (ConstraintResult &constraint : result.constraints)
          constraint.max_violation_between_points = 0;
      for (const std::vector<double> &point : request.output.probes)
        result.probes.push_back({point, std::vector<double>(n_components, 0.), {}, 0, {}});
      for (const auto &functional : request.functionals)
        result.functionals.push_back({functional.name, 0});
      if (request.bending())
      {
        result.norm_H2_semi = 0;
        // How many pieces there will be, nobody knows: ten are let pass, see check_expectations().
        for (ConstraintResult &constraint : result.constraints)
          constraint.components.emplace(10, ContactComponent{0, 0, 0, 0, 0, false, std::vector<double>(request.dimension, 0.),
                                                             std::vector<double>(request.dimension, 0.)});
        result.reactions.emplace(request.boundary.size() + request.supports.size() + request.part_names.size());
        for (ProbeResult &probe : result.probes)
          probe.moments.assign(request.dimension == 1 ? 1 : 3, 0.);
      }
      if (body)
      {
        const bool                axisymmetric = request.model.assumption == ModelSpec::Assumption::axisymmetric;
        const std::vector<double> zeros(n_components, 0.);
        for (ConstraintResult &constraint : result.constraints)
        {
          constraint.contact_force = zeros;
          constraint.contact_moment.assign(n_components == 3 ? 3 : axisymmetric || n_components < 2 ? 0 : 1, 0.);
        }
        for (ProbeResult &probe : result.probes)
          probe.stress.emplace();
        result.max_von_mises = 0;
        result.balance = ForceBalance{zeros, zeros, zeros, zeros, {}, 0, 0, {}};
        const unsigned n_rotations = axisymmetric || n_components < 2 ? 0 : n_components == 3 ? 3 : 1;
        for (const BoundarySpec &condition : request.boundary)
          if (condition.rigid)
            result.platens.push_back(
              {condition.part, zeros, zeros, std::vector<double>(n_rotations, 0.), zeros, std::vector<double>(n_rotations, 0.)});
        for (const BoundarySpec &condition : request.boundary)
          if (condition.symmetry || !condition.components.empty())
            result.balance->reactions.push_back({condition.part, zeros});
      }
      for (const PeriodicSpec &pair : request.periodic)
        result.periodic.push_back({{pair.first, pair.second}, std::vector<double>(n_components, 0.)});
      if (!request.exact.u.empty() || request.exact.pressure)
        result.errors.emplace();
      if (!request.exact.u.empty())
        result.errors->L2 = result.errors->H1_semi = result.errors->max_nodal = result.errors->mean_nodal = 0;
      if (!request.exact.u.empty() && request.bending())
        result.errors->H2_semi = 0;
      if (request.model.kind != ModelChoices::Kind::projection)
        result.estimate.emplace();
      result.energy_norm = 1; // relative numbers exist
      if (!request.exact.u.empty() && request.model.kind == ModelChoices::Kind::membrane)
        result.errors->energy = result.estimate->effectivity.emplace(0);
      if (request.mesh.adapt && result.estimate)
      {
        if (request.mesh.adapt->goal.is_a_number())
        {
          Estimate::Goal goal;
          goal.quantity = request.mesh.adapt->goal.name;
          goal.value = 1;
          result.estimate->goal = goal;
        }
        result.estimate->cycles.resize(1);
        result.estimate->cycles[0].goal = result.estimate->goal;
      }
      if (request.exact.pressure && !result.constraints.empty())
        result.errors->pressure_L2 = 0;
      result.certificate.emplace().available = true;
      result.levels.resize(request.mesh.n_refinements() + 1);
      // How many steps there will be, nobody knows: the first stands for all, see check_expectations().
      result.levels[0].history.resize(1);
      return result;
    }
  } // namespace

  Json to_json(const RunResult &result, const Case &request)
  {
    return to_json(result, static_cast<const CaseSource &>(request), expand(request));
  }

  Json to_json(const RunResult &result, const Case &request, const Json &steps)
  {
    Json json = to_json(result, request);
    if (steps.empty())
      return json;
    json["steps"] = steps;
    if (!result.converged)
      json["failed_step"] = {{"number", steps.back()["status"] == "converged" ? steps.size() + 1 : steps.size()},
                             {"reason", result.reason}};
    return json;
  }

  namespace
  {
    constexpr const char *parameter_start = "parameters.";

    std::string short_key(const std::string &key)
    {
      return key.starts_with(parameter_start) ? key.substr(std::string(parameter_start).size()) : key;
    }

    Json value_of(const FieldSpec &spec)
    {
      return spec.kind == FieldSpec::Kind::constant     ? Json(spec.value)
             : spec.kind == FieldSpec::Kind::expression ? Json(spec.text)
                                                        : Json(nullptr);
    }
  } // namespace

  std::vector<std::string> stepped_keys(const Case &request)
  {
    std::vector<std::string> keys;
    for (const LoadStep &step : request.steps)
      for (const StepSetting &setting : step.settings)
        if (const std::string key = short_key(setting.key); std::find(keys.begin(), keys.end(), key) == keys.end())
          keys.push_back(key);
    return keys;
  }

  Json stepped_values(const Case &request, const std::size_t k)
  {
    Json values = Json::object();
    for (const std::string &key : stepped_keys(request))
      values[key] = nullptr;
    for (const Parameter &parameter : request.steps[k].parameters)
      if (values.contains(parameter.name))
        values[parameter.name] = value_of(parameter.value);
    for (const StepSetting &setting : request.steps[k].values)
      values[setting.key] = setting.number ? Json(*setting.number) : Json(setting.value);
    return values;
  }

  Json step_json(const RunResult &result, const Case &request, const std::size_t k, const double seconds)
  {
    Json       json = {{"number", k + 1}, {"parameters", stepped_values(request, k)}};
    const Json all = numbers_json(result);
    json["status"] = result.converged ? "converged" : "not_converged";
    for (const char *const block : {"mesh", "space", "constraint", "method", "solution", "balance", "platens", "periodic", "reactions",
                                    "errors", "certificate", "estimate"})
      if (all.contains(block))
        json[block] = all[block];
    for (const char *const count : {"newton_iterations", "linear_iterations"})
      json["solver"][count] = all["solver"][count];
    json["timing"]["total"] = seconds;
    return json;
  }

  Json blank_json(const Case &request)
  {
    const RunResult blank = blank_result(request);
    Json            json = numbers_json(blank);
    for (std::size_t k = 0; k < request.steps.size(); ++k)
      json["steps"].push_back(k == 0 ? step_json(blank, request, k, 0.) : json["steps"][0]);
    return json;
  }
} // namespace unilateral
