#include "unilateral/evaluation/contact_at_fixed_nodes.h"

#include "unilateral/constraints/quadrature_rule.h"

#include <deal.II/fe/fe_values.h>

#include <algorithm>
#include <memory>

namespace unilateral
{
  using namespace dealii;

  template <int dim>
  std::vector<double>
  force_at_fixed_nodes(const Problem<dim> &problem, const ConstraintSet<dim> &set, const std::size_t b, const Vector &lambda)
  {
    const ConstraintBlock     &block = set.blocks[b];
    const UnilateralCondition &condition = problem.conditions[b];
    std::vector<double>        pressure(problem.space.dof_handler.n_dofs(), -1.);
    for (std::size_t i = block.begin; i < block.end; ++i)
      for (const auto dof : set.trace[i].dofs)
        pressure[dof] = lambda(i);
    // A side condition on a motion that contact does not feel bears nothing.
    std::vector<types::global_dof_index> pinned;
    for (const auto &pin : problem.pinned_values())
      for (const auto &node : problem.space.nodal_values())
        if (node.component == pin.component && node.x.distance(pin.x) < 1e-10 * (1 + pin.x.norm()))
          pinned.push_back(node.dof);
    const auto &dirichlet = problem.space.dirichlet;
    const auto  fixed = [&](const types::global_dof_index dof)
    {
      return dirichlet.is_constrained(dof) && dirichlet.get_constraint_entries(dof)->empty() &&
             std::find(pinned.begin(), pinned.end(), dof) == pinned.end();
    };

    const auto                         flags = update_values | update_JxW_values | update_quadrature_points;
    std::unique_ptr<FEValues<dim>>     on_cells;
    std::unique_ptr<FEFaceValues<dim>> on_faces;
    if (condition.part)
      on_faces = std::make_unique<FEFaceValues<dim>>(*problem.space.mapping, *problem.space.fe,
                                                     quadrature_rule<dim - 1>(condition.rule, problem.space.element), flags);
    else
      on_cells = std::make_unique<FEValues<dim>>(*problem.space.mapping, *problem.space.fe,
                                                 quadrature_rule<dim>(condition.rule, problem.space.element), flags);
    std::vector<types::global_dof_index> dofs(problem.space.fe->n_dofs_per_cell());
    std::vector<double>                  force(problem.space.mesh.triangulation->n_active_cells(), 0.);
    const auto                           add = [&](const FEValuesBase<dim> &values, const std::size_t c)
    {
      double   sum = 0, weight_of_fixed = 0;
      unsigned n_points = 0;
      for (const unsigned q : values.quadrature_point_indices())
      {
        bool   any_fixed = false;
        double at_point = -1;
        for (unsigned k = 0; k < dofs.size(); ++k)
          if (values.shape_value(k, q) > 0.5)
          {
            any_fixed = any_fixed || fixed(dofs[k]);
            at_point = std::max(at_point, pressure[dofs[k]]);
          }
        if (at_point >= 0)
        {
          ++n_points;
          sum += at_point;
        }
        else if (any_fixed)
          weight_of_fixed += values.JxW(q) * problem.form->measure(values.quadrature_point(q));
      }
      if (n_points > 0)
        force[c] += weight_of_fixed * sum / n_points;
    };
    for (const auto &cell : problem.space.dof_handler.active_cell_iterators())
    {
      if (condition.part && !cell->at_boundary())
        continue;
      cell->get_dof_indices(dofs);
      if (std::none_of(dofs.begin(), dofs.end(), fixed) ||
          std::none_of(dofs.begin(), dofs.end(), [&](const auto dof) { return pressure[dof] > 0; }))
        continue;
      if (!condition.part)
      {
        on_cells->reinit(cell);
        add(*on_cells, cell->active_cell_index());
        continue;
      }
      for (const auto face : cell->face_indices())
        if (cell->at_boundary(face) && cell->face(face)->boundary_id() == *condition.part)
        {
          on_faces->reinit(cell, face);
          add(*on_faces, cell->active_cell_index());
        }
    }
    return force;
  }

#define INSTANTIATE(dim)                                                                                                                   \
  template std::vector<double> force_at_fixed_nodes(const Problem<dim> &, const ConstraintSet<dim> &, std::size_t, const Vector &);
  INSTANTIATE(1)
  INSTANTIATE(2)
  INSTANTIATE(3)
#undef INSTANTIATE
} // namespace unilateral
