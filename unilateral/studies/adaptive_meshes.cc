#include "unilateral/studies/adaptive_meshes.h"

#include "unilateral/base/stopwatch.h"
#include "unilateral/evaluation/solution_errors.h"
#include "unilateral/output/results.h"
#include "unilateral/solve.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <cmath>

namespace unilateral
{
  namespace
  {
    /// Smaller than any error: refinement ends at the number of unknowns.
    constexpr double never_met = 1e-15;

    template <int dim>
    AdaptiveMeshes::Row row_of_mesh(const Solution<dim> &solution)
    {
      AdaptiveMeshes::Row row;
      row.discretisation_indicator = solution.result.discretisation_indicator;
      const auto &exact = solution.problem->statement.exact;
      if (!exact.u.empty() || exact.pressure)
        row.errors = solution_errors(*solution.problem, solution.constraint_set, solution.displacement, solution.contact_pressure);
      const auto &points = solution.constraint_set.points;
      for (std::size_t i = 0; i < points.size(); ++i)
        if (points[i].owned)
          row.total_contact_force += points[i].weight * solution.contact_pressure(i);
      row.total_contact_force = solution.problem->space.processes().sum(row.total_contact_force);
      return row;
    }

    std::optional<double> error_of(const AdaptiveMeshes::Row &row)
    {
      if (row.errors && row.errors->energy)
        return row.errors->energy;
      return row.discretisation_indicator > 0 ? std::optional(row.discretisation_indicator) : std::nullopt;
    }
  } // namespace

  template <int dim>
  AdaptiveMeshes study_adaptive_meshes(const ProblemStatement &statement,
                                       const unsigned          coarsest,
                                       const std::size_t       max_unknowns,
                                       Progress               &progress,
                                       const Processes        &processes)
  {
    ProblemStatement wanted = statement;
    wanted.mesh.refine = coarsest;
    AdaptiveMeshes study;
    if (statement.mesh.adapt && !statement.mesh.adapt->goal.is_a_number())
      study.tolerance = statement.mesh.adapt->tolerance;
    else
    {
      wanted.mesh.adapt.emplace();
      wanted.mesh.adapt->tolerance = never_met;
      wanted.mesh.adapt->max_unknowns = max_unknowns;
    }
    study.max_unknowns = wanted.mesh.adapt->max_unknowns;

    Stopwatch  watch;
    double     seconds = 0; // without what the study itself computes
    const auto add_row = [&](const Solution<dim> &solution)
    {
      seconds += watch.lap();
      study.rows.push_back(row_of_mesh(solution));
      study.rows.back().seconds = seconds;
      watch.lap();
    };
    Diagnostics         known; // from the uniform meshes
    const Solution<dim> last = solve<dim>(wanted, known, progress, processes, add_row);
    add_row(last);
    study.converged = last.result.converged;
    const auto cycles = last.result.estimate ? last.result.estimate->cycles : std::vector<Estimate::Cycle>();
    if (cycles.size() != study.rows.size())
      throw InputError(statement.mesh.where, "the error of this problem is not estimated: there is nothing to refine its mesh by",
                       MessageName("kind-does-not-fit"));
    for (std::size_t k = 0; k < cycles.size(); ++k)
    {
      AdaptiveMeshes::Row &row = study.rows[k];
      row.n_cells = cycles[k].n_cells;
      row.n_dofs = cycles[k].n_dofs;
      row.total = cycles[k].total;
      row.relative = cycles[k].relative;
      row.guaranteed = cycles[k].guaranteed;
    }
    return study;
  }

  std::vector<std::optional<double>> orders(const AdaptiveMeshes &study)
  {
    std::vector<std::optional<double>> result;
    for (std::size_t k = 1; k < study.rows.size(); ++k)
    {
      const auto   coarse = error_of(study.rows[k - 1]), fine = error_of(study.rows[k]);
      const double growth = double(study.rows[k].n_dofs) / double(study.rows[k - 1].n_dofs);
      result.push_back(coarse && fine && growth > 1 ? std::optional(std::log(*coarse / *fine) / std::log(growth)) : std::nullopt);
    }
    return result;
  }

  nlohmann::ordered_json to_json(const AdaptiveMeshes &study)
  {
    using Json = nlohmann::ordered_json;
    Json json = {{"tolerance", study.tolerance > 0 ? Json(study.tolerance) : Json(nullptr)},
                 {"max_unknowns", study.max_unknowns},
                 {"converged", study.converged},
                 {"rows", Json::array()},
                 {"orders", Json::array()}};
    for (const auto &row : study.rows)
    {
      Json entry = {{"n_cells", row.n_cells}, {"n_dofs", row.n_dofs}, {"discretisation_indicator", row.discretisation_indicator}};
      entry["estimate"] = {{"total", row.total}, {"relative", row.relative}, {"guaranteed", row.guaranteed}};
      if (row.errors)
        entry["errors"] = to_json(*row.errors);
      entry["total_contact_force"] = row.total_contact_force;
      entry["seconds"] = row.seconds;
      json["rows"].push_back(entry);
    }
    for (const auto &order : orders(study))
      json["orders"].push_back(order ? Json(*order) : Json(nullptr));
    return json;
  }

  std::string to_csv(const AdaptiveMeshes &study)
  {
    const auto  number = [](const std::optional<double> &value) { return value ? fmt::format(",{:.12g}", *value) : std::string(","); };
    std::string text = "n_cells,n_dofs,discretisation_indicator,total,relative,guaranteed,error_energy,error_H1_semi,error_L2,order,"
                       "total_contact_force,seconds\n";
    const auto  order = orders(study);
    for (std::size_t k = 0; k < study.rows.size(); ++k)
    {
      const auto  &row = study.rows[k];
      const Errors errors = row.errors.value_or(Errors());
      text += fmt::format("{},{},{:.12g},{:.12g},{:.12g},{}", row.n_cells, row.n_dofs, row.discretisation_indicator, row.total,
                          row.relative, row.guaranteed);
      text += number(errors.energy) + number(errors.H1_semi) + number(errors.L2) + number(k > 0 ? order[k - 1] : std::nullopt);
      text += fmt::format(",{:.12g},{:.3f}\n", row.total_contact_force, row.seconds);
    }
    return text;
  }

#define INSTANTIATE(dim)                                                                                                                   \
  template AdaptiveMeshes study_adaptive_meshes<dim>(const ProblemStatement &, unsigned, std::size_t, Progress &, const Processes &);
  INSTANTIATE(1)
  INSTANTIATE(2)
  INSTANTIATE(3)
#undef INSTANTIATE
} // namespace unilateral
