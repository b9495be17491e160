#include "unilateral/estimator.h"

#include <deal.II/fe/fe_values.h>

#include <algorithm>
#include <cmath>
#include <map>

namespace unilateral
{
  using namespace dealii;

  namespace
  {
    /// Gradients averaged at the nodes, per region.
    template <int dim>
    class RecoveredGradient
    {
    public:
      RecoveredGradient(const Problem<dim> &problem, const Vector &u)
        : n_dofs(problem.dof_handler.n_dofs()), regions(problem.mesh.region_names.size()), sum(n_dofs * regions), weight(n_dofs * regions)
      {
        const auto                          &fe = *problem.fe;
        FEValues<dim>                        values(*problem.mapping, fe, Quadrature<dim>(fe.get_unit_support_points()), update_gradients);
        std::vector<Tensor<1, dim>>          gradients(fe.n_dofs_per_cell());
        std::vector<types::global_dof_index> dofs(fe.n_dofs_per_cell());
        for (const auto &cell : problem.dof_handler.active_cell_iterators())
        {
          values.reinit(cell);
          values.get_function_gradients(u, gradients);
          cell->get_dof_indices(dofs);
          const double volume = std::pow(cell->diameter(), dim);
          for (unsigned i = 0; i < dofs.size(); ++i)
          {
            const std::size_t place = dofs[i] + n_dofs * cell->material_id();
            sum[place] += volume * gradients[i];
            weight[place] += volume;
          }
        }
      }

      Tensor<1, dim> at_node(const types::global_dof_index dof, const types::material_id region) const
      {
        const std::size_t place = dof + n_dofs * region;
        return sum[place] / weight[place];
      }

    private:
      std::size_t                 n_dofs, regions;
      std::vector<Tensor<1, dim>> sum;
      std::vector<double>         weight;
    };
  } // namespace

  template <int dim>
  double discretisation_indicator(const Problem<dim> &problem, const Vector &homogeneous_u)
  {
    Vector u(homogeneous_u);
    problem.dirichlet.distribute(u);
    const RecoveredGradient<dim>         recovered(problem, u);
    const auto                          &fe = *problem.fe;
    FEValues<dim>                        values(*problem.mapping, fe, problem.cell_quadrature(),
                                                update_values | update_gradients | update_quadrature_points | update_JxW_values);
    std::vector<Tensor<1, dim>>          gradients(values.n_quadrature_points), nodal(fe.n_dofs_per_cell());
    std::vector<types::global_dof_index> dofs(fe.n_dofs_per_cell());
    double                               eta = 0;
    for (const auto &cell : problem.dof_handler.active_cell_iterators())
    {
      values.reinit(cell);
      values.get_function_gradients(u, gradients);
      cell->get_dof_indices(dofs);
      for (unsigned i = 0; i < dofs.size(); ++i)
        nodal[i] = recovered.at_node(dofs[i], cell->material_id());
      for (const unsigned q : values.quadrature_point_indices())
      {
        Tensor<1, dim> difference = -gradients[q];
        for (unsigned i = 0; i < dofs.size(); ++i)
          difference += values.shape_value(i, q) * nodal[i];
        const auto k = problem.coefficients(cell).stiffness_tensor(values.quadrature_point(q));
        eta += (k * difference) * difference * values.JxW(q);
      }
    }
    return std::sqrt(eta);
  }

  template double discretisation_indicator(const Problem<1> &, const Vector &);
  template double discretisation_indicator(const Problem<2> &, const Vector &);
  template double discretisation_indicator(const Problem<3> &, const Vector &);
} // namespace unilateral
