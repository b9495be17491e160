#include "unilateral/multigrid/dependence.h"

#include <Eigen/Core>

#include <algorithm>
#include <cstddef>

namespace unilateral
{
  DenseBlock Dependence::condense(const double *const M) const
  {
    using Matrix = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
    const std::size_t              m = masters.size(), n = C.size() / std::max<std::size_t>(m, 1);
    DenseBlock                     block{masters, std::vector<double>(m * m)};
    const Eigen::Map<const Matrix> interpolation(C.data(), n, m), on_unknowns(M, n, n);
    Eigen::Map<Matrix>(block.matrix.data(), m, m).noalias() = interpolation.transpose() * on_unknowns * interpolation;
    return block;
  }
} // namespace unilateral
