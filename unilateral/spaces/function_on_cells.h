// A function of V_h and its derivatives at the points of a rule, on one cell after another.
#pragma once

#include "unilateral/mesh/congruent_cells.h"
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
  /// the gradients DF^-T G u, with V and G computed once for the rule, and DF^-T G, weights and the places of points once for all cells
  /// that are the same but for a translation. The shape functions of Hermite elements depend on the cell; they and second derivatives are
  /// computed anew on each.
  template <int dim>
  class FunctionOnCells
  {
  public:
    FunctionOnCells(const FunctionSpace<dim> &space, const dealii::Quadrature<dim> &rule, bool second_derivatives);

    void reinit(const typename dealii::DoFHandler<dim>::active_cell_iterator &cell,
                const dealii::LinearAlgebra::distributed::Vector<double>     &u);

    /// The points of the rule on the cell.
    const std::vector<dealii::Point<dim>> &points() const { return at; }

    /// Weight times det DF.
    double weight(const unsigned q) const { return (*weights)[q]; }

    double                 value(const unsigned q, const unsigned component) const { return values(q, component); }
    dealii::Tensor<1, dim> gradient(const unsigned q, const unsigned component) const
    {
      dealii::Tensor<1, dim> result;
      for (unsigned d = 0; d < dim; ++d)
        result[d] = gradients(q * dim + d, component);
      return result;
    }
    /// The same for all points: points x components, (points x directions) x components.
    const Eigen::MatrixXd &values_at_points() const { return values; }
    const Eigen::MatrixXd &gradients_at_points() const { return gradients; }

    const dealii::Tensor<2, dim> &hessian(const unsigned q, const unsigned component) const { return hessians[component][q]; }

  private:
    /// What cells have in common of which each is another one, moved.
    struct Geometry
    {
      std::vector<dealii::Tensor<1, dim>> offsets; ///< of the points from the first vertex
      std::vector<double>                 weights;
      Eigen::MatrixXd                     DG; ///< DF^-T G: (points x directions) x functions
    };

    void     tabulate(const dealii::Quadrature<dim> &rule);
    Geometry geometry(const dealii::Point<dim> &first_vertex) const;
    /// That of the cell's shape; nothing where it is like no other, or there is no room: `on_cell` is at the cell then.
    template <typename Cell>
    const Geometry *geometry_of(const Cell &cell);
    void            map_gradients();
    void            sum_shape_functions();

    static constexpr std::size_t most_bytes = 32 << 20; ///< of matrices DG

    const FunctionSpace<dim>                        &space;
    const bool                                       tabulated; ///< V and G serve
    std::unique_ptr<dealii::FiniteElement<dim>>      element;   ///< that of one component; none where V and G serve
    Eigen::MatrixXd                                  V;         ///< points x functions
    Eigen::MatrixXd                                  G;         ///< (points x directions of the reference cell) x functions
    dealii::FEValues<dim>                            on_cell;
    CellShapes<dim>                                  shapes;
    std::vector<Geometry>                            known; ///< by shape
    std::vector<dealii::types::global_dof_index>     dofs;
    std::vector<dealii::Point<dim>>                  at;
    const std::vector<double>                       *weights = nullptr;
    Eigen::MatrixXd                                  u_on_cell; ///< functions x components
    Eigen::MatrixXd                                  slopes;    ///< G u
    Eigen::MatrixXd                                  values;    ///< points x components
    Eigen::MatrixXd                                  gradients; ///< (points x directions) x components
    std::vector<std::vector<dealii::Tensor<2, dim>>> hessians;  ///< components x points
  };
} // namespace unilateral
