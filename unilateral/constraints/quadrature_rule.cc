#include "unilateral/constraints/quadrature_rule.h"

#include <deal.II/base/exceptions.h>
#include <deal.II/base/quadrature_lib.h>
#include <deal.II/lac/full_matrix.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>
#include <string>
#include <vector>

namespace unilateral
{
  using namespace dealii;

  namespace
  {
    /// All x = (i, j, ..) / p with i + j + .. <= p.
    template <int dim>
    std::vector<Point<dim>> simplex_lattice(unsigned p)
    {
      std::vector<Point<dim>> points;
      for (unsigned k = 0; k <= (dim > 2 ? p : 0); ++k)
        for (unsigned j = 0; j <= (dim > 1 ? p - k : 0); ++j)
          for (unsigned i = 0; i <= p - j - k; ++i)
          {
            const unsigned index[3] = {i, j, k};
            Point<dim>     x;
            for (unsigned d = 0; d < dim; ++d)
              x[d] = double(index[d]) / p;
            points.push_back(x);
          }
      return points;
    }

    /// Exponents of the monomials that span P_k (simplex) or Q_k (hypercube).
    template <int dim>
    std::vector<std::array<unsigned, dim>> monomials(unsigned k, bool simplex)
    {
      std::vector<std::array<unsigned, dim>> exponents;
      std::array<unsigned, dim>              alpha{};
      while (true)
      {
        unsigned total = 0;
        for (const unsigned a : alpha)
          total += a;
        if (!simplex || total <= k)
          exponents.push_back(alpha);
        unsigned d = 0;
        while (d < dim && alpha[d] == k)
          alpha[d++] = 0;
        if (d == dim)
          return exponents;
        ++alpha[d];
      }
    }

    template <int dim>
    double monomial(const std::array<unsigned, dim> &alpha, const Point<dim> &x)
    {
      double value = 1;
      for (unsigned d = 0; d < dim; ++d)
        value *= std::pow(x[d], alpha[d]);
      return value;
    }

    /// Integral of x^alpha over the reference cell: prod 1/(alpha_d + 1), resp. alpha! / (|alpha| + dim)! on the simplex.
    template <int dim>
    double monomial_integral(const std::array<unsigned, dim> &alpha, bool simplex)
    {
      double   log_numerator = 0, product = 1;
      unsigned total = 0;
      for (const unsigned a : alpha)
      {
        log_numerator += std::lgamma(a + 1.);
        product *= 1. / (a + 1.);
        total += a;
      }
      return simplex ? std::exp(log_numerator - std::lgamma(total + dim + 1.)) : product;
    }

    /// The weights that integrate P_k exactly at the points of the lattice of degree k: the interpolatory rule.
    template <int dim>
    Quadrature<dim> newton_cotes_on_simplex(unsigned k)
    {
      const auto             points = simplex_lattice<dim>(k);
      const auto             basis = monomials<dim>(k, true);
      const unsigned         n = points.size();
      FullMatrix<double>     vandermonde(n, n);
      dealii::Vector<double> moments(n), weights(n);
      for (unsigned i = 0; i < n; ++i)
      {
        moments(i) = monomial_integral<dim>(basis[i], true);
        for (unsigned j = 0; j < n; ++j)
          vandermonde(i, j) = monomial<dim>(basis[i], points[j]);
      }
      vandermonde.gauss_jordan();
      vandermonde.vmult(weights, moments);
      return Quadrature<dim>(points, {weights.begin(), weights.end()});
    }

    template <int dim>
    Quadrature<dim> equal_weights_on_simplex(const std::vector<Point<dim>> &points)
    {
      const double volume = monomial_integral<dim>({}, true);
      return Quadrature<dim>(points, std::vector<double>(points.size(), volume / points.size()));
    }

    template <int dim>
    Quadrature<dim> rule_on_simplex(const RuleName &rule, const ElementName &element)
    {
      using Family = RuleName::Family;
      switch (rule.family)
      {
      case Family::nodal:
        return newton_cotes_on_simplex<dim>(element.degree);
      case Family::gauss:
        if constexpr (dim == 1)
          return QGauss<1>(rule.n);
        else
          return QGaussSimplex<dim>(rule.n);
      case Family::lobatto:
        if constexpr (dim == 1)
          return QGaussLobatto<1>(rule.n);
        break;
      case Family::midpoint:
      {
        Point<dim> center;
        for (unsigned d = 0; d < dim; ++d)
          center[d] = 1. / (dim + 1);
        return equal_weights_on_simplex<dim>({center});
      }
      case Family::trapezoid:
        return equal_weights_on_simplex<dim>(simplex_lattice<dim>(1));
      case Family::simpson:
        if constexpr (dim == 1)
          return QSimpson<1>();
        break;
      case Family::edges:
      {
        // The lattice of degree 2 without the vertices.
        std::vector<Point<dim>> midpoints;
        for (const auto &x : simplex_lattice<dim>(2))
        {
          double last = 1;
          bool   half = false;
          for (unsigned d = 0; d < dim; ++d)
          {
            last -= x[d];
            half |= x[d] == 0.5;
          }
          if (half || last == 0.5)
            midpoints.push_back(x);
        }
        return equal_weights_on_simplex<dim>(midpoints);
      }
      }
      return Quadrature<dim>();
    }

    template <int dim>
    Quadrature<dim> rule_on_hypercube(const RuleName &rule, const ElementName &element)
    {
      using Family = RuleName::Family;
      switch (rule.family)
      {
      case Family::nodal:
        // The support points of FE_Q(p) are the p + 1 Gauss-Lobatto points.
        return QGaussLobatto<dim>(n_points_1d(rule, element));
      case Family::gauss:
        return QGauss<dim>(rule.n);
      case Family::lobatto:
        return QGaussLobatto<dim>(rule.n);
      case Family::midpoint:
        return QMidpoint<dim>();
      case Family::trapezoid:
        return QTrapezoid<dim>();
      case Family::simpson:
        return QSimpson<dim>();
      case Family::edges:
        break;
      }
      return Quadrature<dim>();
    }
  } // namespace

  template <int dim>
  Quadrature<dim> quadrature_rule(const RuleName &rule, const ElementName &element)
  {
    if constexpr (dim == 0)
    {
      // The end point of a segment: whatever the rule, the value there.
      return Quadrature<0>(std::vector<Point<0>>(1), std::vector<double>(1, 1.));
    }
    else
    {
      if (const std::string reason = why_rule_does_not_fit(rule, element, dim); !reason.empty())
        throw std::invalid_argument(reason);
      const Quadrature<dim> quadrature = element.simplex() ? rule_on_simplex<dim>(rule, element) : rule_on_hypercube<dim>(rule, element);
      Assert(std::all_of(quadrature.get_weights().begin(), quadrature.get_weights().end(), [](const double w) { return w > 1e-12; }),
             ExcInternalError());
      return quadrature;
    }
  }

  template <int dim>
  bool exact_pairing(const RuleName &rule, const ElementName &element)
  {
    if constexpr (dim == 0)
      return true; // one value at one point
    else
    {
      const Quadrature<dim> quadrature = quadrature_rule<dim>(rule, element);
      const unsigned        n = quadrature.size();
      const bool            simplex = element.simplex();

      // The degree k of Q_h: the full polynomial space with as many dimensions as there are points.
      unsigned k = 0;
      while (monomials<dim>(k, simplex).size() < n)
        ++k;
      const auto q_basis = monomials<dim>(k, simplex);
      if (q_basis.size() != n)
        return false;
      FullMatrix<double> vandermonde(n, n);
      for (unsigned i = 0; i < n; ++i)
        for (unsigned j = 0; j < n; ++j)
          vandermonde(i, j) = monomial<dim>(q_basis[i], quadrature.point(j));
      FullMatrix<double> inverse = vandermonde;
      try
      {
        inverse.gauss_jordan();
      }
      catch (const std::exception &)
      {
        return false; // not unisolvent at the points
      }
      if (!(inverse.frobenius_norm() < 1e8))
        return false;

      for (const auto &q : q_basis)
        for (const auto &v : monomials<dim>(element.degree, simplex))
        {
          std::array<unsigned, dim> product;
          for (unsigned d = 0; d < dim; ++d)
            product[d] = q[d] + v[d];
          double sum = 0;
          for (unsigned j = 0; j < n; ++j)
            sum += quadrature.weight(j) * monomial<dim>(product, quadrature.point(j));
          if (std::abs(sum - monomial_integral<dim>(product, simplex)) > 1e-12)
            return false;
        }
      return true;
    }
  }

  template Quadrature<0> quadrature_rule<0>(const RuleName &, const ElementName &);
  template Quadrature<1> quadrature_rule<1>(const RuleName &, const ElementName &);
  template Quadrature<2> quadrature_rule<2>(const RuleName &, const ElementName &);
  template Quadrature<3> quadrature_rule<3>(const RuleName &, const ElementName &);
  template bool          exact_pairing<0>(const RuleName &, const ElementName &);
  template bool          exact_pairing<1>(const RuleName &, const ElementName &);
  template bool          exact_pairing<2>(const RuleName &, const ElementName &);
  template bool          exact_pairing<3>(const RuleName &, const ElementName &);
} // namespace unilateral
