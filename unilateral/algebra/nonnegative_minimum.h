// min 1/2 x'M x - b'x over x >= 0.
#pragma once

#include <Eigen/Core>

namespace unilateral
{
  /// The minimum for a symmetric positive definite M, or, where 40 rounds do not end on it, an approximation. A round is some sweeps of
  /// projected Gauss-Seidel, and then the minimum on the entries that are positive, taken where it is one of the whole or, its negative
  /// entries set to zero, lower than what the sweeps have found. So the functional never grows. Many entries become positive at a time,
  /// where nonnegative_least_squares() takes one after the other.
  Eigen::VectorXd nonnegative_minimum(const Eigen::MatrixXd &M, const Eigen::VectorXd &b);
} // namespace unilateral
