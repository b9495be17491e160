// Singular values of dense matrices.
#pragma once

#include <Eigen/Core>

namespace unilateral
{
  struct SingularValues
  {
    Eigen::VectorXd values;        ///< as many as the smaller side of the matrix is long, the largest first
    Eigen::MatrixXd right_vectors; ///< the right singular vectors to them, in columns
  };

  /// Of @p M, by LAPACK's divide and conquer (dgesdd). Throws std::runtime_error where that does not converge: an entry is not finite.
  SingularValues singular_values(Eigen::MatrixXd M);
} // namespace unilateral
