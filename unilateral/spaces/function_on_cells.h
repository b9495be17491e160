// A function of V_h and its derivatives at the points of a rule, on one cell after another.
#pragma once

#include "unilateral/spaces/function_space.h"

#include <deal.II/base/quadrature.h>
#include <deal.II/base/tensor.h>
#include <deal.II/fe/fe_values.h>
#include <deal.II/lac/la_parallel_vector.h>

#include <Eigen/Core>

#include <memory>
#include <vector>

namespace unilateral
{
  /// u = sum_k u_k phi_k. Where the shape functions are those of the reference cell, composed with the mapping F, the values are V u and
  /// the gradients DF^-T G u, with V and G computed once for the rule. Those of Hermite elements depend on the cell; they and second
  /// derivatives are computed anew on each.
  template <int dim>
  class FunctionOnCells
  {
  public:
    FunctionOnCells(const FunctionSpace<dim> &space, const dealii::Quadrature<dim> &rule, bool second_derivatives);

    void reinit(const typename dealii::DoFHandler<dim>::active_cell_iterator &cell,
                const dealii::LinearAlgebra::distributed::Vector<double>     &u);

    /// The points of the rule on the cell.
    const std::vector<dealii::Point<dim>> &points() const { return on_cell.get_quadrature_points(); }

    /// Weight times det DF.
    double weight(const unsigned q) const { return on_cell.JxW(q); }

    double                        value(const unsigned q, const unsigned component) const { return values(q, component); }
    const dealii::Tensor<1, dim> &gradient(const unsigned q, const unsigned component) const { return gradients[component][q]; }
    const dealii::Tensor<2, dim> &hessian(const unsigned q, const unsigned component) const { return hessians[component][q]; }

  private:
    void tabulate(const dealii::Quadrature<dim> &rule);
    void map_gradients();
    void sum_shape_functions();

    const FunctionSpace<dim>                        &space;
    const bool                                       tabulated; ///< V and G serve
    std::unique_ptr<dealii::FiniteElement<dim>>      element;   ///< that of one component; none where V and G serve
    Eigen::MatrixXd                                  V;         ///< points x functions
    Eigen::MatrixXd                                  G;         ///< (points x directions of the reference cell) x functions
    dealii::FEValues<dim>                            on_cell;
    std::vector<dealii::types::global_dof_index>     dofs;
    Eigen::MatrixXd                                  u_on_cell; ///< functions x components
    Eigen::MatrixXd                                  values;    ///< points x components
    Eigen::MatrixXd                                  slopes;    ///< G u
    std::vector<std::vector<dealii::Tensor<1, dim>>> gradients; ///< components x points
    std::vector<std::vector<dealii::Tensor<2, dim>>> hessians;
  };
} // namespace unilateral
