// Assembled systems: direct and with algebraic multigrid, symmetric and not, singular ones, what is reported.
#include "unilateral/algebra/linear_solver.h"

#include "five_point_grid.h"

#include <gtest/gtest.h>

#include <stdexcept>

namespace
{
  using namespace unilateral;
  using Grid = FivePointGrid;
  using Solver = LinearSolver::Method;

  LinearSolver::Parameters with(const Solver method, const bool symmetric = true, const unsigned max_iterations = 100)
  {
    LinearSolver::Parameters parameters;
    parameters.method = method;
    parameters.symmetric = symmetric;
    parameters.max_iterations = max_iterations;
    return parameters;
  }

  constexpr unsigned wide = 60; ///< more nodes than the coarsest level of multigrid takes as it is
} // namespace

TEST(LinearSolver, a_direct_solve_goes_as_far_as_it_can)
{
  LinearSolver solver(with(Solver::direct, false));
  std::size_t  before = 0;
  for (const double wind : {0., 0.8})
  {
    Grid grid(12, wind);
    solver.set_matrix(grid.matrix);
    grid.x = 3.; // whatever it starts from
    const LinearSolve solve = solver.solve(grid.rhs, {1, 0.5}, grid.x);
    EXPECT_TRUE(solve.converged);
    EXPECT_EQ(solve.iterations, 0u);
    EXPECT_LT(grid.error(), 1e-13);
    EXPECT_LT(solve.residual, 1e-13);
    EXPECT_EQ(solver.n_products() - before, 2u); // one to solve, one to see that it did
    before = solver.n_products();
  }
}

TEST(LinearSolver, refuses_a_singular_matrix)
{
  Grid grid(5);
  for (auto entry = grid.matrix.begin(); entry != grid.matrix.end(); ++entry)
    if (entry->row() == 7 || entry->column() == 7)
      entry->value() = 0;
  EXPECT_THROW(LinearSolver(with(Solver::direct)).set_matrix(grid.matrix), std::runtime_error);
}

TEST(LinearSolver, multigrid_reports_the_energy_of_the_error)
{
  for (const double tolerance : {1e-2, 1e-5, 1e-9})
  {
    Grid         grid(wide);
    LinearSolver solver(with(Solver::amg));
    solver.set_matrix(grid.matrix);
    const LinearSolve solve = solver.solve(grid.rhs, {tolerance, 0}, grid.x);
    ASSERT_TRUE(solve.converged);
    EXPECT_LE(solve.residual, tolerance);
    EXPECT_LE(grid.energy_error(), 2 * tolerance);
    EXPECT_LE(solve.iterations, 20u);
    EXPECT_GE(solve.iterations, 5u); // a small residual alone proves little
    EXPECT_LE(solver.n_products(), solve.iterations + 2u);
  }
}

TEST(LinearSolver, multigrid_and_gmres_solve_with_a_wind)
{
  Grid         grid(wide, 0.8);
  LinearSolver solver(with(Solver::amg, false));
  solver.set_matrix(grid.matrix);
  const LinearSolve solve = solver.solve(grid.rhs, {0, 1e-8}, grid.x);
  ASSERT_TRUE(solve.converged);
  EXPECT_LE(solve.iterations, 30u);
  EXPECT_LT(grid.error(), 1e-6);
}

TEST(LinearSolver, multigrid_gives_up_after_the_steps_it_was_granted)
{
  for (const double wind : {0., 0.8})
  {
    Grid         grid(wide, wind);
    LinearSolver solver(with(Solver::amg, wind == 0, 2));
    solver.set_matrix(grid.matrix);
    const LinearSolve solve = solver.solve(grid.rhs, {1e-12, 0}, grid.x);
    EXPECT_FALSE(solve.converged);
    EXPECT_FALSE(solve.failure.empty());
    EXPECT_LE(solve.iterations, 2u);
    EXPECT_GT(solve.residual, 1e-12);
  }
}

TEST(LinearSolver, knows_two_unknowns_a_node_by_their_modes)
{
  Grid grid(wide, 0, 2);
  auto parameters = with(Solver::amg);
  parameters.near_null_space = {Vector(grid.x.size()), Vector(grid.x.size())};
  parameters.block_size = 2;
  for (unsigned i = 0; i < grid.x.size(); ++i)
    parameters.near_null_space[i % 2](i) = 1;
  LinearSolver solver(parameters);
  solver.set_matrix(grid.matrix);
  const LinearSolve solve = solver.solve(grid.rhs, {1e-8, 0}, grid.x);
  ASSERT_TRUE(solve.converged);
  EXPECT_LE(solve.iterations, 20u);
  EXPECT_LE(grid.energy_error(), 2e-8);
}
