// GMRES: systems that are not symmetric, the residual that is reported, restarts, and when it gives up.
#include "unilateral/algebra/gmres.h"

#include <gtest/gtest.h>

#include <cmath>

namespace
{
  using namespace unilateral;

  const ScalarProduct product = [](const Vector &a, const Vector &b) { return a * b; };
  const LinearMap     identity = [](Vector &y, const Vector &x) { y = x; };

  /// Diffusion and a wind along a line: tridiagonal with -1 - wind, 2, -1 + wind.
  LinearMap convection(const double wind)
  {
    return [wind](Vector &y, const Vector &x)
    {
      for (unsigned i = 0; i < x.size(); ++i)
        y(i) = 2 * x(i) - (i > 0 ? (1 + wind) * x(i - 1) : 0.) - (i + 1 < x.size() ? (1 - wind) * x(i + 1) : 0.);
    };
  }

  struct System
  {
    explicit System(const unsigned n, LinearMap map) : T(std::move(map)), exact(n), rhs(n), x(n)
    {
      for (unsigned i = 0; i < n; ++i)
        exact(i) = std::sin(1 + 3. * i);
      T(rhs, exact);
    }

    /// |rhs - T x|.
    double residual() const
    {
      Vector r(rhs);
      T(r, x);
      r -= rhs;
      return r.l2_norm();
    }

    double error() const
    {
      Vector e(x);
      e -= exact;
      return e.linfty_norm();
    }

    LinearMap T;
    Vector    exact, rhs, x;
  };
} // namespace

TEST(Gmres, solves_with_a_wind_and_reports_the_residual)
{
  for (const double tolerance : {1e-2, 1e-6, 1e-10})
  {
    System            system(40, convection(0.7));
    const LinearSolve solve = gmres(system.T, identity, system.rhs, product, {tolerance, 0}, 100, 50, system.x);
    ASSERT_TRUE(solve.converged);
    EXPECT_LE(solve.residual, tolerance);
    EXPECT_NEAR(solve.residual, system.residual(), 1e-3 * tolerance);
    EXPECT_LT(system.error(), 100 * tolerance);
  }
}

TEST(Gmres, finds_what_conjugate_gradients_cannot)
{
  // A quarter turn: x'T x = 0 for every x, so that the first step does not help at all.
  System system(2,
                [](Vector &y, const Vector &x)
                {
                  y(0) = -x(1);
                  y(1) = x(0);
                });
  EXPECT_FALSE(gmres(system.T, identity, system.rhs, product, {1e-12, 0}, 1, 5, system.x).converged);
  EXPECT_NEAR(system.residual(), system.rhs.l2_norm(), 1e-14);
  const LinearSolve solve = gmres(system.T, identity, system.rhs, product, {1e-12, 0}, 10, 5, system.x);
  EXPECT_TRUE(solve.converged);
  EXPECT_LE(solve.iterations, 3u);
  EXPECT_LT(system.error(), 1e-12);
}

TEST(Gmres, the_residual_is_measured_as_the_preconditioner_sees_the_start)
{
  // T = 4, P^-1 = 1/4: (r'P^-1 r)^1/2 = |r|/2.
  System          system(9,
                         [](Vector &y, const Vector &x)
                         {
                  y = x;
                  y *= 4;
                });
  const LinearMap quarter = [](Vector &y, const Vector &x)
  {
    y = x;
    y *= 0.25;
  };
  const double start = system.rhs.l2_norm() / 2;
  LinearSolve  solve = gmres(system.T, quarter, system.rhs, product, {1.001 * start, 0}, 10, 5, system.x);
  EXPECT_TRUE(solve.converged);
  EXPECT_EQ(solve.iterations, 0u);
  EXPECT_NEAR(solve.residual, start, 1e-12);
  EXPECT_EQ(system.x.linfty_norm(), 0);
  solve = gmres(system.T, quarter, system.rhs, product, {0.999 * start, 0}, 10, 5, system.x);
  EXPECT_TRUE(solve.converged);
  EXPECT_LE(solve.iterations, 2u); // the inverse itself
  EXPECT_LT(system.error(), 1e-12);
}

TEST(Gmres, improves_what_x_holds)
{
  System system(30, convection(0.3));
  system.x = system.exact;
  system.x(7) += 1e-3;
  const double      start = system.residual();
  const LinearSolve solve = gmres(system.T, identity, system.rhs, product, {0, 1e-3}, 100, 50, system.x);
  ASSERT_TRUE(solve.converged);
  EXPECT_LE(system.residual(), 1.001e-3 * start);
}

TEST(Gmres, restarts_cost_steps_and_nothing_else)
{
  System            once(40, convection(0.7)), again(40, convection(0.7));
  const LinearSolve long_basis = gmres(once.T, identity, once.rhs, product, {1e-8, 0}, 500, 60, once.x),
                    short_basis = gmres(again.T, identity, again.rhs, product, {1e-8, 0}, 500, 8, again.x);
  ASSERT_TRUE(long_basis.converged && short_basis.converged);
  EXPECT_LE(long_basis.iterations, 42u); // the dimension, and a step or two more to see it
  EXPECT_GT(short_basis.iterations, long_basis.iterations);
  EXPECT_LT(again.residual(), 1.001e-8);
}

TEST(Gmres, says_so_when_the_steps_do_not_suffice)
{
  System            system(60, convection(0.1));
  const LinearSolve solve = gmres(system.T, identity, system.rhs, product, {1e-10, 0}, 7, 50, system.x);
  EXPECT_FALSE(solve.converged);
  EXPECT_EQ(solve.iterations, 7u);
  EXPECT_EQ(solve.failure, "GMRES did not converge in 7 steps");
  EXPECT_LT(system.residual(), system.rhs.l2_norm()); // x is better than nothing
}

TEST(Gmres, does_not_take_a_singular_system_for_solved)
{
#ifdef DEBUG
  GTEST_SKIP() << "deal.II's assertions stop at the numbers that are not finite";
#endif
  // Nothing is in the range of T = 0; of a nilpotent T the second entry is out of reach.
  const LinearMap nothing = [](Vector &y, const Vector &) { y = 0; }, shift = [](Vector &y, const Vector &x)
  {
    y(0) = x(1);
    y(1) = 0;
  };
  for (const LinearMap &T : {nothing, shift})
  {
    Vector rhs(2), x(2);
    rhs(0) = rhs(1) = 1;
    const LinearSolve solve = gmres(T, identity, rhs, product, {1e-8, 0}, 10, 5, x);
    EXPECT_FALSE(solve.converged);
    EXPECT_FALSE(solve.failure.empty());
  }
}
