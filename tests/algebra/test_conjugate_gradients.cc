// Conjugate gradients: the residual that they report, also under a preconditioner that hardly sees a mode.
#include "unilateral/algebra/conjugate_gradients.h"

#include <gtest/gtest.h>

#include <cmath>

using namespace unilateral;

TEST(ConjugateGradients, a_mode_that_the_preconditioner_hardly_sees_counts)
{
  // T = 1 but for one soft mode, P = 1: r'P^-1 r of an error in the soft mode is 1e-4 of its energy.
  constexpr unsigned n = 50;
  Vector             diagonal(n), exact(n), rhs(n), x(n);
  for (unsigned i = 0; i < n; ++i)
  {
    diagonal(i) = i == 7 ? 1e-4 : 1 + 0.5 * std::sin(i);
    exact(i) = i == 7 ? 1e3 : 1;
    rhs(i) = diagonal(i) * exact(i);
  }
  const LinearMap T = [&](Vector &y, const Vector &v)
  {
    y = v;
    y.scale(diagonal);
  };
  const LinearMap     identity = [](Vector &y, const Vector &v) { y = v; };
  const ScalarProduct dot = [](const Vector &a, const Vector &b) { return a * b; };
  ConjugateGradients  method;
  for (const double tolerance : {1e-2, 1e-3, 1e-5})
  {
    x = 0.;
    const LinearSolve solve = method.solve(T, identity, rhs, dot, {tolerance, 0}, 200, x);
    ASSERT_TRUE(solve.converged);
    double error = 0;
    for (unsigned i = 0; i < n; ++i)
      error += diagonal(i) * std::pow(x(i) - exact(i), 2);
    EXPECT_LE(std::sqrt(error), 2 * tolerance);
  }
}
