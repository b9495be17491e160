#include "unilateral/studies/preview.h"

#include "unilateral/base/processes.h"
#include "unilateral/discretisation/dear_functions.h"
#include "unilateral/discretisation/memory_estimate.h"
#include "unilateral/discretisation/problem.h"
#include "unilateral/discretisation/solver_choice.h"
#include "unilateral/evaluation/functionals.h"
#include "unilateral/evaluation/goal_error.h"
#include "unilateral/evaluation/probes.h"
#include "unilateral/inequality/discrete_problem.h"

#include <deal.II/fe/fe_values.h>

#include <nlohmann/json.hpp>

#include <algorithm>
#include <limits>

namespace unilateral
{
  using namespace dealii;

  namespace
  {
    /// Gap between the Dirichlet lift and the bounds of one block.
    template <int dim>
    CheckReport::Gap gap_of(const ConstraintBlock &block, const ConstraintSet<dim> &constraint_set, const std::vector<double> &values)
    {
      CheckReport::Gap gap;
      gap.on = block.on;
      gap.side = block.side == Side::lower ? "lower" : "upper";
      gap.quadrature = block.rule.name();
      gap.exact_pairing = block.exact_pairing;
      gap.n_points = block.end - block.begin;
      gap.n_missed = block.n_missed;
      if (gap.n_points == 0)
        return gap;
      gap.min = std::numeric_limits<double>::max();
      gap.max = std::numeric_limits<double>::lowest();
      std::size_t n_violated = 0;
      for (std::size_t i = block.begin; i < block.end; ++i)
      {
        const double distance = constraint_set.points[i].sign * (constraint_set.points[i].bound - values[i]);
        gap.min = std::min(gap.min, distance);
        gap.max = std::max(gap.max, distance);
        n_violated += distance < 0;
      }
      gap.share_violated = double(n_violated) / gap.n_points;
      return gap;
    }

    /// Size, place and direction of the parts of the boundary. An axisymmetric body is measured in its half plane.
    template <int dim>
    std::vector<CheckReport::Part> describe_parts(const Problem<dim> &problem)
    {
      const auto                    &names = problem.space.mesh.part_names;
      std::vector<CheckReport::Part> parts(names.size());
      std::vector<Tensor<1, dim>>    moments(names.size()), normals(names.size());
      FEFaceValues<dim>              values(*problem.space.mapping, *problem.space.fe, problem.face_quadrature(),
                                            update_quadrature_points | update_JxW_values | update_normal_vectors);
      for (const auto &cell : problem.space.dof_handler.active_cell_iterators())
        for (const auto face : cell->face_indices())
        {
          if (!cell->at_boundary(face) || cell->face(face)->boundary_id() >= parts.size())
            continue;
          const auto part = cell->face(face)->boundary_id();
          ++parts[part].n_faces;
          values.reinit(cell, face);
          for (const unsigned q : values.quadrature_point_indices())
          {
            parts[part].measure += values.JxW(q);
            moments[part] += values.JxW(q) * values.quadrature_point(q);
            normals[part] += values.JxW(q) * values.normal_vector(q);
          }
        }
      for (std::size_t part = 0; part < parts.size(); ++part)
      {
        parts[part].name = names[part];
        for (unsigned d = 0; d < dim && parts[part].measure > 0; ++d)
        {
          parts[part].centre.push_back(moments[part][d] / parts[part].measure);
          parts[part].normal.push_back(normals[part][d] / parts[part].measure);
        }
      }
      return parts;
    }

    /// The faces at the boundary as cells of their own; their sides are straight.
    template <int dim>
    VtuGrid boundary_grid(const Problem<dim> &problem)
    {
      const std::size_t n_parts = problem.space.mesh.part_names.size();
      VtuGrid           grid;
      // VTK's names of a vertex, line, triangle and quadrilateral.
      const auto type_of = [](const unsigned n_vertices) -> std::uint8_t {
        return n_vertices == 1 ? 1 : n_vertices == 2 ? 3 : n_vertices == 3 ? 5 : 9;
      };

      std::vector<std::int32_t> part_of_face;
      std::vector<double>       normals;
      FEFaceValues<dim>         values(*problem.space.mapping, *problem.space.fe, problem.face_quadrature(), update_normal_vectors);
      for (const auto &cell : problem.space.dof_handler.active_cell_iterators())
        for (const auto face : cell->face_indices())
        {
          if (!cell->at_boundary(face) || cell->face(face)->boundary_id() >= n_parts)
            continue;
          const unsigned n = cell->face(face)->n_vertices();
          // deal.II counts the corners of a quadrilateral by rows, VTK around it.
          for (unsigned k = 0; k < n; ++k)
          {
            const auto            x = cell->face(face)->vertex(n == 4 && k > 1 ? 5 - k : k);
            std::array<double, 3> point{};
            for (unsigned d = 0; d < dim; ++d)
              point[d] = x[d];
            grid.connectivity.push_back(std::int32_t(grid.points.size()));
            grid.points.push_back(point);
          }
          grid.offsets.push_back(std::int32_t(grid.points.size()));
          grid.cell_types.push_back(type_of(n));
          part_of_face.push_back(std::int32_t(cell->face(face)->boundary_id()));
          values.reinit(cell, face);
          Tensor<1, dim> normal;
          for (const unsigned q : values.quadrature_point_indices())
            normal += values.normal_vector(q);
          for (unsigned d = 0; d < 3; ++d)
            normals.push_back(d < dim ? normal[d] / normal.norm() : 0.);
        }
      grid.cell_arrays.push_back({"part", std::move(part_of_face)});
      grid.cell_arrays.push_back({"normal", std::move(normals), 3});
      return grid;
    }
  } // namespace

  template <int dim>
  CheckReport check(const ProblemStatement &statement, Diagnostics &diagnostics, Progress &progress, const bool with_boundary)
  {
    progress.phase("mesh");
    check_memory(statement, dim, known_coarse_cells(statement, dim));
    Problem<dim> problem(statement, diagnostics);
    check_functionals(problem);
    check_goal(problem);
    check_memory(statement, dim, problem.growth_in_places() * problem.space.mesh.triangulation->n_active_cells());
    CheckReport report;
    report.region_names = problem.space.mesh.region_names;
    report.element = statement.model.element.name();
    report.linear_solver = Discretisation<dim>(problem).reason();
    std::vector<Vector> nothing_to_carry;
    for (unsigned level = 0;; ++level)
    {
      progress.phase("setup", "level " + std::to_string(level));
      prepare_dear_functions(problem);
      const auto constraint_set = problem.make_constraint_set();
      report.levels.push_back(
        {level, problem.space.mesh.triangulation->n_active_cells(), problem.space.dof_handler.n_dofs(), constraint_set.size()});
      if (level == statement.mesh.n_refinements())
      {
        check_probes(problem);
        Vector lift(problem.space.dof_handler.n_dofs());
        problem.space.dirichlet.distribute(lift);
        const auto values = constraint_set.values_of(lift);
        for (const auto &block : constraint_set.blocks)
          report.gaps.push_back(gap_of(block, constraint_set, values));
        break;
      }
      if (progress.stop_requested())
        throw Interrupted();
      problem.refine(nothing_to_carry);
    }
    report.parts = describe_parts(problem);
    if (with_boundary)
      report.boundary = boundary_grid(problem);
    std::tie(report.h_min, report.h_max) = problem.space.cell_sizes();
    warn_about_fine_rasters(problem, diagnostics);
    for (const auto &constraint : statement.constraints)
    {
      ProblemStatement alone = statement;
      alone.constraints = {constraint};
      try
      {
        Diagnostics nobody;
        report.stability.push_back(study_inf_sup<dim>(
          alone, {.n_levels = 3, .with_contact = false, .limits = {.dense_entries = 2000000, .sparse = 4000, .dual = 10000}}, nobody,
          progress));
      }
      catch (const InputError &)
      {
        // A coarse mesh that is too large for a glance.
      }
    }
    return report;
  }

  nlohmann::ordered_json to_json(const CheckReport &report, const CaseSource &source, const unsigned dimension)
  {
    using Json = nlohmann::ordered_json;
    Json json;
    json["schema_version"] = 1;
    json["program"] = program_json(Processes::all().size());
    json["case"] = to_json(source);
    json["mesh"] = {{"dimension", dimension}, {"h_min", report.h_min},          {"h_max", report.h_max},
                    {"parts", Json::array()}, {"regions", report.region_names}, {"boundary", Json::array()}};
    for (const CheckReport::Part &part : report.parts)
    {
      json["mesh"]["parts"].push_back(part.name);
      json["mesh"]["boundary"].push_back(
        {{"part", part.name}, {"n_faces", part.n_faces}, {"measure", part.measure}, {"centre", part.centre}, {"normal", part.normal}});
    }
    json["space"] = {{"element", report.element}};
    json["method"]["solver_reason"] = report.linear_solver;
    json["levels"] = Json::array();
    for (const CheckReport::Level &level : report.levels)
      json["levels"].push_back(
        {{"level", level.level}, {"n_cells", level.n_cells}, {"n_dofs", level.n_dofs}, {"n_points", level.n_points}});
    json["constraint"] = Json::array();
    for (const CheckReport::Gap &gap : report.gaps)
      json["constraint"].push_back({{"on", gap.on},
                                    {"side", gap.side},
                                    {"quadrature", gap.quadrature},
                                    {"n_points", gap.n_points},
                                    {"exact_pairing", gap.exact_pairing},
                                    {"gap_min", gap.min},
                                    {"gap_max", gap.max},
                                    {"share_violated", gap.share_violated},
                                    {"n_missed", gap.n_missed}});
    json["stability"] = Json::array();
    for (const InfSupStudy &study : report.stability)
      json["stability"].push_back(constants_json(study));
    return json;
  }

  template CheckReport check<1>(const ProblemStatement &, Diagnostics &, Progress &, bool);
  template CheckReport check<2>(const ProblemStatement &, Diagnostics &, Progress &, bool);
  template CheckReport check<3>(const ProblemStatement &, Diagnostics &, Progress &, bool);
} // namespace unilateral
