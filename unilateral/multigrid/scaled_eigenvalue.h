// How far apart the diagonal of a sum of small matrices and the sum itself can be.
#pragma once

#include "unilateral/multigrid/cell_operator.h"

#include <Eigen/Cholesky>

namespace unilateral
{
  /// The largest eigenvalue of diag(M)^-1 M over symmetric matrices M: that of the sum of all M is not larger.
  class ScaledEigenvalue
  {
  public:
    /// @p entries: n^2 numbers.
    void look_at(const double *entries, unsigned n);

    double largest = 1;

  private:
    using Matrix = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
    Matrix             scaled, shifted;
    Eigen::LLT<Matrix> factors;
    Eigen::VectorXd    scale;
  };

  /// Of the matrices that make up A. Where there are very many different ones, of a sample, and a little more.
  double largest_scaled_eigenvalue(const CellOperator &op);
} // namespace unilateral
