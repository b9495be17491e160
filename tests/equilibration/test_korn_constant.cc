// Korn's constant of single cells is above the quotients of all polynomials of a degree.
#include "unilateral/algebra/dense_solvers.h"
#include "unilateral/equilibration/korn_constant.h"
#include "unilateral/equilibration/orthonormal_polynomials.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

using namespace unilateral;
using dealii::Point;

namespace
{
  /// The largest ||w|| / ||eps(w)|| among polynomials that are orthogonal to the rigid body modes.
  double largest_quotient(const std::vector<Point<2>> &ring)
  {
    std::vector<Point<2>> points;
    std::vector<double>   weights;
    for (std::size_t k = 1; k + 1 < ring.size(); ++k)
    {
      const auto rule = simplex_rule<2>({ring[0], ring[k], ring[k + 1]}, 12);
      points.insert(points.end(), rule.get_points().begin(), rule.get_points().end());
      weights.insert(weights.end(), rule.get_weights().begin(), rule.get_weights().end());
    }
    const OrthonormalPolynomials<2> basis(dealii::Quadrature<2>(points, weights), 5);
    const auto                      gradients = basis.gradients_at(points);
    const unsigned                  n = basis.size();
    Eigen::MatrixXd                 strain = Eigen::MatrixXd::Zero(3 * points.size(), 2 * n);
    for (std::size_t q = 0; q < points.size(); ++q)
      for (unsigned i = 0; i < n; ++i)
      {
        const double w = std::sqrt(weights[q]), dx = w * gradients[0](q, i), dy = w * gradients[1](q, i);
        strain(3 * q, i) = dx;
        strain(3 * q + 1, n + i) = dy;
        strain(3 * q + 2, i) = dy / std::sqrt(2);
        strain(3 * q + 2, n + i) = dx / std::sqrt(2);
      }
    const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> eigen(strain.transpose() * strain);
    EXPECT_LT(eigen.eigenvalues()(2), 1e-10); // three rigid body modes
    return 1 / std::sqrt(eigen.eigenvalues()(3));
  }
} // namespace

TEST(KornConstant, is_above_those_of_polynomials)
{
  const std::vector<std::vector<Point<2>>> cells = {{{0, 0}, {1, 0}, {1, 1}, {0, 1}},
                                                    {{0, 0}, {1, 0}, {0, 1}},
                                                    {{0, 0}, {4, 0}, {4, 1}, {0, 1}},
                                                    {{0, 0}, {3, 0.1}, {0.2, 0.4}},
                                                    {{0, 0}, {1, 0.1}, {0.8, 1.2}, {-0.2, 0.9}}};
  for (const auto &ring : cells)
  {
    const double bound = korn_constant(ring).of_value, quotient = largest_quotient(ring);
    EXPECT_GE(bound, quotient);
    EXPECT_LT(bound, 40 * quotient);
  }
}

TEST(KornConstant, grows_with_the_cell)
{
  const auto small = korn_constant({{0, 0}, {1, 0}, {0, 1}}), large = korn_constant({{0, 0}, {3, 0}, {0, 3}});
  EXPECT_NEAR(large.of_value, 3 * small.of_value, 1e-12);
  EXPECT_NEAR(large.of_gradient, small.of_gradient, 1e-12);
}
