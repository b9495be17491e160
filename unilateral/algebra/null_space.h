// The null space of a small symmetric matrix.
#pragma once

#include <Eigen/Core>

namespace unilateral
{
  /// An orthonormal basis of the vectors that the symmetric, positive semidefinite @p matrix takes to (nearly) nothing: the eigenvectors
  /// with eigenvalues below @p threshold, column by column.
  Eigen::MatrixXd null_space(const Eigen::MatrixXd &matrix, double threshold);
} // namespace unilateral
