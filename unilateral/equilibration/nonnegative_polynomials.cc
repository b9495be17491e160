#include "unilateral/equilibration/nonnegative_polynomials.h"

#include "unilateral/algebra/dense_solvers.h"
#include "unilateral/equilibration/straight_face.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace unilateral
{
  using namespace dealii;

  namespace
  {
    double factorial(const unsigned n)
    {
      return n < 2 ? 1. : n * factorial(n - 1);
    }

    /// Bernstein's polynomials of a degree on the reference simplex.
    template <int dim>
    Eigen::MatrixXd bernstein(const std::vector<Point<dim>> &points, const unsigned degree)
    {
      std::vector<std::array<unsigned, dim + 1>> exponents;
      for (unsigned a = 0; a <= degree; ++a)
        for (unsigned b = 0; b <= (dim == 1 ? 0 : degree - a); ++b)
        {
          std::array<unsigned, dim + 1> e{};
          e[0] = a;
          e[dim - 1] += dim == 1 ? 0 : b;
          e[dim] = degree - a - b;
          exponents.push_back(e);
        }
      Eigen::MatrixXd values(points.size(), exponents.size());
      for (std::size_t q = 0; q < points.size(); ++q)
        for (std::size_t i = 0; i < exponents.size(); ++i)
        {
          double value = factorial(degree), rest = 1;
          for (unsigned d = 0; d < dim; ++d)
          {
            value *= std::pow(points[q][d], exponents[i][d]) / factorial(exponents[i][d]);
            rest -= points[q][d];
          }
          values(q, i) = value * std::pow(rest, exponents[i][dim]) / factorial(exponents[i][dim]);
        }
      return values;
    }
  } // namespace

  template <int dim>
  NonnegativePolynomials<dim>::NonnegativePolynomials(const OrthonormalPolynomials<dim> &basis, const bool simplex, const unsigned degree)
  {
    std::vector<Point<dim>> corners(1);
    for (unsigned d = 0; d < dim; ++d)
      corners.push_back(Point<dim>(Point<dim>::unit_vector(d)));
    if (dim == 2 && !simplex)
      corners.push_back(corners[1] + corners[2]);
    at_corners = basis.values_at(corners).leftCols(dim + 1);
    first = at_corners(0, 0);
    if (degree > 1 && (dim == 1 || simplex))
    {
      const auto                              rule = rule_on_face<dim + 1>(simplex, 2 * degree);
      const Eigen::Map<const Eigen::VectorXd> weights(rule.get_weights().data(), rule.size());
      const Eigen::MatrixXd                   products =
        basis.values_at(rule.get_points()).transpose() * weights.asDiagonal() * bernstein<dim>(rule.get_points(), degree);
      to_bernstein = products.partialPivLu().inverse();
    }
  }

  template <int dim>
  void NonnegativePolynomials<dim>::limit(Eigen::VectorXd &coefficients) const
  {
    const double mean = coefficients(0) * first;
    if (!(mean > 0))
    {
      coefficients.setZero();
      return;
    }
    if (to_bernstein.size() > 0 && (to_bernstein * coefficients).minCoeff() >= 0)
      return;
    coefficients.tail(coefficients.size() - dim - 1).setZero();
    const double least = (at_corners * coefficients.head(dim + 1)).minCoeff();
    if (least < 0)
      coefficients.segment(1, dim) *= mean / (mean - least);
  }

  template class NonnegativePolynomials<1>;
  template class NonnegativePolynomials<2>;
} // namespace unilateral
