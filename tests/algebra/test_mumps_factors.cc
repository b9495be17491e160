// Factors by MUMPS of matrices of any kind; several processes are for the tests of the program.
#include "unilateral/algebra/mumps_factors.h"

#include <deal.II/lac/dynamic_sparsity_pattern.h>
#include <deal.II/lac/sparsity_pattern.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace
{
  using namespace unilateral;

  /// Tridiagonal, with @p lower and @p upper beside the diagonal.
  struct Tridiagonal
  {
    Tridiagonal(const unsigned n, const double lower, const double diagonal, const double upper)
    {
      dealii::DynamicSparsityPattern dsp(n, n);
      for (unsigned i = 0; i < n; ++i)
        for (unsigned j = i > 0 ? i - 1 : 0; j < std::min(n, i + 2); ++j)
          dsp.add(i, j);
      pattern.copy_from(dsp);
      matrix.reinit(pattern);
      set(lower, diagonal, upper);
    }
    void set(const double lower, const double diagonal, const double upper)
    {
      for (unsigned i = 0; i < matrix.m(); ++i)
      {
        matrix.set(i, i, diagonal);
        if (i > 0)
          matrix.set(i, i - 1, lower);
        if (i + 1 < matrix.m())
          matrix.set(i, i + 1, upper);
      }
    }
    dealii::SparsityPattern      pattern;
    dealii::SparseMatrix<double> matrix;
  };

  Vector wave(const unsigned n)
  {
    Vector x(n);
    for (unsigned i = 0; i < n; ++i)
      x(i) = std::sin(0.7 * i) + 0.1 * i;
    return x;
  }

  void expect_solution(MumpsFactors &factors, const dealii::SparseMatrix<double> &A)
  {
    const Vector x = wave(A.m());
    Vector       b(A.m()), y(A.m());
    A.vmult(b, x);
    factors.factorise(A);
    factors.solve(y, b);
    y -= x;
    EXPECT_LT(y.l2_norm(), 1e-11 * x.l2_norm());
  }
} // namespace

TEST(MumpsFactors, OfAPositiveDefiniteMatrixAndOneAfterIt)
{
  Tridiagonal  A(500, -1, 2.1, -1);
  MumpsFactors factors(SharedUnknowns(), 500, /*symmetric=*/true);
  expect_solution(factors, A.matrix);
  EXPECT_TRUE(factors.positive_definite());
  A.set(-1, 5, -1);
  expect_solution(factors, A.matrix);
}

TEST(MumpsFactors, OfASymmetricMatrixThatIsNotDefinite)
{
  const Tridiagonal A(300, -1, 0.3, -1);
  MumpsFactors      factors(SharedUnknowns(), 300, true);
  expect_solution(factors, A.matrix);
  EXPECT_FALSE(factors.positive_definite());
}

TEST(MumpsFactors, OfAMatrixThatIsNotSymmetric)
{
  const Tridiagonal A(300, -3, 4, -0.5);
  MumpsFactors      factors(SharedUnknowns(), 300, /*symmetric=*/false);
  expect_solution(factors, A.matrix);
}

TEST(MumpsFactors, SayThatAMatrixIsSingular)
{
  Tridiagonal A(10, 0, 1, 0);
  A.matrix.set(4, 4, 0.);
  MumpsFactors factors(SharedUnknowns(), 10, true);
  EXPECT_THROW(factors.factorise(A.matrix), std::runtime_error);
}
