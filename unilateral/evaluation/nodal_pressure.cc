#include "unilateral/evaluation/nodal_pressure.h"

#include <cmath>
#include <vector>

namespace unilateral
{
  using namespace dealii;

  namespace
  {
    /// Where points are the midpoints of the lines of P2, none sees a vertex: it gets the mean of the midpoints around it, or nothing where
    /// one of them has no pressure, or the vertex is fixed.
    template <int dim>
    void extend_to_vertices(const FunctionSpace<dim> &space, const Vector &weight, Vector &pressure)
    {
      const auto &fe = *space.fe;
      if (dim == 1 || space.element.family != ElementName::Family::P || space.element.degree != 2)
        return;
      const auto                          &nodes = fe.base_element(0).get_unit_support_points();
      const unsigned                       n_vertices = dim + 1;
      Vector                               sum(pressure), count(pressure);
      std::vector<bool>                    bare(pressure.size(), false); // next to a midpoint without pressure
      std::vector<types::global_dof_index> dofs(fe.n_dofs_per_cell());
      sum = 0.;
      count = 0.;
      for (const auto &cell : space.dof_handler.active_cell_iterators())
      {
        cell->get_dof_indices(dofs);
        for (unsigned c = 0; c < fe.n_components(); ++c)
          for (unsigned v = 0; v < n_vertices; ++v)
            for (unsigned m = n_vertices; m < nodes.size(); ++m)
            {
              const auto vertex = dofs[fe.component_to_system_index(c, v)], midpoint = dofs[fe.component_to_system_index(c, m)];
              if (weight(vertex) > 0 || !(weight(midpoint) > 0) || space.dirichlet.is_constrained(vertex) ||
                  fe.reference_cell().d_linear_shape_function(nodes[m], v) < 0.25)
                continue;
              sum(vertex) += pressure(midpoint);
              count(vertex) += 1;
              bare[vertex] = bare[vertex] || pressure(midpoint) == 0;
            }
      }
      for (std::size_t j = 0; j < pressure.size(); ++j)
        if (count(j) > 0 && !bare[j])
          pressure(j) = sum(j) / count(j);
    }
  } // namespace

  template <int dim>
  Vector
  nodal_pressure(const Problem<dim> &problem, const ConstraintSet<dim> &constraint_set, const ConstraintBlock &block, const Vector &lambda)
  {
    const std::size_t n_dofs = problem.space.dof_handler.n_dofs();
    Vector            pressure(n_dofs), weight(n_dofs);
    for (std::size_t i = block.begin; i < block.end; ++i)
    {
      if (!constraint_set.owns(i))
        continue;
      const auto row = constraint_set.trace[i];
      for (std::size_t k = 0; k < row.dofs.size(); ++k)
      {
        const double share = constraint_set.points[i].weight * std::abs(row.values[k]);
        pressure(row.dofs[k]) += share * lambda(i) * row.direction_of(k);
        weight(row.dofs[k]) += share;
      }
    }
    problem.space.shared().add(pressure.begin());
    problem.space.shared().add(weight.begin());
    for (std::size_t j = 0; j < n_dofs; ++j)
      if (weight(j) > 0)
        pressure(j) /= weight(j);
    extend_to_vertices(problem.space, weight, pressure);
    for (const auto &image : problem.space.couplings.periodic.images())
      for (unsigned c = 0; c < problem.form->n_components(); ++c)
        pressure(image.node.dofs[c]) = pressure(image.original.dofs[c]);
    problem.space.hanging_nodes.distribute(pressure);
    return pressure;
  }

  template Vector nodal_pressure(const Problem<1> &, const ConstraintSet<1> &, const ConstraintBlock &, const Vector &);
  template Vector nodal_pressure(const Problem<2> &, const ConstraintSet<2> &, const ConstraintBlock &, const Vector &);
  template Vector nodal_pressure(const Problem<3> &, const ConstraintSet<3> &, const ConstraintBlock &, const Vector &);
} // namespace unilateral
