// MINRES, and systems with a part that is far stiffer than the rest.
#include "unilateral/algebra/mixed_solver.h"

#include <gtest/gtest.h>

#include <Eigen/Dense>

#include <cmath>
#include <random>

namespace
{
  using namespace unilateral;

  /// T + C'C of small size, C'C larger by a factor, with a right-hand side.
  class StiffSystem
  {
  public:
    static constexpr unsigned n = 60, m = 15;

    explicit StiffSystem(const double stiffness) : T(n, n), C(m, n), b(n)
    {
      std::mt19937                           generator(11);
      std::uniform_real_distribution<double> number(-1, 1);
      Eigen::MatrixXd                        R(n, n);
      for (Eigen::MatrixXd *const matrix : {&R, &C})
        for (unsigned i = 0; i < matrix->rows(); ++i)
          for (unsigned j = 0; j < n; ++j)
            (*matrix)(i, j) = number(generator);
      T = Eigen::MatrixXd::Identity(n, n) + 0.1 * R * R.transpose();
      C *= std::sqrt(stiffness);
      for (unsigned i = 0; i < n; ++i)
        b(i) = number(generator);
    }

    MixedSolver solver() const
    {
      OwnSparseRows rows;
      rows.n_columns = n;
      for (unsigned i = 0; i < m; ++i)
      {
        for (unsigned j = 0; j < n; ++j)
        {
          rows.columns.push_back(j);
          rows.values.push_back(C(i, j));
        }
        rows.row_start.push_back(rows.columns.size());
      }
      Vector diagonal(n);
      for (unsigned i = 0; i < n; ++i)
        diagonal(i) = T(i, i);
      return MixedSolver(std::move(rows), diagonal);
    }

    LinearMap multiply() const
    {
      return [this](Vector &y, const Vector &x) { vector(y) = T * vector(x); };
    }

    /// By the diagonal of T.
    LinearMap precondition() const
    {
      return [this](Vector &y, const Vector &x) { vector(y) = vector(x).cwiseQuotient(T.diagonal()); };
    }

    Vector right_hand_side() const
    {
      Vector rhs(n);
      vector(rhs) = b;
      return rhs;
    }

    double energy_norm_of_error(const Vector &x) const
    {
      const Eigen::MatrixXd A = T + C.transpose() * C;
      const Eigen::VectorXd error = vector(x) - A.llt().solve(b);
      return std::sqrt(error.dot(A * error));
    }

    double energy_norm_of_solution() const { return energy_norm_of_error(Vector(n)); }

    static Eigen::Map<Eigen::VectorXd>       vector(Vector &x) { return {x.begin(), n}; }
    static Eigen::Map<const Eigen::VectorXd> vector(const Vector &x) { return {x.begin(), n}; }

    Eigen::MatrixXd T, C;
    Eigen::VectorXd b;
  };

  BlockVector of_sizes(const unsigned n, const unsigned m)
  {
    BlockVector v(2);
    v.block(0).reinit(n);
    v.block(1).reinit(m);
    v.collect_sizes();
    return v;
  }

  double product(const BlockVector &a, const BlockVector &b)
  {
    return a * b;
  }
} // namespace

TEST(Minres, solves_an_indefinite_system_in_as_many_steps_as_it_has_eigenvalues)
{
  // Eigenvalues -2, -1, 1, 3 many times each: four steps.
  BlockVector  diagonal = of_sizes(20, 12), rhs = of_sizes(20, 12), x = of_sizes(20, 12);
  const double values[] = {-2, -1, 1, 3};
  for (unsigned i = 0; i < 32; ++i)
  {
    diagonal(i) = values[i % 4];
    rhs(i) = std::sin(1. + i);
  }
  const BlockLinearMap K = [&](BlockVector &y, const BlockVector &v)
  {
    y = v;
    y.scale(diagonal);
  };
  const BlockLinearMap identity = [](BlockVector &y, const BlockVector &v) { y = v; };
  double               last = 1e9;
  const LinearSolve    solve = minres(
       K, identity, rhs, product,
       [&](const BlockVector &, const double norm)
       {
      EXPECT_LE(norm, last);
      last = norm;
      return norm < 1e-10;
    },
       10, x);
  EXPECT_TRUE(solve.converged) << solve.failure;
  EXPECT_EQ(solve.iterations, 4u);
  for (unsigned i = 0; i < 32; ++i)
    EXPECT_NEAR(diagonal(i) * x(i), rhs(i), 1e-9);
}

TEST(Minres, says_so_when_the_steps_do_not_suffice)
{
  BlockVector          rhs = of_sizes(30, 1), x = rhs;
  const BlockLinearMap K = [](BlockVector &y, const BlockVector &v)
  {
    for (unsigned i = 0; i < v.size(); ++i)
      y(i) = (i + 1.) * (i % 2 ? -1 : 1) * v(i);
  };
  const BlockLinearMap identity = [](BlockVector &y, const BlockVector &v) { y = v; };
  rhs = 1.;
  const LinearSolve solve = minres(
    K, identity, rhs, product, [](const BlockVector &, const double norm) { return norm < 1e-10; }, 5, x);
  EXPECT_FALSE(solve.converged);
  EXPECT_NE(solve.failure.find("5 steps"), std::string::npos);
}

TEST(MixedSolver, the_residual_bounds_the_error_and_the_steps_do_not_grow_with_the_stiffness)
{
  unsigned steps_when_soft = 0;
  for (const double stiffness : {1., 1e2, 1e4, 1e6})
  {
    const StiffSystem system(stiffness);
    MixedSolver       solver = system.solver();
    unsigned          steps = 0;
    for (const double relative : {1e-1, 1e-3, 1e-7})
    {
      Vector            x(StiffSystem::n);
      const LinearSolve solve = solver.solve(system.multiply(), system.precondition(), system.right_hand_side(), {0, relative}, 500, x);
      ASSERT_TRUE(solve.converged) << solve.failure;
      const double error = system.energy_norm_of_error(x), norm = system.energy_norm_of_solution();
      EXPECT_LE(error, 1.01 * solve.residual + 1e-12 * norm) << stiffness;
      EXPECT_LE(error, 1.2 * relative * norm) << stiffness;
      steps = solve.iterations;
    }
    if (stiffness == 1)
      steps_when_soft = steps;
    EXPECT_LE(steps, 2.5 * steps_when_soft) << stiffness;
  }
}

TEST(MixedSolver, goes_on_from_where_it_is)
{
  const StiffSystem system(1e4);
  MixedSolver       solver = system.solver();
  Vector            x(StiffSystem::n);
  solver.solve(system.multiply(), system.precondition(), system.right_hand_side(), {0, 1e-9}, 500, x);
  const double      error = system.energy_norm_of_error(x);
  const LinearSolve again =
    solver.solve(system.multiply(), system.precondition(), system.right_hand_side(), {1e-4 * system.energy_norm_of_solution(), 0}, 500, x);
  EXPECT_TRUE(again.converged);
  EXPECT_LE(again.iterations, 5u);
  EXPECT_LE(system.energy_norm_of_error(x), error + 1e-12);
}

TEST(MixedSolver, products_and_diagonal)
{
  const StiffSystem     system(3);
  const MixedSolver     solver = system.solver();
  const Eigen::MatrixXd CtC = system.C.transpose() * system.C;
  Vector                x = system.right_hand_side(), y(StiffSystem::n), diagonal(StiffSystem::n);
  solver.add_product(y, x);
  solver.add_to_diagonal(diagonal);
  EXPECT_LT((StiffSystem::vector(y) - CtC * system.b).norm(), 1e-12 * CtC.norm());
  EXPECT_LT((StiffSystem::vector(diagonal) - CtC.diagonal()).norm(), 1e-12 * CtC.norm());
}
