// An eigenvalue of a large symmetric pencil, with operators instead of matrices.
#pragma once

#include <Eigen/Core>

#include <functional>

namespace unilateral
{
  /// y = operator(x), x and y of the same size.
  using DenseMap = std::function<Eigen::VectorXd(const Eigen::VectorXd &x)>;

  struct Eigenpair
  {
    double          value = 0;
    Eigen::VectorXd vector; ///< of norm 1 in the inner product of the mass
  };

  /// The eigenvalue next to zero of S x = lambda D x, S symmetric and positive, D symmetric and positive definite (n x n), by Lanczos
  /// iterations (implicitly restarted) on S^-1 D to a relative residual of 1e-5. The value is right to 1e-5 at least, and far better
  /// where the eigenvalue stands alone. Only S^-1 and D are needed, as functions. Where S is singular, @p inverse must be its inverse on
  /// the complement of the kernel, and give 0 on the kernel.
  /// Throws std::runtime_error when ARPACK does not converge.
  /// Reference: R. Lehoucq, D. Sorensen, C. Yang, ARPACK Users' Guide, SIAM 1998.
  Eigenpair smallest_eigenpair(std::size_t n, const DenseMap &inverse, const DenseMap &mass);

  /// The value alone, by Lanczos iterations with full reorthogonalisation, which end when the relative residual is below 1e-5 or the value
  /// has changed by less than 1e-5 of itself in ten steps: where eigenvalues lie close together, as those of elastic bodies against an
  /// inner product do, the vector would take ten times as many. Relative accuracy 1e-4, far better where the eigenvalue stands alone; the
  /// value is not below the true one. Otherwise as smallest_eigenpair().
  double smallest_eigenvalue(std::size_t n, const DenseMap &inverse, const DenseMap &mass);
} // namespace unilateral
