// Trilinos ML with rows that belong to processes; here one has all of them.
#include "unilateral/multigrid/distributed_amg.h"

#include "algebra/five_point_grid.h"
#include "multigrid/rows_at_unknowns.h"
#include "unilateral/algebra/conjugate_gradients.h"

#include <gtest/gtest.h>

#include <cmath>

using namespace unilateral;

namespace
{
  /// Steps of conjugate gradients for A + B'DB, B = I, with D at every third unknown.
  unsigned steps(const unsigned n, const double stiffness, const std::vector<Vector> &modes, const unsigned copies)
  {
    FivePointGrid       grid(n, 0, copies);
    const OwnSparseRows B = rows_at_unknowns(grid.exact.size());
    DistributedAmg      amg(grid.matrix, B.rows(), SharedUnknowns(), copies, modes);
    EXPECT_EQ(amg.size(), grid.exact.size());
    Vector d(grid.exact.size());
    for (std::size_t i = 0; i < d.size(); i += 3)
      d(i) = stiffness;
    amg.set_diagonal(d);
    add_penalty(grid.matrix, B.rows(), d);
    grid.matrix.vmult(grid.rhs, grid.exact);
    ConjugateGradients solver;
    const auto               result =
      solver.solve([&](Vector &Tx, const Vector &x) { grid.matrix.vmult(Tx, x); }, [&](Vector &z, const Vector &r) { amg.vmult(z, r); },
                   grid.rhs, [](const Vector &a, const Vector &b) { return a * b; }, SolveTolerance{.absolute = 0, .relative = 1e-10}, 200, grid.x);
    EXPECT_TRUE(result.converged);
    EXPECT_LT(grid.error(), 1e-7);
    return result.iterations;
  }
} // namespace

TEST(DistributedAmg, takes_steps_that_hardly_grow_with_the_grid)
{
  const unsigned coarse = steps(40, 0, {}, 1), fine = steps(120, 0, {}, 1);
  EXPECT_LE(fine, coarse + 8);
}

TEST(DistributedAmg, follows_the_penalty)
{
  EXPECT_LE(steps(60, 1e6, {}, 1), 30u);
}

TEST(DistributedAmg, knows_the_unknowns_of_a_node_and_their_modes)
{
  const unsigned      n = 60;
  std::vector<Vector> modes(2, Vector(n * n * 2));
  for (unsigned i = 0; i < n * n * 2; ++i)
    modes[i % 2](i) = 1;
  EXPECT_LE(steps(n, 0, modes, 2), steps(n, 0, {}, 1) + 2);
}
