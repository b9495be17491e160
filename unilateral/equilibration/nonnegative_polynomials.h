// Polynomials on a face that are nowhere negative.
#pragma once

#include "unilateral/equilibration/orthonormal_polynomials.h"

#include <Eigen/Core>

namespace unilateral
{
  /// Makes polynomials on reference faces non-negative without changing their means: those with non-negative coefficients in Bernstein's
  /// basis stay; others are replaced by their linear part, and where that is negative in a corner, by as much of its slope as is possible.
  template <int dim>
  class NonnegativePolynomials
  {
  public:
    /// @p basis: orthonormal on the reference segment, triangle or square (@p dim = 1, 2).
    NonnegativePolynomials(const OrthonormalPolynomials<dim> &basis, bool simplex, unsigned degree);

    /// @p coefficients of the basis. A polynomial with a negative mean becomes zero.
    void limit(Eigen::VectorXd &coefficients) const;

  private:
    double          first;        ///< the value of the first function
    Eigen::MatrixXd to_bernstein; ///< none where there is no such basis: squares, degree 2 and more
    Eigen::MatrixXd at_corners;   ///< the linear functions there
  };
} // namespace unilateral
