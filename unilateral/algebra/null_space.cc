#include "unilateral/algebra/null_space.h"

#include "unilateral/algebra/dense_solvers.h"

namespace unilateral
{
  Eigen::MatrixXd null_space(const Eigen::MatrixXd &matrix, const double threshold)
  {
    if (matrix.rows() == 0)
      return matrix;
    const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> eigen(matrix);
    Eigen::Index                                         n = 0;
    while (n < matrix.rows() && eigen.eigenvalues()(n) < threshold)
      ++n;
    return eigen.eigenvectors().leftCols(n);
  }
} // namespace unilateral
