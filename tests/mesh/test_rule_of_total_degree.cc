#include "unilateral/mesh/rule_of_total_degree.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

using namespace unilateral;

namespace
{
  /// Of x^i y^j z^k over the unit cube.
  double error_of_monomial(const dealii::Quadrature<3> &rule, const unsigned i, const unsigned j, const unsigned k)
  {
    double sum = 0;
    for (unsigned q = 0; q < rule.size(); ++q)
      sum += rule.weight(q) * std::pow(rule.point(q)[0], i) * std::pow(rule.point(q)[1], j) * std::pow(rule.point(q)[2], k);
    return std::abs(sum - 1. / ((i + 1) * (j + 1) * (k + 1)));
  }

  double largest_error_of_degree(const dealii::Quadrature<3> &rule, const unsigned degree)
  {
    double largest = 0;
    for (unsigned i = 0; i <= degree; ++i)
      for (unsigned j = 0; i + j <= degree; ++j)
        largest = std::max(largest, error_of_monomial(rule, i, j, degree - i - j));
    return largest;
  }
} // namespace

TEST(RuleOfTotalDegree, IntegratesPolynomialsOnHexahedra)
{
  for (const unsigned n : {1u, 2u, 3u, 4u, 5u})
  {
    const auto rule = rule_of_total_degree<3>(false, n);
    for (unsigned degree = 0; degree <= 2 * n - 1; ++degree)
      EXPECT_LT(largest_error_of_degree(rule, degree), 1e-14) << "n = " << n << ", degree " << degree;
    EXPECT_GT(largest_error_of_degree(rule, 2 * n), 1e-6) << "n = " << n;
  }
}

TEST(RuleOfTotalDegree, HasPositiveWeightsAtFewPointsInside)
{
  const unsigned n_points[] = {14, 34};
  for (const unsigned n : {3u, 4u})
  {
    const auto rule = rule_of_total_degree<3>(false, n);
    EXPECT_EQ(rule.size(), n_points[n - 3]);
    for (unsigned q = 0; q < rule.size(); ++q)
    {
      EXPECT_GT(rule.weight(q), 0);
      for (unsigned d = 0; d < 3; ++d)
      {
        EXPECT_GT(rule.point(q)[d], 0);
        EXPECT_LT(rule.point(q)[d], 1);
      }
    }
  }
}
