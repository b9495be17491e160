#include "unilateral/studies/quadrature_study.h"

#include "unilateral/base/byte_archive.h"
#include "unilateral/base/processes.h"
#include "unilateral/output/json.h"
#include "unilateral/solve.h"
#include "unilateral/stability/pressure_oscillation.h"
#include "unilateral/studies/finest_level_progress.h"
#include "unilateral/studies/inf_sup_study.h"

#include <fmt/format.h>

#include <algorithm>
#include <exception>
#include <stdexcept>

namespace unilateral
{
  using Json = nlohmann::ordered_json;

  namespace
  {
    /// The rules that are defined for the element of the case where its first constraint acts, each set of points once.
    template <int dim>
    std::vector<std::string> rules_for(const ProblemStatement &statement)
    {
      ElementName element = statement.model.element;
      if (dim == 1)
        element.family = ElementName::Family::Q;
      const bool               on_boundary = !statement.constraints[0].on.empty();
      std::vector<std::string> candidates = {"nodal", "midpoint", "trapezoid", "simpson", "edges"};
      for (unsigned n = 1; n <= element.degree + 1; ++n)
        candidates.push_back(fmt::format("gauss({})", n));
      std::vector<std::string>         rules;
      std::vector<std::vector<double>> known; // coordinates of the points of the rules so far
      for (const std::string &name : candidates)
        try
        {
          std::vector<double> coordinates;
          const auto          collect = [&](const auto &quadrature)
          {
            for (const auto &x : quadrature.get_points())
              coordinates.insert(coordinates.end(), x.begin_raw(), x.end_raw());
          };
          if (on_boundary)
            collect(quadrature_rule<dim - 1>(*parse_rule(name), element));
          else
            collect(quadrature_rule<dim>(*parse_rule(name), element));
          const bool same = std::any_of(known.begin(), known.end(),
                                        [&](const auto &other)
                                        {
                                          return other.size() == coordinates.size() &&
                                                 std::equal(other.begin(), other.end(), coordinates.begin(),
                                                            [](double a, double b) { return std::abs(a - b) < 1e-12; });
                                        });
          if (!same)
          {
            rules.push_back(name);
            known.push_back(coordinates);
          }
        }
        catch (const std::invalid_argument &)
        {
          // Not for this element.
        }
      return rules;
    }

    /// The names of @p asked in full, or those of all rules that are defined. Throws InputError for a name that is no rule.
    template <int dim>
    std::vector<std::string> rules_to_try(const ProblemStatement &statement, const std::vector<std::string> &asked)
    {
      std::vector<std::string> rules = asked;
      if (rules.empty())
        rules = rules_for<dim>(statement);
      for (std::string &rule : rules)
      {
        const auto parsed = parse_rule(rule);
        if (!parsed)
          throw InputError(SourceLocation{"--rules", 0, 0}, why_no_rule(rule), MessageName("unknown-choice"));
        rule = parsed->name();
      }
      return rules;
    }

    ProblemStatement with_rule_on_every_constraint(const ProblemStatement &statement, const std::string &rule)
    {
      ProblemStatement result = statement;
      result.mesh.adapt.reset(); // one mesh for all rules
      for (auto &constraint : result.constraints)
        constraint.quadrature = parse_rule(rule);
      return result;
    }

    template <int dim>
    void add_solution(QuadratureStudy::Row &row, const Solution<dim> &solution)
    {
      const auto &result = solution.result;
      const auto &set = solution.constraint_set;
      row.exact_pairing = set.blocks[0].exact_pairing;
      row.n_points = set.blocks[0].end - set.blocks[0].begin;
      std::size_t most_loaded = 0;
      for (std::size_t b = 0; b < result.constraints.size(); ++b)
      {
        row.total_contact_force += result.constraints[b].total_contact_force;
        row.max_penetration = std::max(row.max_penetration, result.constraints[b].max_penetration);
        if (result.constraints[b].total_contact_force > result.constraints[most_loaded].total_contact_force)
          most_loaded = b;
      }
      row.energy = result.energy;
      row.errors = result.errors;
      row.newton_iterations = result.newton_iterations;
      row.linear_iterations = result.linear_iterations;
      row.converged = result.converged;
      row.pressure_oscillation = pressure_oscillation(*solution.problem, set, most_loaded, solution.contact_pressure);
    }

    /// On all of Q_h of the first constraint. Throws std::length_error when the problem is too large.
    template <int dim>
    InfSup constants_of_first_constraint(const Problem<dim> &problem, const ConstraintSet<dim> &set)
    {
      std::vector<bool> first(set.size(), false);
      std::fill(first.begin() + set.blocks[0].begin, first.begin() + set.blocks[0].end, true);
      const bool    by_L2 = set.blocks[0].exact_pairing && has_polynomials(problem, set);
      const Pairing pairing = make_pairing(problem, set, first, PairingKind::by_rule);
      if (pairing.gram.rows() + pairing.functionals.cols() > int(limits_for(dim).sparse))
        throw std::length_error(fmt::format("{} unknowns are more than inf-sup constants are computed for", pairing.gram.rows()));
      std::optional<Pairing> dual;
      if (n_dual_unknowns(problem) <= limits_for(dim).dual)
        dual = make_dual_pairing(problem, set, first, by_L2 ? PairingKind::by_L2 : PairingKind::by_rule);
      return inf_sup(pairing, dual ? &*dual : nullptr);
    }

    /// The verdict of inf-sup constants on the coarsest levels.
    template <int dim>
    std::optional<Stability> stability_on_coarse_levels(const ProblemStatement &statement, Progress &progress)
    {
      const InfSupStudyOptions options = {
        .n_levels = 3, .with_contact = false, .with_dual_norm = false, .limits = {.dense_entries = 4000000, .sparse = 6000}};
      Diagnostics nobody;
      const auto  verdict = study_inf_sup<dim>(statement, options, nobody, progress).verdict;
      return verdict ? std::optional(verdict->stability) : std::nullopt;
    }

    /// @p missing: why constants are, if they are. Throws InputError where the rule cannot be used; the row has what was known then.
    template <int dim>
    void complete_row(QuadratureStudy::Row &row, const ProblemStatement &statement, std::string &missing, Progress &progress)
    {
      const ProblemStatement with_rule = with_rule_on_every_constraint(statement, row.rule);
      FinestLevelProgress    finest(progress, with_rule.mesh.n_refinements(), row.rule);
      Diagnostics            warnings;
      const Solution<dim>    solution = solve<dim>(with_rule, warnings, finest);
      add_solution(row, solution);
      progress.phase("inf-sup", "the rule " + row.rule);
      try
      {
        row.constants = constants_of_first_constraint(*solution.problem, solution.constraint_set);
      }
      catch (const std::length_error &too_large)
      {
        missing = too_large.what();
      }
      row.stability = stability_on_coarse_levels<dim>(with_rule, progress);
    }

    /// @p archive: ByteWriter or ByteReader.
    template <typename Archive, typename Row>
    void transfer(Archive &archive, Row &row)
    {
      archive(row.rule);
      archive(row.refused);
      archive(row.exact_pairing);
      archive(row.n_points);
      archive(row.stability);
      archive(row.total_contact_force);
      archive(row.energy);
      archive(row.max_penetration);
      archive(row.pressure_oscillation);
      archive(row.errors);
      archive(row.newton_iterations);
      archive(row.linear_iterations);
      archive(row.converged);
    }

    template <typename Archive, typename Constants>
    void transfer_constants(Archive &archive, Constants &constants)
    {
      archive(constants.n_dofs);
      archive(constants.n_points);
      archive(constants.rank);
      archive(constants.nullity);
      archive(constants.C_h);
      archive(constants.C_h_nonzero);
      archive(constants.beta_h);
      archive(constants.beta_h_nonzero);
      archive(constants.lowest_mode);
      archive(constants.dense);
    }

    /// Those of all processes, of which process r has r, r + size, r + 2 size, ...
    void gather_rows(QuadratureStudy &study, const std::size_t n_rows, const Processes &processes)
    {
      if (processes.alone())
        return;
      ByteWriter writer;
      for (std::size_t k = 0; k < study.rows.size(); ++k)
      {
        const QuadratureStudy::Row &row = study.rows[k];
        writer(k * processes.size() + processes.rank());
        transfer(writer, row);
        writer(row.constants.has_value());
        if (row.constants)
          transfer_constants(writer, *row.constants);
        writer(study.missing);
      }
      const std::vector<char> bytes = processes.gather(writer.bytes);
      study.rows.assign(n_rows, {});
      for (ByteReader reader(bytes); !reader.at_end();)
      {
        std::size_t place = 0;
        reader(place);
        QuadratureStudy::Row &row = study.rows.at(place);
        transfer(reader, row);
        bool has_constants = false;
        reader(has_constants);
        if (has_constants)
          transfer_constants(reader, row.constants.emplace());
        std::string missing;
        reader(missing);
        if (!missing.empty())
          study.missing = missing;
      }
    }
  } // namespace

  template <int dim>
  QuadratureStudy study_quadrature(const ProblemStatement         &statement,
                                   const std::vector<std::string> &asked,
                                   Diagnostics                    &diagnostics,
                                   Progress                       &progress,
                                   const Processes                &processes)
  {
    if (statement.constraints.empty())
      throw InputError(statement.model.where, "the case has no [constraint]: there is no rule to choose", MessageName("nothing-to-study"));
    QuadratureStudy study;
    study.element = statement.model.element.name();
    if (statement.constraints.size() > 1)
      diagnostics.warning(statement.constraints[1].where,
                          "every [[constraint]] gets the rule, and forces are summed; constants and verdict are those of the first",
                          MessageName("first-constraint-only"));
    const std::vector<std::string> rules = rules_to_try<dim>(statement, asked);
    std::exception_ptr             wrong_case;
    for (std::size_t k = processes.rank(); k < rules.size() && !wrong_case; k += processes.size())
    {
      if (progress.stop_requested())
        throw Interrupted();
      const std::string &rule = rules[k];
      progress.phase("study", fmt::format("rule {} of {}, {}", k + 1, rules.size(), rule));
      QuadratureStudy::Row row;
      row.rule = rule;
      try
      {
        complete_row<dim>(row, statement, study.missing, progress);
      }
      catch (const InputError &reason)
      {
        // A rule that the element does not take is a row of the table; a case that is wrong in itself is not.
        if (rule == rules.front() && asked.empty())
          wrong_case = std::current_exception();
        row.refused = reason.diagnostics.empty() ? reason.what() : reason.diagnostics.front().message;
      }
      study.rows.push_back(std::move(row));
    }
    gather_rows(study, rules.size(), processes);
    if (wrong_case)
      std::rethrow_exception(wrong_case);
    if (asked.empty() && !study.rows.front().refused.empty())
      throw InputError(statement.model.where, study.rows.front().refused, MessageName("rule-does-not-fit"));
    if (std::all_of(study.rows.begin(), study.rows.end(), [](const auto &row) { return !row.refused.empty(); }))
      throw InputError(SourceLocation{"--rules", 0, 0},
                       fmt::format("none can be used with {} here: {}", study.element, study.rows.front().refused),
                       MessageName("rule-does-not-fit"));
    return study;
  }

  Json to_json(const QuadratureStudy &study, const CaseSource &source)
  {
    Json json;
    json["schema_version"] = 1;
    json["program"] = program_json(Processes::all().size());
    json["case"] = to_json(source);
    json["element"] = study.element;
    json["rows"] = Json::array();
    for (const auto &row : study.rows)
    {
      Json entry = {{"rule", row.rule}};
      if (!row.refused.empty())
      {
        entry["refused"] = row.refused;
        json["rows"].push_back(entry);
        continue;
      }
      entry["exact_pairing"] = row.exact_pairing;
      entry["n_points"] = row.n_points;
      const auto constant = [&](const auto member) { return row.constants ? Json((*row.constants).*member) : Json(nullptr); };
      entry["C_h"] = constant(&InfSup::C_h);
      entry["C_h_nonzero"] = constant(&InfSup::C_h_nonzero);
      entry["beta_h"] = row.constants ? or_null(row.constants->beta_h) : Json(nullptr);
      entry["beta_h_nonzero"] = row.constants ? or_null(row.constants->beta_h_nonzero) : Json(nullptr);
      entry["nullity"] = constant(&InfSup::nullity);
      entry["verdict"] = row.stability ? Json(to_string(*row.stability)) : Json(nullptr);
      entry["total_contact_force"] = row.total_contact_force;
      entry["energy"] = row.energy;
      entry["max_penetration"] = row.max_penetration;
      entry["pressure_oscillation"] = or_null(row.pressure_oscillation);
      entry["errors"] = row.errors ? to_json(*row.errors) : Json(nullptr);
      entry["newton_iterations"] = row.newton_iterations;
      entry["linear_iterations"] = row.linear_iterations;
      entry["converged"] = row.converged;
      json["rows"].push_back(entry);
    }
    if (!study.missing.empty())
      json["missing"] = study.missing;
    return json;
  }

  std::string to_csv(const QuadratureStudy &study)
  {
    const auto  optional = [](const std::optional<double> &value) { return value ? fmt::format("{:.12g}", *value) : std::string(); };
    std::string text = "rule,exact_pairing,n_points,C_h,C_h_nonzero,beta_h,beta_h_nonzero,nullity,verdict,total_contact_force,energy,"
                       "max_penetration,pressure_oscillation,error_L2,error_H1_semi,error_pressure_L2\n";
    for (const auto &row : study.rows)
    {
      if (!row.refused.empty())
        continue;
      text += fmt::format("{},{},{},", row.rule, row.exact_pairing, row.n_points);
      if (const auto &c = row.constants)
        text +=
          fmt::format("{:.12g},{:.12g},{},{},{},", c->C_h, c->C_h_nonzero, optional(c->beta_h), optional(c->beta_h_nonzero), c->nullity);
      else
        text += ",,,,,";
      const Errors errors = row.errors.value_or(Errors());
      text += fmt::format("{},{:.12g},{:.12g},{:.12g},{},{},{},{}\n", row.stability ? to_string(*row.stability) : "",
                          row.total_contact_force, row.energy, row.max_penetration, optional(row.pressure_oscillation), optional(errors.L2),
                          optional(errors.H1_semi), optional(errors.pressure_L2));
    }
    return text;
  }

#define INSTANTIATE(dim)                                                                                                                   \
  template QuadratureStudy study_quadrature<dim>(const ProblemStatement &, const std::vector<std::string> &, Diagnostics &, Progress &,    \
                                                 const Processes &);
  INSTANTIATE(1)
  INSTANTIATE(2)
  INSTANTIATE(3)
#undef INSTANTIATE
} // namespace unilateral
