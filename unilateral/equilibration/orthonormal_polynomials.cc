#include "unilateral/equilibration/orthonormal_polynomials.h"

#include "unilateral/algebra/dense_solvers.h"

#include <deal.II/base/quadrature_lib.h>

#include <algorithm>
#include <cmath>

namespace unilateral
{
  using namespace dealii;

  template <int dim>
  Quadrature<dim> simplex_rule(const std::array<Point<dim>, dim + 1> &corners, const unsigned degree)
  {
    Tensor<2, dim> edges;
    for (unsigned k = 0; k < dim; ++k)
      for (unsigned i = 0; i < dim; ++i)
        edges[i][k] = corners[k + 1][i] - corners[0][i];
    const double            volume = std::abs(determinant(edges));
    std::vector<double>     weights;
    std::vector<Point<dim>> points;
    if constexpr (dim > 1)
      if (degree <= 7)
      {
        const QWitherdenVincentSimplex<dim> rule(degree / 2 + 1);
        for (unsigned q = 0; q < rule.size(); ++q)
        {
          points.push_back(corners[0] + edges * rule.point(q));
          weights.push_back(rule.weight(q) * volume);
        }
        return Quadrature<dim>(points, weights);
      }
    // The functional determinant of the collapse has degree dim - 1 in one coordinate; n points are exact for 2 n - 1.
    const QGauss<dim> rule((degree + dim + 1) / 2);
    for (unsigned q = 0; q < rule.size(); ++q)
    {
      Tensor<1, dim> s;
      double         rest = 1, w = rule.weight(q) * volume;
      for (unsigned k = 0; k < dim; ++k)
      {
        s[k] = rest * rule.point(q)[k];
        if (k > 0)
          w *= rest;
        rest -= s[k];
      }
      points.push_back(corners[0] + edges * s);
      weights.push_back(w);
    }
    return Quadrature<dim>(points, weights);
  }

  template <int dim>
  unsigned OrthonormalPolynomials<dim>::size_of(const unsigned degree)
  {
    unsigned n = 1;
    for (unsigned d = 1; d <= dim; ++d)
      n = n * (degree + d) / d;
    return n;
  }

  template <int dim>
  OrthonormalPolynomials<dim>::OrthonormalPolynomials(const Quadrature<dim> &domain, const unsigned degree)
  {
    for (unsigned total = 0; total <= degree; ++total)
    {
      std::array<unsigned, dim> e{};
      const auto                add = [&](const auto &self, const unsigned d, const unsigned left) -> void
      {
        if (d + 1 == dim)
        {
          e[d] = left;
          exponents.push_back(e);
          return;
        }
        for (unsigned k = 0; k <= left; ++k)
        {
          e[d] = left - k;
          self(self, d + 1, k);
        }
      };
      add(add, 0, total);
    }
    double volume = 0;
    for (unsigned q = 0; q < domain.size(); ++q)
    {
      volume += domain.weight(q);
      centre += domain.weight(q) * domain.point(q);
    }
    centre /= volume;
    scale = 0;
    for (const auto &x : domain.get_points())
      scale = std::max(scale, centre.distance(x));
    if (scale == 0)
      scale = 1;
    coefficients = Eigen::MatrixXd::Identity(size(), size());
    const Eigen::Map<const Eigen::VectorXd> weights(domain.get_weights().data(), domain.size());
    // The second time for what rounding has left.
    for (unsigned pass = 0; pass < 2; ++pass)
    {
      const Eigen::MatrixXd             values = monomials_at(domain.get_points(), -1) * coefficients;
      const Eigen::MatrixXd             products = values.transpose() * weights.asDiagonal() * values;
      const Eigen::LLT<Eigen::MatrixXd> factors(products);
      coefficients = factors.matrixL().solve(coefficients.transpose()).transpose();
    }
  }

  template <int dim>
  Eigen::MatrixXd OrthonormalPolynomials<dim>::monomials_at(const std::vector<Point<dim>> &points, const int derivative) const
  {
    Eigen::MatrixXd values(points.size(), size());
    for (std::size_t q = 0; q < points.size(); ++q)
      for (unsigned j = 0; j < size(); ++j)
      {
        double product = 1;
        for (int d = 0; d < dim; ++d)
        {
          const double   x = (points[q][d] - centre[d]) / scale;
          const unsigned n = exponents[j][d];
          const unsigned power = d != derivative ? n : n > 0 ? n - 1 : 0;
          if (d == derivative)
            product *= n / scale;
          for (unsigned k = 0; k < power; ++k)
            product *= x;
        }
        values(q, j) = product;
      }
    return values;
  }

  template <int dim>
  Eigen::MatrixXd OrthonormalPolynomials<dim>::values_at(const std::vector<Point<dim>> &points) const
  {
    return monomials_at(points, -1) * coefficients;
  }

  template <int dim>
  std::array<Eigen::MatrixXd, dim> OrthonormalPolynomials<dim>::gradients_at(const std::vector<Point<dim>> &points) const
  {
    std::array<Eigen::MatrixXd, dim> result;
    for (int d = 0; d < dim; ++d)
      result[d] = monomials_at(points, d) * coefficients;
    return result;
  }

#define INSTANTIATE(dim)                                                                                                                   \
  template Quadrature<dim> simplex_rule<dim>(const std::array<Point<dim>, dim + 1> &, unsigned);                                           \
  template class OrthonormalPolynomials<dim>;
  INSTANTIATE(1)
  INSTANTIATE(2)
  INSTANTIATE(3)
#undef INSTANTIATE
} // namespace unilateral
