#include "unilateral/multigrid/scaled_eigenvalue.h"
#include "unilateral/algebra/dense_solvers.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace unilateral
{
  void ScaledEigenvalue::look_at(const double *const entries, const unsigned n)
  {
    scale.resize(n);
    scaled = Eigen::Map<const Matrix>(entries, n, n);
    for (unsigned i = 0; i < n; ++i)
      scale(i) = scaled(i, i) > 0 ? 1 / std::sqrt(scaled(i, i)) : 0;
    scaled = scale.asDiagonal() * scaled * scale.asDiagonal();
    // Eigenvalues are dear, and never larger than a row sum. A Cholesky factorisation says for a tenth of the price whether one is above
    // the largest so far, which the matrices of cells of one shape have in common.
    if (scaled.cwiseAbs().rowwise().sum().maxCoeff() <= largest)
      return;
    shifted = -scaled;
    shifted.diagonal().array() += (1 + 1e-6) * largest;
    factors.compute(shifted);
    if (factors.info() != Eigen::Success)
      largest = std::max(largest, Eigen::SelfAdjointEigenSolver<Matrix>(scaled, Eigen::EigenvaluesOnly).eigenvalues()(n - 1));
  }

  double largest_scaled_eigenvalue(const CellOperator &op)
  {
    ScaledEigenvalue    eigenvalue;
    const unsigned      n = op.n_cell_dofs();
    std::vector<double> matrix(n * n);
    const auto          cells = op.representative_cells(2000);
    for (const auto cell : cells)
    {
      if (op.dependent(cell))
        continue; // among the blocks
      op.cell_matrix(cell, matrix.data());
      eigenvalue.look_at(matrix.data(), n);
    }
    const std::size_t stride = op.further_blocks().size() / 500 + 1;
    for (std::size_t k = 0; k < op.further_blocks().size(); k += stride)
      eigenvalue.look_at(op.further_blocks()[k].matrix.data(), op.further_blocks()[k].dofs.size());
    // A sample may miss the largest.
    return cells.size() > 1000 || stride > 1 ? 1.1 * eigenvalue.largest : eigenvalue.largest;
  }
} // namespace unilateral
