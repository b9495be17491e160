// An element at fixed points of the reference cell, and straight cells there.
#pragma once

#include <deal.II/base/point.h>
#include <deal.II/base/quadrature.h>
#include <deal.II/base/tensor.h>
#include <deal.II/fe/fe.h>
#include <deal.II/grid/tria.h>

#include <Eigen/Core>

#include <array>
#include <vector>

namespace unilateral
{
  /// The shape functions of a scalar element and the multilinear ones of the vertices; rows: points, columns: functions.
  template <int dim>
  struct TabulatedElement
  {
    TabulatedElement(const dealii::FiniteElement<dim> &fe, const dealii::Quadrature<dim> &rule);

    unsigned size() const { return points.size(); }

    std::vector<dealii::Point<dim>>  points; ///< on the reference cell
    std::vector<double>              weights;
    Eigen::MatrixXd                  values;
    std::array<Eigen::MatrixXd, dim> gradients; ///< on the reference cell
    Eigen::MatrixXd                  vertex_values;
    std::array<Eigen::MatrixXd, dim> vertex_gradients;
  };

  /// A cell with straight edges, the image of the reference cell under x = sum of vertices times their multilinear functions.
  template <int dim>
  class StraightCell
  {
  public:
    using Cell = typename dealii::Triangulation<dim>::cell_iterator;

    explicit StraightCell(const Cell &cell);

    double                    diameter() const; ///< of its convex hull
    bool                      affine() const;   ///< the Jacobian is constant
    const dealii::Point<dim> &vertex(const unsigned v) const { return vertices[v]; }

    struct AtPoints
    {
      std::vector<dealii::Point<dim>>     x;
      std::vector<dealii::Tensor<2, dim>> jacobian, inverse; ///< dx/dx^, dx^/dx
      std::vector<double>                 determinant;       ///< its size: positive
    };
    /// Throws std::domain_error where the cell is folded.
    AtPoints at(const TabulatedElement<dim> &tabulated) const;

  private:
    dealii::Tensor<2, dim> jacobian_of_affine() const;
    double                 positive_determinant(const dealii::Tensor<2, dim> &jacobian) const;

    std::vector<dealii::Point<dim>> vertices;
    bool                            simplex;
  };
} // namespace unilateral
