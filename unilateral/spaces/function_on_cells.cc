#include "unilateral/spaces/function_on_cells.h"

#include <deal.II/fe/fe_nothing.h>

namespace unilateral
{
  using namespace dealii;

  namespace
  {
    const UpdateFlags of_points = update_quadrature_points | update_JxW_values;
    const UpdateFlags of_functions = update_values | update_gradients | update_hessians;
  } // namespace

  template <int dim>
  FunctionOnCells<dim>::FunctionOnCells(const FunctionSpace<dim> &space, const Quadrature<dim> &rule, const bool second_derivatives)
    : space(space), tabulated(!second_derivatives && !space.hermite()),
      element(tabulated ? std::make_unique<FE_Nothing<dim>>(space.fe->reference_cell()) : space.scalar_element()),
      on_cell(*space.mapping, *element, rule, of_points | (tabulated ? update_inverse_jacobians : of_functions)),
      shapes(*space.mesh.triangulation, *space.mapping), dofs(space.fe->n_dofs_per_cell()), at(rule.size()),
      u_on_cell(dofs.size() / space.fe->n_components(), space.fe->n_components()), values(rule.size(), u_on_cell.cols()),
      gradients(rule.size() * dim, u_on_cell.cols()), hessians(tabulated ? 0 : u_on_cell.cols(), std::vector<Tensor<2, dim>>(rule.size()))
  {
    if (tabulated)
      tabulate(rule);
  }

  template <int dim>
  void FunctionOnCells<dim>::tabulate(const Quadrature<dim> &rule)
  {
    const auto     scalar = space.scalar_element();
    const unsigned n = scalar->n_dofs_per_cell();
    V.resize(rule.size(), n);
    G.resize(rule.size() * dim, n);
    for (unsigned q = 0; q < rule.size(); ++q)
      for (unsigned k = 0; k < n; ++k)
      {
        V(q, k) = scalar->shape_value(k, rule.point(q));
        const Tensor<1, dim> slope = scalar->shape_grad(k, rule.point(q));
        for (unsigned e = 0; e < dim; ++e)
          G(q * dim + e, k) = slope[e];
      }
  }

  /// That of the cell of `on_cell`.
  template <int dim>
  typename FunctionOnCells<dim>::Geometry FunctionOnCells<dim>::geometry(const Point<dim> &first_vertex) const
  {
    Geometry result{{}, on_cell.get_JxW_values(), Eigen::MatrixXd::Zero(G.rows(), G.cols())};
    for (const unsigned q : on_cell.quadrature_point_indices())
    {
      result.offsets.push_back(on_cell.quadrature_point(q) - first_vertex);
      for (unsigned d = 0; d < dim; ++d)
        for (unsigned e = 0; e < dim; ++e)
          result.DG.row(q * dim + d) += on_cell.inverse_jacobian(q)[e][d] * G.row(q * dim + e);
    }
    return result;
  }

  template <int dim>
  template <typename Cell>
  const typename FunctionOnCells<dim>::Geometry *FunctionOnCells<dim>::geometry_of(const Cell &cell)
  {
    const unsigned shape = tabulated ? shapes(cell) : shapes.none;
    if (shape < known.size())
      return &known[shape];
    on_cell.reinit(cell);
    const std::size_t bytes = (known.size() + 1) * G.size() * sizeof(double);
    if (shape > known.size() || bytes > most_bytes)
      return nullptr;
    known.push_back(geometry(cell->vertex(0)));
    return &known.back();
  }

  template <int dim>
  void FunctionOnCells<dim>::reinit(const typename DoFHandler<dim>::active_cell_iterator &cell,
                                    const LinearAlgebra::distributed::Vector<double>     &u)
  {
    const Geometry *const geometry = geometry_of(typename Triangulation<dim>::active_cell_iterator(cell));
    const Point<dim>      first_vertex = cell->vertex(0);
    for (unsigned q = 0; q < at.size(); ++q)
      at[q] = geometry ? first_vertex + geometry->offsets[q] : on_cell.quadrature_point(q);
    weights = geometry ? &geometry->weights : &on_cell.get_JxW_values();
    cell->get_dof_indices(dofs);
    for (unsigned i = 0; i < dofs.size(); ++i)
    {
      const auto [component, function] = space.fe->system_to_component_index(i);
      u_on_cell(function, component) = u(dofs[i]);
    }
    if (!tabulated)
    {
      sum_shape_functions();
      return;
    }
    values.noalias() = V * u_on_cell;
    if (geometry)
      gradients.noalias() = geometry->DG * u_on_cell;
    else
      map_gradients();
  }

  template <int dim>
  void FunctionOnCells<dim>::map_gradients()
  {
    slopes.noalias() = G * u_on_cell;
    for (const unsigned q : on_cell.quadrature_point_indices())
    {
      const auto &inverse = on_cell.inverse_jacobian(q);
      for (unsigned c = 0; c < gradients.cols(); ++c)
        for (unsigned d = 0; d < dim; ++d)
        {
          double sum = 0;
          for (unsigned e = 0; e < dim; ++e)
            sum += inverse[e][d] * slopes(q * dim + e, c);
          gradients(q * dim + d, c) = sum;
        }
    }
  }

  template <int dim>
  void FunctionOnCells<dim>::sum_shape_functions()
  {
    values.setZero();
    gradients.setZero();
    for (const unsigned q : on_cell.quadrature_point_indices())
      for (unsigned c = 0; c < hessians.size(); ++c)
      {
        hessians[c][q] = Tensor<2, dim>();
        for (unsigned k = 0; k < u_on_cell.rows(); ++k)
        {
          values(q, c) += u_on_cell(k, c) * on_cell.shape_value(k, q);
          for (unsigned d = 0; d < dim; ++d)
            gradients(q * dim + d, c) += u_on_cell(k, c) * on_cell.shape_grad(k, q)[d];
          hessians[c][q] += u_on_cell(k, c) * on_cell.shape_hessian(k, q);
        }
      }
  }

  template class FunctionOnCells<1>;
  template class FunctionOnCells<2>;
  template class FunctionOnCells<3>;
} // namespace unilateral
