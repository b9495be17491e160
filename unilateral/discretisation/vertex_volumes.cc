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
    if (problem.space.subdomain)
      share(problem);
  }

  template <int dim>
  void VertexVolumes<dim>::share(const Problem<dim> &problem)
  {
    const SharedUnknowns &shared = problem.space.shared();
    const std::size_t     n_dofs = problem.space.dof_handler.n_dofs();
    std::vector<unsigned> vertex_of(n_dofs, unset); // by the first unknown there
    for (const auto &cell : problem.space.dof_handler.active_cell_iterators())
      for (const unsigned corner : cell->vertex_indices())
        vertex_of[cell->vertex_dof_index(corner, 0)] = cell->vertex_index(corner);

    std::vector<SharedUnknowns::Entry> entries;
    const auto                         shared_entries = shared.entries();
    for (types::material_id region = 0; region < problem.space.mesh.region_names.size(); ++region)
    {
      if (!problem.form->averages_volume_in(region))
        continue;
      std::vector<double> n_patches(n_dofs, 0.);
      for (const auto dof : shared.all())
        n_patches[dof] = vertex_of[dof] != unset && number[region * n_vertices + vertex_of[dof]] != unset;
      shared.add(n_patches.data());
      for (const auto &[dof, ranks] : shared_entries)
        if (n_patches[dof] > 0)
        {
          unsigned &index = number[region * n_vertices + vertex_of[dof]];
          if (index == unset)
          {
            index = all.size();
            all.emplace_back();
          }
          entries.push_back({index, ranks});
        }
    }
    shared_patches = SharedUnknowns(shared.processes(), all.size(), entries);
    std::vector<double> sums(all.size());
    for (double Patch::*const of_all : {&Patch::volume, &Patch::modulus})
    {
      std::transform(all.begin(), all.end(), sums.begin(), [&](const Patch &patch) { return patch.*of_all; });
      shared_patches.add(sums.data());
      for (std::size_t k = 0; k < all.size(); ++k)
        all[k].*of_all = sums[k];
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
  std::vector<double> VertexVolumes<dim>::tensions(const unilateral::Vector &u) const
  {
    std::vector<double> result(all.size(), 0.);
    for (std::size_t k = 0; k < all.size(); ++k)
      for (std::size_t i = 0; i < all[k].dofs.size(); ++i)
        result[k] += all[k].change[i] * u(all[k].dofs[i]);
    shared_patches.add(result.data());
    for (std::size_t k = 0; k < all.size(); ++k)
      result[k] *= all[k].modulus / (all[k].volume * all[k].volume);
    return result;
  }

  template class VertexVolumes<1>;
  template class VertexVolumes<2>;
  template class VertexVolumes<3>;
} // namespace unilateral
