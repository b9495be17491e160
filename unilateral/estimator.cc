#include "unilateral/estimator.h"

#include "unilateral/local_systems.h"

#include <deal.II/fe/fe_values.h>

#include <algorithm>
#include <cmath>

namespace unilateral
{
  using namespace dealii;

  namespace
  {
    /// The flux of a function of V_h at the points of a rule, cell by cell, and the values of the nodes' shape functions there.
    template <int dim>
    struct FluxOnCells
    {
      FluxOnCells(const Problem<dim> &problem, const Vector &u)
        : problem(problem), u(u), values(*problem.mapping, *problem.fe, problem.cell_quadrature(), cell_flags(*problem.form)),
          dofs(problem.fe->n_dofs_per_cell()), local_u(dofs.size())
      {
        const auto scalar = problem.node_element();
        shape.reinit(scalar->n_dofs_per_cell(), values.n_quadrature_points);
        for (unsigned i = 0; i < shape.m(); ++i)
          for (unsigned q = 0; q < shape.n(); ++q)
            shape(i, q) = scalar->shape_value(i, values.get_quadrature().point(q));
      }

      void reinit(const typename DoFHandler<dim>::active_cell_iterator &cell)
      {
        values.reinit(cell);
        cell->get_dof_indices(dofs);
        for (unsigned i = 0; i < dofs.size(); ++i)
          local_u(i) = u(dofs[i]);
        problem.form->flux(values, local_u, flux);
      }

      double weight(const unsigned q) const { return values.JxW(q) * problem.form->measure(values.quadrature_point(q)); }

      const Problem<dim>                  &problem;
      const Vector                        &u;
      FEValues<dim>                        values;
      std::vector<types::global_dof_index> dofs;
      dealii::Vector<double>               local_u;
      FullMatrix<double>                   shape; ///< nodes of a cell x points
      std::vector<Flux>                    flux;  ///< at the points
    };
  } // namespace

  template <int dim>
  RecoveredFlux<dim>::RecoveredFlux(const Problem<dim> &problem, const Vector &u) : n_regions(problem.mesh.region_names.size())
  {
    if (problem.form->n_components() == 1 &&
        (problem.element.family == ElementSpec::Family::Q || problem.element.family == ElementSpec::Family::P))
      nodes = &problem.dof_handler;
    else
    {
      own_nodes = problem.nodes();
      nodes = own_nodes.get();
    }
    values.resize(nodes->n_dofs() * n_regions);
    FluxOnCells<dim>                     on_cells(problem, u);
    const unsigned                       n = on_cells.shape.m(), n_q = on_cells.shape.n(), n_flux = problem.form->n_flux_components();
    std::vector<double>                  weights(values.size(), 0.);
    std::vector<types::global_dof_index> cell_nodes(n);
    FullMatrix<double>                   mass(n, n), inverse_mass(n, n);
    std::vector<double>                  scaled_weights(n_q), known_weights; // those that inverse_mass belongs to
    std::vector<Flux>                    moments(n);
    for (const auto &cell : problem.dof_handler.active_cell_iterators())
    {
      on_cells.reinit(cell);
      typename DoFHandler<dim>::active_cell_iterator(&*problem.mesh.triangulation, cell->level(), cell->index(), &*nodes)
        ->get_dof_indices(cell_nodes);
      // The polynomial of V_h on the cell alone that fits best.
      std::fill(moments.begin(), moments.end(), Flux{});
      double volume = 0;
      for (unsigned q = 0; q < n_q; ++q)
        volume += on_cells.values.JxW(q);
      for (unsigned q = 0; q < n_q; ++q)
      {
        scaled_weights[q] = on_cells.values.JxW(q) / volume;
        for (unsigned i = 0; i < n; ++i)
          for (unsigned c = 0; c < n_flux; ++c)
            moments[i][c] += scaled_weights[q] * on_cells.shape(i, q) * on_cells.flux[q][c];
      }
      // Affine cells all have the same mass matrix, up to their volume.
      if (known_weights.empty() || !std::equal(known_weights.begin(), known_weights.end(), scaled_weights.begin(),
                                               [](const double a, const double b) { return std::abs(a - b) <= 1e-13; }))
      {
        mass = 0.;
        for (unsigned q = 0; q < n_q; ++q)
          for (unsigned i = 0; i < n; ++i)
            for (unsigned j = 0; j < n; ++j)
              mass(i, j) += scaled_weights[q] * on_cells.shape(i, q) * on_cells.shape(j, q);
        inverse_mass.invert(mass);
        known_weights = scaled_weights;
      }
      for (unsigned i = 0; i < n; ++i)
      {
        const std::size_t place = cell_nodes[i] + nodes->n_dofs() * cell->material_id();
        weights[place] += volume;
        for (unsigned j = 0; j < n; ++j)
          for (unsigned c = 0; c < n_flux; ++c)
            values[place][c] += volume * inverse_mass(i, j) * moments[j][c];
      }
    }
    for (std::size_t k = 0; k < values.size(); ++k)
      if (weights[k] > 0)
        for (double &component : values[k])
          component /= weights[k];
    used.resize(values.size());
    std::transform(weights.begin(), weights.end(), used.begin(), [](const double w) { return w > 0; });
  }

  template <int dim>
  Flux RecoveredFlux<dim>::mean_at(const types::global_dof_index node) const
  {
    Flux     mean{};
    unsigned n = 0;
    for (unsigned region = 0; region < n_regions; ++region)
      if (const std::size_t place = node + nodes->n_dofs() * region; used[place])
      {
        ++n;
        for (std::size_t c = 0; c < mean.size(); ++c)
          mean[c] += values[place][c];
      }
    for (double &component : mean)
      component /= std::max(n, 1u);
    return mean;
  }

  template <int dim>
  double discretisation_indicator(const Problem<dim> &problem, const Vector &homogeneous_u)
  {
    Vector u(homogeneous_u);
    problem.dirichlet.distribute(u);
    const RecoveredFlux<dim>             recovered(problem, u);
    FluxOnCells<dim>                     on_cells(problem, u);
    const unsigned                       n_flux = problem.form->n_flux_components();
    std::vector<types::global_dof_index> cell_nodes(on_cells.shape.m());
    double                               eta = 0;
    for (const auto &cell : problem.dof_handler.active_cell_iterators())
    {
      on_cells.reinit(cell);
      typename DoFHandler<dim>::active_cell_iterator(&*problem.mesh.triangulation, cell->level(), cell->index(), &*recovered.nodes)
        ->get_dof_indices(cell_nodes);
      for (const unsigned q : on_cells.values.quadrature_point_indices())
      {
        Flux difference{};
        for (unsigned c = 0; c < n_flux; ++c)
        {
          difference[c] = -on_cells.flux[q][c];
          for (unsigned i = 0; i < cell_nodes.size(); ++i)
            difference[c] += on_cells.shape(i, q) * recovered.at(cell_nodes[i], cell->material_id())[c];
        }
        eta += problem.form->flux_energy(difference, cell->material_id(), on_cells.values.quadrature_point(q)) * on_cells.weight(q);
      }
    }
    return std::sqrt(eta);
  }

#define INSTANTIATE(dim)                                                                                                                   \
  template class RecoveredFlux<dim>;                                                                                                       \
  template double discretisation_indicator(const Problem<dim> &, const Vector &);
  INSTANTIATE(1)
  INSTANTIATE(2)
  INSTANTIATE(3)
#undef INSTANTIATE
} // namespace unilateral
