// Minima of quadratic functionals over x >= 0, by their optimality conditions.
#include "unilateral/algebra/nonnegative_minimum.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

namespace
{
  using namespace unilateral;
  using Eigen::MatrixXd;
  using Eigen::VectorXd;

  void expect_minimum(const MatrixXd &M, const VectorXd &b)
  {
    const VectorXd x = nonnegative_minimum(M, b), gradient = b - M * x;
    const double   size = b.cwiseAbs().sum();
    EXPECT_GE(x.minCoeff(), 0);
    EXPECT_LE(gradient.maxCoeff(), 1e-10 * size);
    EXPECT_LE(std::abs(x.dot(gradient)), 1e-10 * size * x.cwiseAbs().maxCoeff());
  }
} // namespace

TEST(NonnegativeMinimum, of_random_functionals_meets_the_optimality_conditions)
{
  std::mt19937                           generator(3);
  std::uniform_real_distribution<double> uniform(-1, 1);
  for (unsigned sample = 0; sample < 50; ++sample)
  {
    const unsigned n = 1 + sample;
    MatrixXd       root(n, n);
    VectorXd       b(n);
    for (unsigned i = 0; i < n; ++i)
    {
      b(i) = uniform(generator);
      for (unsigned j = 0; j < n; ++j)
        root(i, j) = uniform(generator);
    }
    SCOPED_TRACE(n);
    expect_minimum(root * root.transpose() + 0.1 * MatrixXd::Identity(n, n), b);
  }
}

TEST(NonnegativeMinimum, of_a_string_on_an_obstacle)
{
  // The inverse of the second difference: the flexibility of a string, of condition 1e4.
  const unsigned n = 150;
  MatrixXd       G(n, n);
  VectorXd       b(n);
  for (unsigned i = 0; i < n; ++i)
  {
    const double x = (i + 1.) / (n + 1);
    b(i) = 0.5 * x * (1 - x) - 0.1;
    for (unsigned j = 0; j < n; ++j)
      G(i, j) = std::min(x, (j + 1.) / (n + 1)) * (1 - std::max(x, (j + 1.) / (n + 1)));
  }
  expect_minimum(G, b);
}

TEST(NonnegativeMinimum, is_zero_where_nothing_pushes)
{
  EXPECT_EQ(nonnegative_minimum(MatrixXd::Identity(3, 3), VectorXd::Constant(3, -1.)), VectorXd::Zero(3));
  EXPECT_EQ(nonnegative_minimum(MatrixXd(0, 0), VectorXd(0)).size(), 0);
}
