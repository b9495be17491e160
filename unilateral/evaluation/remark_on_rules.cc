#include "unilateral/evaluation/remark_on_rules.h"

#include <fmt/format.h>

#include <algorithm>
#include <vector>

namespace unilateral
{
  namespace
  {
    /// How many unknowns the block's points press on: no more pressures than these can be told apart.
    template <int dim>
    std::size_t n_unknowns_pressed_on(const Problem<dim> &problem, const ConstraintSet<dim> &constraint_set, const ConstraintBlock &block)
    {
      std::vector<bool> pressed_on(problem.space.dof_handler.n_dofs(), false);
      for (std::size_t i = block.begin; i < block.end; ++i)
      {
        TraceRow free_row;
        double   prescribed = 0;
        resolve(constraint_set.trace[i], problem.space.dirichlet, free_row, prescribed);
        for (std::size_t k = 0; k < free_row.dofs.size(); ++k)
          if (free_row.values[k] != 0)
            pressed_on[free_row.dofs[k]] = true;
      }
      return std::count(pressed_on.begin(), pressed_on.end(), true);
    }
  } // namespace

  template <int dim>
  std::string remark_on_rules(const Problem<dim> &problem, const ConstraintSet<dim> &constraint_set)
  {
    const ElementName       &element = problem.space.element;
    std::vector<std::string> said;
    std::string              remark;
    for (std::size_t b = 0; b < constraint_set.blocks.size(); ++b)
    {
      const ConstraintBlock &block = constraint_set.blocks[b];
      const std::string      rule = block.rule.name(), usual = default_rule(element, problem.conditions[b].part ? dim - 1 : dim).name();
      if (rule == usual || std::find(said.begin(), said.end(), rule) != said.end())
        continue;
      said.push_back(rule);
      const std::size_t n_points = block.end - block.begin, n_unknowns = n_unknowns_pressed_on(problem, constraint_set, block);
      remark += remark.empty() ? "" : "; ";
      // A process that has a part of the mesh knows only its own points.
      if (n_points > n_unknowns && !problem.space.subdomain)
        remark += fmt::format("the rule {} has {} points on the {}, and {} has {} unknowns there, so that some pressures are undetermined",
                              rule, n_points, block.on, element.name(), n_unknowns);
      else
        remark += fmt::format("the rule {} may not go with {}, whose own one is {}", rule, element.name(), usual);
    }
    if (!remark.empty())
      remark += " (see 'unilateral infsup' and 'unilateral study quadrature')";
    return remark;
  }

  template std::string remark_on_rules(const Problem<1> &, const ConstraintSet<1> &);
  template std::string remark_on_rules(const Problem<2> &, const ConstraintSet<2> &);
  template std::string remark_on_rules(const Problem<3> &, const ConstraintSet<3> &);
} // namespace unilateral
