#include "unilateral/studies/mesh_study.h"

#include "unilateral/base/processes.h"
#include "unilateral/base/stopwatch.h"
#include "unilateral/discretisation/regions_and_parts.h"
#include "unilateral/evaluation/solution_norms.h"
#include "unilateral/solve.h"
#include "unilateral/spaces/interpolation_to_finer_mesh.h"
#include "unilateral/studies/finest_level_progress.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>

namespace unilateral
{
  using Json = nlohmann::ordered_json;

  namespace
  {
    ProblemStatement on_level(const ProblemStatement &statement, const unsigned level)
    {
      ProblemStatement result = statement;
      result.mesh.refine = level;
      result.mesh.compared_with_finer = true;
      result.mesh.adapt.reset(); // rates are those of meshes that are halved
      return result;
    }

    ProblemStatement by_mixed_method(const ProblemStatement &statement)
    {
      ProblemStatement result = statement;
      result.method.formulation = Method::Formulation::mixed;
      result.method.epsilon.reset();
      return result;
    }

    /// The power of ten next to ||u||_0 / ||p||_0 on the coarsest mesh that has points: "far too soft" in any units.
    template <int dim>
    double natural_epsilon(const ProblemStatement &statement, Progress &progress)
    {
      Diagnostics         nobody;
      FinestLevelProgress unshown(progress, std::nullopt);
      Solution<dim>       solution;
      for (unsigned level = 0; !solution.problem; ++level)
        try
        {
          solution = solve<dim>(by_mixed_method(on_level(statement, level)), nobody, unshown);
        }
        catch (const NoPoints &)
        {
          if (level >= statement.mesh.refine)
            throw;
        }
      double pressure = 0;
      for (const auto &constraint : solution.result.constraints)
        pressure = std::hypot(pressure, constraint.pressure_L2);
      const double ratio = solution.result.norm_L2 / pressure;
      return ratio > 0 && std::isfinite(ratio) ? std::pow(10., std::round(std::log10(ratio))) : 1.;
    }

    /// epsilon on each level of the study.
    struct EpsilonOnLevels
    {
      bool                  mixed = false;
      std::optional<double> coarsest; ///< on the coarsest level; absent: the case chooses it, or there is none
      double                power = 0;

      bool        prescribed() const { return coarsest && !mixed; }
      double      on(const unsigned level) const { return *coarsest * (level > 0 ? std::pow(0.5, level * power) : 1.); }
      std::string name() const
      {
        return mixed        ? "mixed"
               : !coarsest  ? "auto"
               : power == 0 ? fmt::format("{:g}", *coarsest)
                            : fmt::format("{:g} (h/h0)^{:g}", *coarsest, power);
      }
    };

    template <int dim>
    EpsilonOnLevels epsilon_on_levels(const ProblemStatement &statement, const MeshStudyOptions &options, Progress &progress)
    {
      EpsilonOnLevels epsilon;
      epsilon.coarsest = options.epsilon;
      if (!epsilon.coarsest && options.power)
        epsilon.coarsest = statement.method.epsilon ? *statement.method.epsilon : natural_epsilon<dim>(statement, progress);
      if (!epsilon.coarsest)
        epsilon.coarsest = statement.method.epsilon;
      epsilon.power = options.power.value_or(0.);
      epsilon.mixed = statement.method.formulation == Method::Formulation::mixed && !options.epsilon && !options.power;
      return epsilon;
    }

    ProblemStatement on_level(const ProblemStatement &statement, const unsigned level, const EpsilonOnLevels &epsilon)
    {
      ProblemStatement result = on_level(statement, level);
      if (epsilon.prescribed())
      {
        result.method.formulation = Method::Formulation::penalty;
        result.method.epsilon = epsilon.on(level);
      }
      return result;
    }

    /// The numbers of the level by itself.
    MeshStudy::Row row_of_level(const unsigned level, const RunResult &result)
    {
      MeshStudy::Row row;
      row.level = level;
      row.h = result.h_max;
      row.n_dofs = result.n_dofs;
      row.epsilon = result.epsilon;
      row.errors = result.errors;
      row.energy = result.energy;
      for (const auto &constraint : result.constraints)
      {
        row.total_contact_force += constraint.total_contact_force;
        row.contact_measure += constraint.contact_measure;
        row.max_contact_pressure = std::max(row.max_contact_pressure, constraint.max_contact_pressure);
      }
      row.max_von_mises = result.max_von_mises;
      if (result.certificate && result.certificate->available)
        row.penalty_error_bound = result.certificate->penalty_error_bound;
      row.discretisation_indicator = result.discretisation_indicator;
      row.newton_iterations = result.newton_iterations;
      row.linear_iterations = result.linear_iterations;
      row.converged = result.converged;
      return row;
    }

    template <int dim>
    bool have_same_unknowns(const FunctionSpace<dim> &a, const FunctionSpace<dim> &b)
    {
      const auto of_a = a.nodal_values(), of_b = b.nodal_values();
      return std::equal(of_a.begin(), of_a.end(), of_b.begin(), of_b.end(),
                        [tolerance = 1e-6 * a.cell_sizes().first](const auto &value, const auto &other)
                        { return value.dof == other.dof && value.component == other.component && value.x.distance(other.x) <= tolerance; });
    }

    /// Refines the problem of @p coarser, with @p functions, to that of the next level, @p finer, and divides it among the processes like
    /// that where it was solved by each of them as a whole. False: their parts are others.
    template <int dim>
    bool refine_to(Problem<dim> &coarser, const Problem<dim> &finer, std::vector<Vector> &functions)
    {
      const auto &part = finer.space.subdomain;
      if (part && !coarser.space.subdomain)
      {
        if (part->previous || (finer.space.element.simplex() && part->level != coarser.space.level))
          return false;
        coarser.keep_own_part(part->processes, part->division, 1, functions, /*refined_next=*/false);
      }
      coarser.refine(functions);
      return !finer.space.processes().any(!have_same_unknowns(coarser.space, finer.space));
    }

    /// Adds to the row of @p coarser what its solution differs from that of the next level by. Refines the problem of @p coarser. Levels of
    /// triangles and tetrahedra that are refined in places are no refinements of each other: there it adds nothing. Nor does it where
    /// several processes have divided the two in different ways.
    template <int dim>
    void add_difference(MeshStudy::Row &row, Solution<dim> &coarser, const Solution<dim> &finer)
    {
      const bool in_places = !finer.problem->statement.mesh.local.empty();
      if (in_places && (finer.problem->space.element.simplex() || finer.problem->space.subdomain))
        return;
      std::vector<Vector> carried = {coarser.displacement};
      if (in_places)
        carried[0] = on_finer_mesh(coarser.problem->space.dof_handler, coarser.displacement, finer.problem->space.dof_handler);
      else if (!refine_to(*coarser.problem, *finer.problem, carried))
        return;
      carried[0] -= finer.displacement;
      const auto norms = solution_norms(*finer.problem, carried[0]);
      row.difference_L2 = norms.L2;
      row.difference_H1_semi = norms.H1_semi;
    }

    /// Throws InputError where meshes cannot be refined by the error, before anything is solved.
    void check_adaptive(const ProblemStatement &statement, Diagnostics &diagnostics)
    {
      ProblemStatement adaptive = statement;
      if (statement.model.element.family == ElementName::Family::hermite)
        throw InputError(statement.model.where, "meshes of the element 'hermite' are refined as a whole: leave out --adaptive",
                         MessageName("kind-does-not-fit"));
      if (statement.model.kind == ModelChoices::Kind::projection)
        throw InputError(statement.model.where, "a projection has no error of the mesh that could be estimated: leave out --adaptive",
                         MessageName("kind-does-not-fit"));
      if (!adaptive.mesh.adapt)
        adaptive.mesh.adapt.emplace();
      check_couplings(adaptive, diagnostics);
      diagnostics.throw_if_errors();
    }
  } // namespace

  template <int dim>
  MeshStudy study_mesh(const ProblemStatement &statement,
                       const MeshStudyOptions &options,
                       Diagnostics            &diagnostics,
                       Progress               &progress,
                       const Processes        &processes)
  {
    MeshStudy study;
    if (options.adaptive && options.power)
      throw InputError(SourceLocation{"--power", 0, 0}, "epsilon ~ h^power has no meaning on meshes of many sizes: leave out --adaptive",
                       MessageName("contradiction"));
    if (options.adaptive)
      check_adaptive(statement, diagnostics);
    const unsigned n_levels = options.n_levels > 0 ? options.n_levels : statement.mesh.refine + 1;
    study.element = statement.model.element.name();
    const EpsilonOnLevels epsilon = epsilon_on_levels<dim>(statement, options, progress);
    study.epsilon_rule = epsilon.name();

    Solution<dim> coarser; // the solution one level below, for differences
    for (unsigned level = 0; level < n_levels; ++level)
    {
      if (processes.any(progress.stop_requested()))
        throw Interrupted();
      Stopwatch              watch;
      const ProblemStatement wanted = on_level(statement, level, epsilon);
      FinestLevelProgress    finest(progress, wanted.mesh.n_refinements());
      Diagnostics            warnings;
      Solution<dim>          solution;
      try
      {
        solution = solve<dim>(wanted, study.rows.empty() ? diagnostics : warnings, finest, processes);
      }
      catch (const NoPoints &)
      {
        if (level + 1 == n_levels)
          throw;
        diagnostics.note(statement.mesh.where,
                         fmt::format("level {} is left out: every point of the rule lies where values are fixed", level));
        continue;
      }
      if (!solution.result.constraints.empty())
        study.quadrature = solution.result.constraints[0].quadrature;
      MeshStudy::Row row = row_of_level(level, solution.result);
      row.seconds = watch.lap();
      if (epsilon.prescribed() && row.errors)
      {
        Diagnostics         nobody;
        FinestLevelProgress unshown(progress, std::nullopt);
        row.mixed_errors = solve<dim>(by_mixed_method(wanted), nobody, unshown, processes).result.errors;
      }
      if (coarser.problem && !row.errors)
        add_difference(study.rows.back(), coarser, solution);
      study.rows.push_back(row);
      coarser = std::move(solution);
    }
    if (options.adaptive)
    {
      coarser = {};
      ProblemStatement adaptive = statement;
      adaptive.method = on_level(statement, study.rows.front().level, epsilon).method;
      study.adaptive = study_adaptive_meshes<dim>(adaptive, study.rows.front().level, study.rows.back().n_dofs, progress, processes);
    }
    return study;
  }

  std::vector<MeshStudyColumn> error_columns(const MeshStudy &study)
  {
    std::vector<MeshStudyColumn> columns;
    const auto                   add = [&](const std::string &name, const auto &value)
    {
      if (std::any_of(study.rows.begin(), study.rows.end(), [&](const auto &row) { return value(row).has_value(); }))
        columns.push_back({name, value});
    };
    const auto of = [](const std::optional<Errors> &errors, const auto member) { return errors ? (*errors).*member : std::nullopt; };
    add("L2", [of](const MeshStudy::Row &row) { return of(row.errors, &Errors::L2); });
    add("H1_semi", [of](const MeshStudy::Row &row) { return of(row.errors, &Errors::H1_semi); });
    add("max_nodal", [of](const MeshStudy::Row &row) { return of(row.errors, &Errors::max_nodal); });
    add("pressure_L2", [of](const MeshStudy::Row &row) { return of(row.errors, &Errors::pressure_L2); });
    add("mixed_L2", [of](const MeshStudy::Row &row) { return of(row.mixed_errors, &Errors::L2); });
    add("mixed_H1_semi", [of](const MeshStudy::Row &row) { return of(row.mixed_errors, &Errors::H1_semi); });
    add("mixed_pressure_L2", [of](const MeshStudy::Row &row) { return of(row.mixed_errors, &Errors::pressure_L2); });
    add("difference_L2", [](const MeshStudy::Row &row) { return row.difference_L2; });
    add("difference_H1_semi", [](const MeshStudy::Row &row) { return row.difference_H1_semi; });
    add("penalty_error_bound", [](const MeshStudy::Row &row) { return row.penalty_error_bound; });
    return columns;
  }

  std::vector<std::optional<double>> rates(const MeshStudy &study, const MeshStudyColumn &column)
  {
    std::vector<std::optional<double>> result;
    for (std::size_t k = 1; k < study.rows.size(); ++k)
    {
      const auto coarse = column.value(study.rows[k - 1]), fine = column.value(study.rows[k]);
      if (coarse && fine && *coarse > 0 && *fine > 0)
        result.push_back(std::log(*coarse / *fine) / std::log(study.rows[k - 1].h / study.rows[k].h));
      else
        result.push_back(std::nullopt);
    }
    return result;
  }

  Json to_json(const MeshStudy &study, const CaseSource &source)
  {
    Json json;
    json["schema_version"] = 1;
    json["program"] = program_json(Processes::all().size());
    json["case"] = to_json(source);
    json["element"] = study.element;
    json["quadrature"] = study.quadrature;
    json["epsilon"] = study.epsilon_rule;
    json["rows"] = Json::array();
    const auto optional = [](const auto &value) { return value ? Json(*value) : Json(nullptr); };
    for (const auto &row : study.rows)
    {
      Json entry = {{"level", row.level}, {"h", row.h}, {"n_dofs", row.n_dofs}, {"epsilon", row.epsilon}};
      if (row.errors)
        entry["errors"] = to_json(*row.errors);
      else
        entry["differences"] = {{"L2", optional(row.difference_L2)}, {"H1_semi", optional(row.difference_H1_semi)}};
      if (row.mixed_errors)
        entry["mixed_errors"] = to_json(*row.mixed_errors);
      entry["total_contact_force"] = row.total_contact_force;
      entry["contact_measure"] = row.contact_measure;
      entry["max_contact_pressure"] = row.max_contact_pressure;
      if (row.max_von_mises)
        entry["max_von_mises"] = *row.max_von_mises;
      entry["energy"] = row.energy;
      entry["penalty_error_bound"] = optional(row.penalty_error_bound);
      entry["discretisation_indicator"] = row.discretisation_indicator;
      entry["iterations"] = {{"newton", row.newton_iterations}, {"linear", row.linear_iterations}};
      entry["seconds"] = row.seconds;
      entry["converged"] = row.converged;
      json["rows"].push_back(entry);
    }
    if (study.adaptive)
      json["adaptive"] = to_json(*study.adaptive);
    json["rates"] = Json::object();
    for (const auto &column : error_columns(study))
    {
      json["rates"][column.name] = Json::array();
      for (const auto &rate : rates(study, column))
        json["rates"][column.name].push_back(optional(rate));
    }
    return json;
  }

  std::string to_csv(const MeshStudy &study)
  {
    const auto  columns = error_columns(study);
    const bool  has_stress = std::any_of(study.rows.begin(), study.rows.end(), [](const auto &row) { return row.max_von_mises; });
    const auto  number = [](const std::optional<double> &value) { return value ? fmt::format(",{:.12g}", *value) : std::string(","); };
    std::string text = "level,h,n_dofs,epsilon";
    std::vector<std::vector<std::optional<double>>> rates_of_columns;
    for (const auto &column : columns)
    {
      text += fmt::format(",{},rate_{}", column.name, column.name);
      rates_of_columns.push_back(rates(study, column));
    }
    text += ",total_contact_force,contact_measure,max_contact_pressure";
    text += has_stress ? ",max_von_mises" : "";
    text += ",energy,newton_iterations,linear_iterations,seconds\n";
    for (std::size_t k = 0; k < study.rows.size(); ++k)
    {
      const MeshStudy::Row &row = study.rows[k];
      text += fmt::format("{},{:.12g},{},{:.12g}", row.level, row.h, row.n_dofs, row.epsilon);
      for (std::size_t c = 0; c < columns.size(); ++c)
      {
        text += number(columns[c].value(row));
        text += number(k > 0 ? rates_of_columns[c][k - 1] : std::nullopt);
      }
      text += fmt::format(",{:.12g},{:.12g},{:.12g}", row.total_contact_force, row.contact_measure, row.max_contact_pressure);
      if (has_stress)
        text += number(row.max_von_mises);
      text += fmt::format(",{:.12g},{},{},{:.3f}\n", row.energy, row.newton_iterations, row.linear_iterations, row.seconds);
    }
    return text;
  }

#define INSTANTIATE(dim)                                                                                                                   \
  template MeshStudy study_mesh<dim>(const ProblemStatement &, const MeshStudyOptions &, Diagnostics &, Progress &, const Processes &);
  INSTANTIATE(1)
  INSTANTIATE(2)
  INSTANTIATE(3)
#undef INSTANTIATE
} // namespace unilateral
