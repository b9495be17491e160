#include "unilateral/inf_sup_study.h"

#include "unilateral/results.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <cmath>

namespace unilateral
{
  using Json = nlohmann::ordered_json;

  template <int dim>
  InfSupStudy
  study_inf_sup(const Case &request, const unsigned n_levels, const std::string &zone, Diagnostics &diagnostics, Progress &progress)
  {
    if (request.constraints.empty())
      throw InputError(request.model.where, "the case has no [constraint]: there is no pairing to look at");
    Case first_constraint = request;
    first_constraint.constraints.resize(1);
    if (first_constraint.constraints[0].lower && first_constraint.constraints[0].upper)
      first_constraint.constraints[0].upper.reset(); // both sides see the same points
    first_constraint.mesh.refine = n_levels;         // a coarse level without points is no mistake
    FieldSpec in_zone = FieldSpec::expression(zone.empty() ? "1" : zone);
    in_zone.where = {"--zone", 0, 0};
    const FieldFunction lies_in_zone(in_zone, request.parameters, dim);

    Problem<dim> problem(first_constraint, diagnostics);
    InfSupStudy  study;
    study.element = request.model.element.name();
    study.zone = zone;
    std::vector<Vector> nothing_to_carry;
    for (unsigned level = 0; level < n_levels; ++level)
    {
      if (progress.stop_requested())
        throw Interrupted();
      if (level > 0)
        problem.refine(nothing_to_carry);
      const std::size_t n_free = problem.dof_handler.n_dofs() - problem.dirichlet.n_constraints();
      if (n_free > largest_dense_inf_sup)
      {
        study.stopped =
          fmt::format("level {} has {} free unknowns, more than the {} that dense matrices take", level, n_free, largest_dense_inf_sup);
        if (study.rows.empty())
          throw InputError(request.mesh.where, study.stopped + "; give a coarser mesh");
        break;
      }
      progress.phase("inf-sup", fmt::format("level {}, {} unknowns", level, n_free));
      const auto  constraint_set = problem.make_constraint_set();
      const auto &block = constraint_set.blocks[0];
      study.quadrature = block.rule.name();
      study.on = block.on;
      study.exact_pairing = block.exact_pairing;
      if (constraint_set.size() == 0)
        continue;
      InfSupStudy::Row row;
      row.level = level;
      row.h = problem.cell_sizes().second / std::sqrt(double(dim));
      row.all = inf_sup(problem, constraint_set, std::vector<bool>(constraint_set.size(), true), true);
      if (!zone.empty())
      {
        std::vector<bool> flags(constraint_set.size());
        for (std::size_t i = 0; i < flags.size(); ++i)
          flags[i] = lies_in_zone.value(constraint_set.points[i]) != 0;
        if (std::find(flags.begin(), flags.end(), true) != flags.end())
          row.zone = inf_sup(problem, constraint_set, flags, true);
      }
      study.rows.push_back(std::move(row));
    }

    std::vector<InfSup> judged;
    for (const auto &row : study.rows)
      if (zone.empty())
        judged.push_back(row.all);
      else if (row.zone)
        judged.push_back(*row.zone);
    if (judged.size() >= 2)
    {
      const bool on_boundary = problem.conditions[0].part.has_value();
      study.verdict = judge_stability(judged, on_boundary ? 0.5 : 1., default_rule(problem.element, on_boundary ? dim - 1 : dim).name());
    }
    return study;
  }

  namespace
  {
    Json constants_json(const InfSup &constants)
    {
      const auto optional = [](const std::optional<double> &value) { return value ? Json(*value) : Json(nullptr); };
      Json       json;
      json["n_dofs"] = constants.n_dofs;
      json["n_points"] = constants.n_points;
      json["rank"] = constants.rank;
      json["nullity"] = constants.nullity;
      json["C_h"] = constants.C_h;
      json["C_h_nonzero"] = constants.C_h_nonzero;
      json["beta_h"] = optional(constants.beta_h);
      json["beta_h_nonzero"] = optional(constants.beta_h_nonzero);
      return json;
    }
  } // namespace

  Json to_json(const InfSupStudy &study, const Case &request)
  {
    Json json;
    json["schema_version"] = 1;
    json["program"] = program_json();
    json["case"] = {{"path", request.path}, {"sha256", request.sha256}};
    json["element"] = study.element;
    json["quadrature"] = study.quadrature;
    json["on"] = study.on;
    json["exact_pairing"] = study.exact_pairing;
    json["method"] = "dense Cholesky factorisation and singular values";
    json["rows"] = Json::array();
    for (const auto &row : study.rows)
    {
      Json entry = {{"level", row.level}, {"h", row.h}};
      entry.update(constants_json(row.all));
      json["rows"].push_back(entry);
    }
    if (!study.zone.empty())
    {
      json["zone"] = study.zone;
      json["zone_rows"] = Json::array();
      for (const auto &row : study.rows)
        if (row.zone)
        {
          Json entry = {{"level", row.level}, {"h", row.h}};
          entry.update(constants_json(*row.zone));
          json["zone_rows"].push_back(entry);
        }
    }
    if (study.verdict)
    {
      json["rates"] = {{"C_h_nonzero", study.verdict->rate}};
      json["verdict"] = to_string(study.verdict->stability);
      json["advice"] = study.verdict->advice;
    }
    else
    {
      json["rates"] = nullptr;
      json["verdict"] = nullptr;
    }
    if (!study.stopped.empty())
      json["stopped"] = study.stopped;
    return json;
  }

  std::string to_csv(const InfSupStudy &study)
  {
    std::string text = "zone,level,h,n_dofs,n_points,rank,nullity,C_h,C_h_nonzero,beta_h,beta_h_nonzero\n";
    const auto  optional = [](const std::optional<double> &value) { return value ? fmt::format("{:.12g}", *value) : std::string(); };
    const auto  line = [&](const char *zone, const InfSupStudy::Row &row, const InfSup &c)
    {
      text += fmt::format("{},{},{:.12g},{},{},{},{},{:.12g},{:.12g},{},{}\n", zone, row.level, row.h, c.n_dofs, c.n_points, c.rank,
                          c.nullity, c.C_h, c.C_h_nonzero, optional(c.beta_h), optional(c.beta_h_nonzero));
    };
    for (const auto &row : study.rows)
      line("all", row, row.all);
    for (const auto &row : study.rows)
      if (row.zone)
        line("zone", row, *row.zone);
    return text;
  }

  template InfSupStudy study_inf_sup<1>(const Case &, unsigned, const std::string &, Diagnostics &, Progress &);
  template InfSupStudy study_inf_sup<2>(const Case &, unsigned, const std::string &, Diagnostics &, Progress &);
  template InfSupStudy study_inf_sup<3>(const Case &, unsigned, const std::string &, Diagnostics &, Progress &);
} // namespace unilateral
