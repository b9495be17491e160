#include "unilateral/stability/form_constants.h"

#include "unilateral/algebra/eigenvalues.h"

#include <Eigen/CholmodSupport>
#include <Eigen/UmfPackSupport>

#include <cmath>
#include <stdexcept>

namespace unilateral
{
  using Eigen::VectorXd;

  FormConstants form_constants(const SparseMatrixd &stiffness, const SparseMatrixd &gram, const bool symmetric)
  {
    const std::size_t n = gram.rows();
    if (n == 0)
      return {};
    const SparseMatrixd                                            transposed = stiffness.transpose();
    const SparseMatrixd                                            A = 0.5 * (stiffness + transposed);
    const Eigen::CholmodDecomposition<SparseMatrixd, Eigen::Upper> H_factors(gram);
    const Eigen::UmfPackLU<SparseMatrixd>                          A_factors(A);

    FormConstants constants;
    // A singular A (a vanishes on constants) has no factors, or factors that return no numbers.
    if (A_factors.info() == Eigen::Success)
    {
      const VectorXd ones = VectorXd::Ones(n), probe = A_factors.solve(ones);
      if (probe.allFinite() && (A * probe - ones).norm() < 1e-3 * std::sqrt(double(n)))
        constants.m = smallest_eigenvalue(
          n, [&](const VectorXd &x) -> VectorXd { return A_factors.solve(x); }, [&](const VectorXd &x) -> VectorXd { return gram * x; });
    }
    // The largest eigenvalue of (A, H) is the reciprocal of the smallest of (S, H) with S^-1 = H^-1 A H^-1; where A is not symmetric
    // A' H^-1 A takes the place of A, and its eigenvalue is M^2.
    const auto inverse_H = [&](const VectorXd &x) -> VectorXd { return H_factors.solve(x); };
    const auto gram_times = [&](const VectorXd &x) -> VectorXd { return gram * x; };
    if (symmetric)
      constants.M = 1 / smallest_eigenvalue(
                          n, [&](const VectorXd &x) -> VectorXd { return inverse_H(A * inverse_H(x)); }, gram_times);
    else
      constants.M = std::sqrt(
        1 / smallest_eigenvalue(
              n, [&](const VectorXd &x) -> VectorXd { return inverse_H(transposed * inverse_H(stiffness * inverse_H(x))); }, gram_times));
    return constants;
  }
} // namespace unilateral
