#include "unilateral/output/solution_files.h"

#include "unilateral/evaluation/estimator.h"
#include "unilateral/evaluation/nodal_pressure.h"
#include "unilateral/forms/elasticity.h"
#include "unilateral/output/result_files.h"
#include "unilateral/output/solution_vtu.h"
#include "unilateral/spaces/cell_points.h"

#include <algorithm>
#include <fmt/format.h>

#include <cctype>
#include <cmath>
#include <filesystem>
#include <system_error>

namespace unilateral
{
  using namespace dealii;

  namespace
  {
    /// The bound of a block at the nodes; it need not have a value away from the points of I_G, and is left out then.
    template <int dim>
    bool bound_at_nodes(
      const Problem<dim> &problem, const ConstraintSet<dim> &set, const std::size_t block, const FieldFunction &bound, Vector &values)
    {
      const auto &fe = *problem.space.fe;
      values.reinit(problem.space.dof_handler.n_dofs());
      // Points that are nodes know it.
      std::vector<bool> known(values.size(), false);
      for (std::size_t i = set.blocks[block].begin; i < set.blocks[block].end; ++i)
        if (const auto row = set.trace[i]; row.dofs.size() == 1 && std::abs(row.values[0] - 1) < 1e-12)
        {
          values(row.dofs[0]) = set.points[i].bound;
          known[row.dofs[0]] = true;
        }
      CellPoints<dim>                      nodes(*problem.space.mapping, fe.reference_cell(), fe.get_unit_support_points());
      std::vector<types::global_dof_index> dofs(fe.n_dofs_per_cell());
      try
      {
        for (const auto &cell : problem.space.dof_handler.active_cell_iterators())
        {
          cell->get_dof_indices(dofs);
          if (std::all_of(dofs.begin(), dofs.end(), [&](const auto dof) { return known[dof]; }))
            continue;
          const auto &x = nodes.on(cell);
          for (unsigned k = 0; k < dofs.size(); ++k)
            if (!known[dofs[k]])
            {
              values(dofs[k]) = bound.value(x[k]);
              known[dofs[k]] = true;
            }
        }
      }
      catch (const InputError &)
      {
        return false;
      }
      return true;
    }

    /// Of a mesh of adaptive refinement that another one follows: "solution.3.vtu".
    std::string file_of_cycle(const std::string &name, const unsigned cycle)
    {
      return fmt::format("{}.{}.vtu", name, cycle);
    }

    /// Scalar fields at the nodes of a body: the recovered stress, and the size of each constraint's contact traction.
    template <int dim>
    std::vector<std::pair<std::string, Vector>>
    fields_of_body(const Solution<dim> &solution, const RecoveredFlux<dim> &stress, const std::vector<Vector> &tractions)
    {
      const auto                                 &problem = *solution.problem;
      const auto                                  n_nodes = stress.nodes->n_dofs();
      std::vector<std::pair<std::string, Vector>> fields;
      for (const auto *const name : {"von_mises", "stress_xx", "stress_yy", "stress_zz", "stress_xy", "stress_xz", "stress_yz"})
        if (dim == 3 || std::string(name).find("xz") == std::string::npos)
          if (dim == 3 || std::string(name).find("yz") == std::string::npos)
            fields.emplace_back(name, Vector(n_nodes));
      const std::size_t principal = fields.size();
      for (const auto *const name : {"stress_1", "stress_2", "stress_3"})
        fields.emplace_back(name, Vector(n_nodes));
      for (types::global_dof_index node = 0; node < n_nodes; ++node)
      {
        const Stress at = stress.mean_at(node);
        fields[0].second(node) = von_mises(at);
        for (std::size_t c = 1; c < principal; ++c)
          fields[c].second(node) = at[c - 1];
        const auto values = principal_stresses(at);
        for (std::size_t c = 0; c < values.size(); ++c)
          fields[principal + c].second(node) = values[c];
      }
      const std::size_t first = fields.size();
      for (std::size_t b = 0; b < tractions.size(); ++b)
        fields.emplace_back("contact_pressure" + (tractions.size() > 1 ? "_" + std::to_string(b) : std::string()), Vector(n_nodes));
      const auto                          &fe = *problem.space.fe;
      std::vector<types::global_dof_index> dofs(fe.n_dofs_per_cell()), nodes(fe.n_dofs_per_cell() / fe.n_components());
      for (const auto &cell : problem.space.dof_handler.active_cell_iterators())
      {
        cell->get_dof_indices(dofs);
        typename DoFHandler<dim>::active_cell_iterator(&*problem.space.mesh.triangulation, cell->level(), cell->index(), &*stress.nodes)
          ->get_dof_indices(nodes);
        for (unsigned k = 0; k < nodes.size(); ++k)
          for (std::size_t b = 0; b < tractions.size(); ++b)
          {
            double sum = 0;
            for (unsigned c = 0; c < fe.n_components(); ++c)
              sum += std::pow(tractions[b](dofs[fe.component_to_system_index(c, k)]), 2);
            fields[first + b].second(nodes[k]) = std::sqrt(sum);
          }
      }
      return fields;
    }

    /// The functions beside u that a file of the solution has; `named` points to the others.
    template <int dim>
    struct FieldsOfSolution
    {
      std::vector<std::pair<std::string, Vector>> fields;
      std::vector<NamedField<dim>>                named;
    };

    template <int dim>
    FieldsOfSolution<dim> fields_of(const Solution<dim> &solution)
    {
      const auto &problem = *solution.problem;
      const auto &constraint_set = solution.constraint_set;

      FieldsOfSolution<dim> result;
      auto                 &fields = result.fields;
      std::vector<Vector>   pressures;
      for (const auto &block : constraint_set.blocks)
        pressures.push_back(nodal_pressure(problem, constraint_set, block, solution.contact_pressure));
      if (problem.form->n_components() > 1)
      {
        fields = fields_of_body(solution, *solution.flux, pressures);
      }
      else
        for (std::size_t b = 0; b < constraint_set.blocks.size(); ++b)
        {
          const auto       &block = constraint_set.blocks[b];
          const std::string suffix = constraint_set.blocks.size() > 1 ? "_" + std::to_string(b) : "";
          fields.emplace_back("contact_pressure" + suffix, pressures[b]);
          Vector bound;
          if (!problem.conditions[b].part && !problem.space.hermite() &&
              !problem.space.processes().any(!bound_at_nodes(problem, constraint_set, b, problem.conditions[b].bound, bound)))
            fields.emplace_back((block.side == Side::lower ? "lower" : "upper") + suffix, std::move(bound));
        }
      for (const auto &[name, field] : fields)
        result.named.push_back({name, &field, problem.form->n_components() > 1 ? solution.flux->nodes : nullptr});
      return result;
    }
  } // namespace

  template <int dim>
  SolutionGrids grids_of(const Solution<dim> &solution)
  {
    const auto &problem = *solution.problem;
    const auto  fields = fields_of(solution);
    return {solution_grid<dim>(*problem.space.mapping, problem.space.dof_handler, solution.displacement, problem.space.element.degree,
                               fields.named),
            constraint_points_grid<dim>(solution.constraint_set, solution.constraint_set.values_of(solution.displacement),
                                        {solution.contact_pressure.begin(), solution.contact_pressure.end()})};
  }

  void write_cycles_pvd(const unsigned n_cycles, const bool last, const std::string &directory)
  {
    for (const std::string name : {"solution", "constraint-points"})
    {
      // Those that several processes have written are held together by a .pvtu file.
      const auto as_written = [&](const std::string &file)
      {
        std::error_code failure;
        return std::filesystem::exists(std::filesystem::path(directory) / file, failure)
                 ? file
                 : std::filesystem::path(file).replace_extension(".pvtu").string();
      };
      std::vector<std::string> files;
      for (unsigned cycle = 0; cycle < n_cycles; ++cycle)
        files.push_back(as_written(file_of_cycle(name, cycle)));
      if (last)
        files.push_back(as_written(name + ".vtu"));
      write_file_atomically((std::filesystem::path(directory) / (name + ".pvd")).string(), to_pvd(files));
    }
  }

  template <int dim>
  void write_solution(const Solution<dim> &solution, const std::string &directory, const std::optional<unsigned> cycle)
  {
    const auto &problem = *solution.problem;
    const auto &constraint_set = solution.constraint_set;
    const auto  fields = fields_of(solution);

    // Where each of several processes has a part, it writes its piece.
    const auto &processes = problem.space.processes();
    const auto  name_of = [&](const std::string &name, const unsigned rank)
    { return fmt::format("{}{}.part{}.vtu", name, cycle ? fmt::format(".{}", *cycle) : "", rank); };
    const auto path_of = [&](const std::string &name)
    {
      const std::string file = !processes.alone() ? name_of(name, processes.rank()) : cycle ? file_of_cycle(name, *cycle) : name + ".vtu";
      return std::filesystem::path(directory) / file;
    };
    const auto pieces_of = [&](const std::string &name)
    {
      Pieces pieces;
      if (const auto &subdomain = problem.space.subdomain)
        pieces.coarse_level = subdomain->level_of_coarse_cells();
      for (unsigned rank = 0; rank < processes.size() && !processes.alone(); ++rank)
        pieces.files.push_back(name_of(name, rank));
      return pieces;
    };
    write_solution_vtu<dim>(path_of("solution"), *problem.space.mapping, problem.space.dof_handler, solution.displacement,
                            problem.space.element.degree, fields.named, pieces_of("solution"));
    write_constraint_points_vtu<dim>(path_of("constraint-points"), constraint_set, constraint_set.values_of(solution.displacement),
                                     {solution.contact_pressure.begin(), solution.contact_pressure.end()}, pieces_of("constraint-points"));
  }

  template <int dim>
  void write_constraint_points_csv(const Solution<dim> &solution, const std::string &directory)
  {
    const auto       &set = solution.constraint_set;
    const VtuGrid     grid = constraint_points_grid(set, set.values_of(solution.displacement),
                                                    {solution.contact_pressure.begin(), solution.contact_pressure.end()});
    const auto       &processes = solution.problem->space.processes();
    const std::string name =
      processes.alone() ? std::string("constraint-points.csv") : fmt::format("constraint-points.part{}.csv", processes.rank());
    write_file_atomically(
      (std::filesystem::path(directory) / name).string(),
      [&](std::ostream &out)
      {
        out << "on";
        for (unsigned d = 0; d < dim; ++d)
          out << ',' << "xyz"[d];
        for (const VtuArray &array : grid.point_arrays)
          for (unsigned c = 0; c < (array.n_components > 1 ? dim : 1); ++c)
            out << ',' << array.name << (array.n_components > 1 ? fmt::format("_{}", "xyz"[c]) : "");
        out << '\n';
        const auto &block_of = std::get<std::vector<std::int32_t>>(
          std::find_if(grid.point_arrays.begin(), grid.point_arrays.end(), [](const VtuArray &array) { return array.name == "block"; })
            ->values);
        for (std::size_t i = 0; i < grid.points.size(); ++i)
        {
          out << csv_text(set.blocks[block_of[i]].on);
          for (unsigned d = 0; d < dim; ++d)
            out << fmt::format(",{}", grid.points[i][d]);
          for (const VtuArray &array : grid.point_arrays)
            for (unsigned c = 0; c < (array.n_components > 1 ? dim : 1); ++c)
              out << std::visit([&](const auto &values) { return fmt::format(",{}", values[i * array.n_components + c]); }, array.values);
          out << '\n';
        }
      });
  }

  bool is_solution_file(const std::string &name)
  {
    for (const std::string start : {"solution.", "constraint-points."})
      if (name.starts_with(start))
      {
        std::string rest = name.substr(start.size());
        const auto  skip_number = [&](const std::string &before)
        {
          if (rest.starts_with(before) && rest.size() > before.size() && std::isdigit(static_cast<unsigned char>(rest[before.size()])))
          {
            rest.erase(0, before.size());
            rest.erase(0, rest.find_first_not_of("0123456789"));
            if (rest.starts_with("."))
              rest.erase(0, 1);
          }
        };
        skip_number("");     // of a cycle
        skip_number("part"); // of a process
        return rest == "vtu" || rest == "pvtu" || rest == "pvd" || rest == "csv";
      }
    return false;
  }

  template void          write_solution(const Solution<1> &, const std::string &, std::optional<unsigned>);
  template void          write_constraint_points_csv(const Solution<1> &, const std::string &);
  template SolutionGrids grids_of(const Solution<1> &);
  template void          write_solution(const Solution<2> &, const std::string &, std::optional<unsigned>);
  template void          write_constraint_points_csv(const Solution<2> &, const std::string &);
  template SolutionGrids grids_of(const Solution<2> &);
  template void          write_solution(const Solution<3> &, const std::string &, std::optional<unsigned>);
  template void          write_constraint_points_csv(const Solution<3> &, const std::string &);
  template SolutionGrids grids_of(const Solution<3> &);
} // namespace unilateral
