#include "unilateral/discretisation/element_systems.h"

#include "unilateral/discretisation/interior_faces.h"
#include "unilateral/discretisation/point_terms.h"
#include "unilateral/discretisation/vertex_volumes.h"
#include "unilateral/forms/adapted_face_values.h"

#include <deal.II/base/quadrature_lib.h>
#include <deal.II/dofs/dof_tools.h>
#include <deal.II/lac/dynamic_sparsity_pattern.h>

#include <memory>

namespace unilateral
{
  using namespace dealii;

  namespace
  {
    template <int dim>
    void for_each_boundary_face(
      const Problem<dim>                                                                                           &problem,
      const UpdateFlags                                                                                             flags,
      const std::function<bool(types::boundary_id)>                                                                &wanted,
      const std::function<void(const FEFaceValues<dim> &, const typename DoFHandler<dim>::active_cell_iterator &)> &visit)
    {
      bool any_part = false;
      for (types::boundary_id part = 0; part < problem.space.mesh.part_names.size(); ++part)
        any_part |= wanted(part);
      if (!any_part)
        return;
      std::vector<std::vector<FieldFunction>> functions;
      for (types::boundary_id part = 0; part < problem.space.mesh.part_names.size(); ++part)
        functions.push_back(problem.form->has_face_terms(part) ? problem.form->face_functions(part) : std::vector<FieldFunction>());
      AdaptedFaceValues<dim> values(*problem.space.mapping, *problem.space.fe, problem.face_quadrature(), flags);
      for (const auto &cell : problem.space.dof_handler.active_cell_iterators())
        for (const auto face : cell->face_indices())
          if (cell->at_boundary(face) && wanted(cell->face(face)->boundary_id()))
            visit(values.reinit(cell, face, functions[cell->face(face)->boundary_id()]), cell);
    }
  } // namespace

  template <int dim>
  CellShapes<dim> shapes_for_systems(const Problem<dim> &problem)
  {
    std::vector<bool> uniform(problem.space.mesh.region_names.size());
    for (std::size_t region = 0; region < uniform.size(); ++region)
      uniform[region] = problem.form->uniform_in(region);
    return CellShapes<dim>(*problem.space.mesh.triangulation, *problem.space.mapping, uniform);
  }

  template <int dim>
  RepeatedLoad<dim>::RepeatedLoad(const Problem<dim> &problem)
    : problem(problem), points(*problem.space.mapping, problem.space.fe->reference_cell(), problem.cell_quadrature().get_points()),
      varies(problem.space.mesh.region_names.size())
  {
    for (std::size_t region = 0; region < varies.size(); ++region)
      varies[region] = problem.form->uniform_in(region) && !problem.form->load_uniform_in(region);
  }

  template <int dim>
  void RepeatedLoad<dim>::add_shape(const FEValues<dim> &values)
  {
    auto &weighted = weighted_functions.emplace_back();
    if (!varies[values.get_cell()->material_id()])
      return;
    for (unsigned i = 0; i < values.dofs_per_cell; ++i)
      for (const unsigned q : values.quadrature_point_indices())
        weighted.push_back(values.shape_value(i, q) * values.JxW(q));
  }

  template <int dim>
  void RepeatedLoad<dim>::integrate(const typename DoFHandler<dim>::active_cell_iterator &cell,
                                    const unsigned                                        shape,
                                    dealii::Vector<double>                               &load)
  {
    const auto    &x = points.on(cell);
    const unsigned n_q = x.size(), n_components = problem.form->n_components();
    density.resize(n_components);
    for (unsigned c = 0; c < n_components; ++c)
      problem.form->load_density(c, cell->material_id(), x, density[c]);
    const double *weight = weighted_functions[shape].data();
    for (unsigned i = 0; i < load.size(); ++i)
    {
      const auto &f = density[problem.space.fe->system_to_component_index(i).first];
      double      sum = 0;
      for (unsigned q = 0; q < n_q; ++q)
        sum += f[q] * *weight++;
      load(i) = sum;
    }
  }

  namespace
  {
    /// Cells of one shape are integrated once. @p with_matrices: or the loads alone, and the matrices are empty.
    template <int dim>
    void for_each_cell_system(const Problem<dim>                             &problem,
                              const bool                                      with_matrices,
                              const Volumes                                   volumes,
                              const std::function<void(const LocalSystem &)> &visit)
    {
      const auto                          &form = *problem.form;
      const unsigned                       n = problem.space.fe->n_dofs_per_cell(), n_rows = with_matrices ? n : 0;
      FullMatrix<double>                   matrix(n_rows, n_rows);
      dealii::Vector<double>               load(n);
      std::vector<types::global_dof_index> dofs(n);
      FEValues<dim>                        values(*problem.space.mapping, *problem.space.fe, problem.cell_quadrature(), cell_flags(form));
      CellShapes<dim>                      shapes = shapes_for_systems(problem);
      struct Known
      {
        FullMatrix<double>     matrix;
        dealii::Vector<double> load;
      };
      std::vector<Known> known; // by shape
      RepeatedLoad<dim>  repeated_load(problem);
      for (const auto &cell : problem.space.dof_handler.active_cell_iterators())
      {
        cell->get_dof_indices(dofs);
        const unsigned shape = shapes(cell);
        if (shape >= known.size())
        {
          load = 0.;
          values.reinit(cell);
          matrix = 0.;
          if (!with_matrices)
            form.add_cell_load(values, load);
          else if (volumes == Volumes::apart)
            form.add_cell_terms_but_volume(values, matrix, load);
          else
            form.add_cell_terms(values, matrix, load);
          if (shape != shapes.none)
          {
            known.push_back({matrix, load});
            repeated_load.add_shape(values);
          }
        }
        else if (repeated_load.varies_in(cell->material_id()))
          repeated_load.integrate(cell, shape, known[shape].load);
        if (shape < known.size())
          visit({dofs, known[shape].matrix, known[shape].load, false});
        else
          visit({dofs, matrix, load, false});
      }
    }
  } // namespace

  template <int dim>
  void for_each_local_system(const Problem<dim> &problem, const std::function<void(const LocalSystem &)> &visit, const Volumes volumes)
  {
    for_each_cell_system(problem, /*with_matrices=*/true, volumes, visit);
    for_each_local_system_outside_cells(problem, visit, volumes);
  }

  template <int dim>
  void for_each_cell_load(const Problem<dim> &problem, const std::function<void(const LocalSystem &)> &visit)
  {
    for_each_cell_system(problem, /*with_matrices=*/false, Volumes::included, visit);
  }

  template <int dim>
  void for_each_local_system_outside_cells(const Problem<dim>                             &problem,
                                           const std::function<void(const LocalSystem &)> &visit,
                                           const Volumes                                   volumes)
  {
    const auto                          &form = *problem.form;
    const unsigned                       n = problem.space.fe->n_dofs_per_cell();
    FullMatrix<double>                   matrix(n, n);
    dealii::Vector<double>               load(n);
    std::vector<types::global_dof_index> dofs(n);

    auto face_flags = update_values | update_quadrature_points | update_JxW_values | update_normal_vectors;
    if (form.order() > 1)
      face_flags |= update_gradients | update_hessians;
    const auto wanted = [&](const types::boundary_id part) { return form.has_face_terms(part) || form.has_slope_terms(part); };
    for_each_boundary_face<dim>(problem, face_flags, wanted,
                                [&](const auto &face_values, const auto &cell)
                                {
                                  const auto part = cell->face(face_values.get_face_number())->boundary_id();
                                  cell->get_dof_indices(dofs);
                                  matrix = 0.;
                                  load = 0.;
                                  if (form.has_face_terms(part))
                                    form.add_face_terms(face_values, part, matrix, load);
                                  if (form.has_slope_terms(part))
                                    form.add_slope_terms(face_values, part, matrix, load);
                                  visit({dofs, matrix, load, true});
                                });

    if (form.has_interior_face_terms())
    {
      FullMatrix<double>     interface_matrix;
      dealii::Vector<double> no_load;
      for_each_interior_face<dim>(problem.space, problem.face_quadrature(),
                                  [&](const auto &face_values, const auto &interface_dofs)
                                  {
                                    interface_matrix.reinit(interface_dofs.size(), interface_dofs.size());
                                    no_load.reinit(interface_dofs.size());
                                    form.add_interior_face_terms(face_values, interface_matrix);
                                    visit({interface_dofs, interface_matrix, no_load, false});
                                  });
    }

    if (volumes == Volumes::included && VertexVolumes<dim>::any(problem))
    {
      AssertThrow(!problem.space.subdomain, ExcMessage("a process has parts of these matrices alone"));
      const VertexVolumes<dim> at_vertices(problem);
      dealii::Vector<double>   no_load;
      for (const auto &patch : at_vertices.patches())
      {
        no_load.reinit(patch.dofs.size());
        visit({patch.dofs, patch.matrix(), no_load, false});
      }
    }

    for (const auto &point : point_terms(problem))
      visit({point.dofs, point.matrix, point.load, true});
  }

  template <int dim>
  void
  for_each_local_gram(const Problem<dim> &problem, const Quadrature<dim> &quadrature, const std::function<void(const LocalSystem &)> &visit)
  {
    const auto                          &form = *problem.form;
    const unsigned                       n = problem.space.fe->n_dofs_per_cell();
    FullMatrix<double>                   matrix(n, n);
    const dealii::Vector<double>         no_load;
    std::vector<types::global_dof_index> dofs(n);
    FEValues<dim>                        values(*problem.space.mapping, *problem.space.fe, quadrature, cell_flags(form));
    for (const auto &cell : problem.space.dof_handler.active_cell_iterators())
    {
      cell->get_dof_indices(dofs);
      matrix = 0.;
      values.reinit(cell);
      form.add_gram_terms(values, matrix);
      visit({dofs, matrix, no_load, false});
    }
    if (!form.has_interior_face_terms())
      return;
    for_each_boundary_face<dim>(
      problem, update_gradients | update_hessians | update_normal_vectors | update_quadrature_points | update_JxW_values,
      [&](const types::boundary_id part) { return form.has_slope_terms(part); },
      [&](const auto &face_values, const auto &cell)
      {
        cell->get_dof_indices(dofs);
        matrix = 0.;
        form.add_slope_gram(face_values, cell->face(face_values.get_face_number())->boundary_id(), matrix);
        visit({dofs, matrix, no_load, true});
      });
    FullMatrix<double> interface_matrix;
    for_each_interior_face<dim>(problem.space, problem.face_quadrature(),
                                [&](const auto &face_values, const auto &interface_dofs)
                                {
                                  interface_matrix.reinit(interface_dofs.size(), interface_dofs.size());
                                  form.add_interior_face_gram(face_values, interface_matrix);
                                  visit({interface_dofs, interface_matrix, no_load, false});
                                });
  }

  template <int dim>
  void make_coupling_pattern(const Problem<dim> &problem, SparsityPattern &pattern, const Volumes volumes)
  {
    DynamicSparsityPattern dynamic(problem.space.dof_handler.n_dofs());
    if (problem.form->has_interior_face_terms())
      DoFTools::make_flux_sparsity_pattern(problem.space.dof_handler, dynamic, problem.space.dirichlet, /*keep_constrained_dofs=*/false);
    else
      DoFTools::make_sparsity_pattern(problem.space.dof_handler, dynamic, problem.space.dirichlet, /*keep_constrained_dofs=*/false);
    if (volumes == Volumes::included && VertexVolumes<dim>::any(problem))
    {
      const VertexVolumes<dim> at_vertices(problem);
      for (const auto &patch : at_vertices.patches())
        problem.space.dirichlet.add_entries_local_to_global(patch.dofs, dynamic, /*keep_constrained_entries=*/false);
    }
    pattern.copy_from(dynamic);
  }

#define INSTANTIATE(dim)                                                                                                                   \
  template class RepeatedLoad<dim>;                                                                                                        \
  template CellShapes<dim> shapes_for_systems(const Problem<dim> &);                                                                       \
  template void            for_each_local_system(const Problem<dim> &, const std::function<void(const LocalSystem &)> &, Volumes);         \
  template void            for_each_cell_load(const Problem<dim> &, const std::function<void(const LocalSystem &)> &);                     \
  template void for_each_local_system_outside_cells(const Problem<dim> &, const std::function<void(const LocalSystem &)> &, Volumes);      \
  template void for_each_local_gram(const Problem<dim> &, const Quadrature<dim> &, const std::function<void(const LocalSystem &)> &);      \
  template void make_coupling_pattern(const Problem<dim> &, SparsityPattern &, Volumes);
  INSTANTIATE(1)
  INSTANTIATE(2)
  INSTANTIATE(3)
#undef INSTANTIATE
} // namespace unilateral
