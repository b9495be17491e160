// Polynomials on simplices and squares that are orthonormal there, and Gauss rules of any degree on simplices.
#pragma once

#include <deal.II/base/point.h>
#include <deal.II/base/quadrature.h>

#include <Eigen/Core>

#include <array>
#include <vector>

namespace unilateral
{
  /// Exact for polynomials of @p degree on the simplex with these corners. Up to degree 7 symmetric rules (F. D. Witherden, P. E.
  /// Vincent, Comput. Math. Appl. 69 (2015) 1232-1241), beyond Gauss points of a square or cube, of which one side is collapsed into a
  /// corner.
  template <int dim>
  dealii::Quadrature<dim> simplex_rule(const std::array<dealii::Point<dim>, dim + 1> &corners, unsigned degree);

  /// A basis of P_degree that is orthonormal in the L2 product of a domain. The functions are sorted by degree: the first one is constant,
  /// and the first functions span P_k for each k.
  template <int dim>
  class OrthonormalPolynomials
  {
  public:
    /// @p domain: a rule on the domain that is exact for polynomials of twice the degree.
    OrthonormalPolynomials(const dealii::Quadrature<dim> &domain, unsigned degree);

    unsigned        size() const { return exponents.size(); }
    static unsigned size_of(unsigned degree); ///< dim P_degree

    /// Rows: points; columns: functions.
    Eigen::MatrixXd                  values_at(const std::vector<dealii::Point<dim>> &points) const;
    std::array<Eigen::MatrixXd, dim> gradients_at(const std::vector<dealii::Point<dim>> &points) const;

  private:
    Eigen::MatrixXd monomials_at(const std::vector<dealii::Point<dim>> &points, int derivative) const;

    std::vector<std::array<unsigned, dim>> exponents;
    dealii::Point<dim>                     centre;
    double                                 scale = 1; ///< monomials are powers of (x - centre)/scale
    Eigen::MatrixXd                        coefficients;
  };
} // namespace unilateral
