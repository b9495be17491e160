#include "unilateral/evaluation/reaction_goal.h"

#include "unilateral/base/sort_unique.h"
#include "unilateral/evaluation/held_unknowns.h"
#include "unilateral/evaluation/nodal_forces.h"

#include <deal.II/base/exceptions.h>

#include <vector>

namespace unilateral
{
  using namespace dealii;

  template <int dim>
  std::vector<std::string> parts_with_reactions(const Problem<dim> &problem)
  {
    std::vector<std::string> names;
    for (const auto &[part, unknowns] : HeldUnknowns<dim>(problem).by_part())
      names.push_back(problem.space.mesh.part_names[part]);
    return names;
  }

  template <int dim>
  Vector motion_of_support(const Problem<dim> &problem, const std::size_t number, const unsigned component)
  {
    const HeldUnknowns<dim> held(problem);
    const auto              by_part = held.by_part();
    std::vector<unsigned>   parts; // of all processes
    for (const auto &[part, unknowns] : by_part)
      parts.push_back(part);
    parts = problem.space.processes().gather(parts);
    sort_unique(parts);
    AssertIndexRange(number, parts.size());
    Vector w;
    w.reinit(problem.space.dof_handler.n_dofs());
    if (const auto here = by_part.find(parts[number]); here != by_part.end())
      for (const auto dof : here->second)
        if (held.component[dof] == component)
          w(dof) = 1;
    problem.space.hanging_nodes.distribute(w);
    return w;
  }

  template <int dim>
  Vector stiffness_times(const Problem<dim> &problem, const ConstraintSet<dim> &constraint_set, const Vector &w)
  {
    Vector no_pressure;
    no_pressure.reinit(constraint_set.size());
    const auto forces = forces_at_unknowns(problem, constraint_set, w, no_pressure);
    Vector     Aw(forces.missing);
    Aw += forces.load;
    problem.space.shared().add(Aw.begin());
    for (const auto &line : problem.space.dirichlet.get_lines())
    {
      for (const auto &[dof, weight] : line.entries)
        Aw(dof) += weight * Aw(line.index);
      Aw(line.index) = 0;
    }
    return Aw;
  }

#define INSTANTIATE(dim)                                                                                                                   \
  template std::vector<std::string> parts_with_reactions(const Problem<dim> &);                                                            \
  template Vector                   motion_of_support(const Problem<dim> &, std::size_t, unsigned);                                        \
  template Vector                   stiffness_times(const Problem<dim> &, const ConstraintSet<dim> &, const Vector &);
  INSTANTIATE(1)
  INSTANTIATE(2)
  INSTANTIATE(3)
#undef INSTANTIATE
} // namespace unilateral
