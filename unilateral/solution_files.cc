#include "unilateral/solution_files.h"

#include "unilateral/nested_iteration.h"
#include "unilateral/output.h"

#include <deal.II/dofs/dof_tools.h>

#include <filesystem>

namespace unilateral
{
  using namespace dealii;

  namespace
  {
    /// The bound at the nodes; it need not have a value away from the points of I_G, and is left out then.
    template <int dim>
    bool interpolate_bound(const Problem<dim> &problem, const FieldFunction &bound, Vector &values)
    {
      std::vector<Point<dim>> nodes(problem.dof_handler.n_dofs());
      DoFTools::map_dofs_to_support_points(*problem.mapping, problem.dof_handler, nodes);
      values.reinit(nodes.size());
      try
      {
        for (std::size_t j = 0; j < nodes.size(); ++j)
          values(j) = bound.value(nodes[j]);
      }
      catch (const InputError &)
      {
        return false;
      }
      return true;
    }
  } // namespace

  template <int dim>
  void write_solution(const Solution<dim> &solution, const std::string &directory)
  {
    const auto &problem = *solution.problem;
    const auto &constraint_set = solution.constraint_set;

    std::vector<std::pair<std::string, Vector>> fields;
    for (std::size_t b = 0; b < constraint_set.blocks.size(); ++b)
    {
      const auto       &block = constraint_set.blocks[b];
      const std::string suffix = constraint_set.blocks.size() > 1 ? "_" + std::to_string(b) : "";
      fields.emplace_back("contact_pressure" + suffix,
                          nodal_pressure(constraint_set, block, solution.contact_pressure, solution.displacement.size()));
      Vector bound;
      if (!problem.conditions[b].part && interpolate_bound(problem, problem.conditions[b].bound, bound))
        fields.emplace_back((block.side == Side::lower ? "lower" : "upper") + suffix, std::move(bound));
    }
    std::vector<NamedField> named;
    for (const auto &[name, field] : fields)
      named.emplace_back(name, &field);

    const std::filesystem::path folder(directory);
    write_solution_vtu<dim>(folder / "solution.vtu", *problem.mapping, problem.dof_handler, solution.displacement, problem.element.degree,
                            named);
    write_constraint_points_vtu<dim>(folder / "constraint-points.vtu", constraint_set, constraint_set.values_of(solution.displacement),
                                     {solution.contact_pressure.begin(), solution.contact_pressure.end()});
  }

  template void write_solution(const Solution<1> &, const std::string &);
  template void write_solution(const Solution<2> &, const std::string &);
  template void write_solution(const Solution<3> &, const std::string &);
} // namespace unilateral
