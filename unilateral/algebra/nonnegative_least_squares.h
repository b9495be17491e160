// min |A x - b| over x >= 0.
#pragma once

#include <Eigen/Core>

namespace unilateral
{
  /// The active-set method of Lawson and Hanson for a matrix with few rows (k) and any number of columns (n). At the solution the residual
  /// r = b - A x satisfies A'r <= 0 and r.b = |r|^2: where b lies outside the cone of the columns, r separates the two (Farkas).
  /// Reference: C. L. Lawson, R. J. Hanson, Solving Least Squares Problems, Prentice-Hall 1974, chapter 23.
  Eigen::VectorXd nonnegative_least_squares(const Eigen::MatrixXd &A, const Eigen::VectorXd &b);
} // namespace unilateral
