#include "unilateral/evaluation/held_unknowns.h"

#include "unilateral/evaluation/nodal_forces.h"
#include "unilateral/mesh/reference_face.h"

#include <algorithm>
#include <limits>

namespace unilateral
{
  using namespace dealii;

  template <int dim>
  HeldUnknowns<dim>::HeldUnknowns(const Problem<dim> &problem)
    : component(problem.space.dof_handler.n_dofs()), is_held(component.size(), false), problem(problem)
  {
    find_parts();
    const std::vector<bool> tied = tied_unknowns(problem);
    for (const auto &line : problem.space.dirichlet.get_lines())
    {
      if (problem.space.hanging_nodes.is_constrained(line.index) || tied[line.index])
        continue;
      is_held[line.index] = true;
      for (const auto &entry : line.entries)
        is_held[entry.first] = true;
    }
  }

  template <int dim>
  void HeldUnknowns<dim>::find_parts()
  {
    const auto                          &fe = *problem.space.fe;
    std::vector<types::global_dof_index> dofs(fe.n_dofs_per_cell());
    for (const auto &cell : problem.space.dof_handler.active_cell_iterators())
    {
      cell->get_dof_indices(dofs);
      for (unsigned i = 0; i < dofs.size(); ++i)
        component[dofs[i]] = fe.system_to_component_index(i).first;
      for (const auto face : cell->face_indices())
      {
        if (!cell->at_boundary(face))
          continue;
        const auto  part = cell->face(face)->boundary_id();
        const auto &condition = problem.prescribed.conditions[part];
        if (!condition.symmetry && condition.components.empty())
          continue;
        for (unsigned i = 0; i < dofs.size(); ++i)
          if (problem.space.dirichlet.is_constrained(dofs[i]) && lies_on_face<dim>(cell->reference_cell(), face, fe.unit_support_point(i)))
          {
            const auto [entry, is_new] = part_of.emplace(dofs[i], part);
            entry->second = std::min<unsigned>(entry->second, part);
          }
      }
    }
    if (problem.space.processes().alone())
      return;
    // A process may have a node of the boundary and none of the faces there.
    constexpr double none = std::numeric_limits<double>::max();
    Vector           part_at(component.size());
    part_at = none;
    for (const auto &[dof, part] : part_of)
      part_at(dof) = part;
    problem.space.shared().minimize(part_at.begin());
    for (std::size_t dof = 0; dof < component.size(); ++dof)
      if (part_at(dof) != none)
        part_of[dof] = part_at(dof);
  }

  template <int dim>
  std::map<unsigned, std::vector<types::global_dof_index>> HeldUnknowns<dim>::by_part() const
  {
    std::map<unsigned, std::vector<types::global_dof_index>> unknowns;
    for (const auto &platen : problem.space.couplings.rigid_parts)
      for (std::size_t k = 0; k < platen.nodes.size() && platen.restrained; ++k)
        for (unsigned c = 0; c < problem.form->n_components(); ++c)
          unknowns[platen.part].push_back(platen.nodes[k].dofs[c]);
    for (const auto &[dof, part] : part_of)
      if (is_held[dof])
        unknowns[part].push_back(dof);
    return unknowns;
  }

  template struct HeldUnknowns<1>;
  template struct HeldUnknowns<2>;
  template struct HeldUnknowns<3>;
} // namespace unilateral
