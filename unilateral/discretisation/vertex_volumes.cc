#include "unilateral/discretisation/vertex_volumes.h"

#include <deal.II/fe/fe_values.h>

#include <algorithm>

namespace unilateral
{
  using namespace dealii;

  namespace
  {
    constexpr unsigned unset = numbers::invalid_unsigned_int;
  }

  template <int dim>
  bool VertexVolumes<dim>::any(const Problem<dim> &problem)
  {
    for (types::material_id region = 0; region < problem.space.mesh.region_names.size(); ++region)
      if (problem.form->averages_volume_in(region))
        return true;
    return false;
  }

  template <int dim>
  VertexVolumes<dim>::VertexVolumes(const Problem<dim> &problem)
    : n_vertices(problem.space.mesh.triangulation->n_vertices()), number(problem.space.mesh.region_names.size() * n_vertices, unset)
  {
    const auto                          &form = *problem.form;
    const Quadrature<dim>                rule = problem.cell_quadrature();
    FEValues<dim>                        values(*problem.space.mapping, *problem.space.fe, rule,
                                                update_values | update_gradients | update_quadrature_points | update_JxW_values);
    const unsigned                       n = problem.space.fe->n_dofs_per_cell();
    std::vector<types::global_dof_index> dofs(n);
    FullMatrix<double>                   divergence;
    for (const auto &cell : problem.space.dof_handler.active_cell_iterators())
    {
      const types::material_id region = cell->material_id();
      if (!form.averages_volume_in(region))
        continue;
      values.reinit(cell);
      form.volume_changes(values, divergence);
      cell->get_dof_indices(dofs);
      for (const unsigned corner : cell->vertex_indices())
      {
        unsigned &index = number[region * n_vertices + cell->vertex_index(corner)];
        if (index == unset)
        {
          index = all.size();
          all.emplace_back();
        }
        Patch              &patch = all[index];
        std::vector<double> change(n);
        for (const unsigned q : values.quadrature_point_indices())
        {
          const Point<dim> &x = values.quadrature_point(q);
          const double      w = values.JxW(q) * form.measure(x) * cell->reference_cell().d_linear_shape_function(rule.point(q), corner);
          patch.volume += w;
          patch.modulus += w * form.volume_modulus(region, x);
          for (unsigned i = 0; i < n; ++i)
            change[i] += w * divergence(q, i);
        }
        for (unsigned i = 0; i < n; ++i)
        {
          const auto place = std::lower_bound(patch.dofs.begin(), patch.dofs.end(), dofs[i]);
          const auto k = place - patch.dofs.begin();
          if (place == patch.dofs.end() || *place != dofs[i])
          {
            patch.dofs.insert(place, dofs[i]);
            patch.change.insert(patch.change.begin() + k, 0.);
          }
          patch.change[k] += change[i];
        }
      }
    }
  }

  template <int dim>
  FullMatrix<double> VertexVolumes<dim>::Patch::matrix() const
  {
    FullMatrix<double> result(dofs.size(), dofs.size());
    const double       factor = modulus / (volume * volume);
    for (std::size_t i = 0; i < dofs.size(); ++i)
      for (std::size_t j = 0; j < dofs.size(); ++j)
        result(i, j) = factor * change[i] * change[j];
    return result;
  }

  template <int dim>
  double VertexVolumes<dim>::Patch::stress(const unilateral::Vector &u) const
  {
    double sum = 0;
    for (std::size_t i = 0; i < dofs.size(); ++i)
      sum += change[i] * u(dofs[i]);
    return modulus * sum / (volume * volume);
  }

  template class VertexVolumes<1>;
  template class VertexVolumes<2>;
  template class VertexVolumes<3>;
} // namespace unilateral
