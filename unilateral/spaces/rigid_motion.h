// The motions of a rigid platen that the equations for its points leave possible.
#pragma once

#include <deal.II/base/point.h>
#include <deal.II/base/tensor.h>

#include <Eigen/Core>

namespace unilateral
{
  /// u(x) = t + theta x (x - x_0), with unknown t and theta: q = (t, l theta), l a length. In 2-D theta is one number, in 1-D there is
  /// none.
  template <int dim>
  class RigidMotion
  {
  public:
    static constexpr unsigned n_rotations = dim == 3 ? 3 : dim == 2 ? 1 : 0;

    /// @p reference: x_0. @p length: l, about the size of the platen, so that all entries of q have the size of displacements.
    RigidMotion(const dealii::Point<dim> &reference, double length);

    /// R: u_c(x) = row(c, x).q
    Eigen::RowVectorXd row(unsigned component, const dealii::Point<dim> &x) const;
    Eigen::RowVectorXd row(const dealii::Tensor<1, dim> &direction, const dealii::Point<dim> &x) const;
    Eigen::RowVectorXd row_of_translation(unsigned component) const;
    Eigen::RowVectorXd row_of_rotation(unsigned axis) const; ///< theta_axis = row.q

    /// Adds @p row.q = @p g. Where earlier equations decide it they stay; returns by how much this one contradicts them, 0 where it does
    /// not.
    double prescribe(const Eigen::RowVectorXd &row, double g);

    /// What is left: q = particular() + free_motions() z, the columns being orthonormal.
    Eigen::VectorXd particular() const;
    Eigen::MatrixXd free_motions() const;

  private:
    dealii::Point<dim> reference;
    double             length;
    Eigen::MatrixXd    equations; ///< orthonormal rows
    Eigen::VectorXd    values;
  };
} // namespace unilateral
