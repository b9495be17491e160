// Known solutions on large meshes: minutes.
#include "run_program.h"

namespace
{
  using namespace verification;
}

TEST(MembraneOverBall, a_million_unknowns)
{
  const Json &results = solve_mixed("membrane-over-ball", 7);
  EXPECT_EQ(number(results, "space/n_dofs"), 1025 * 1025);
  EXPECT_LE(most_newton_steps(results), 10u);
  EXPECT_LE(most_applications(results), 60u);
  EXPECT_NEAR(number(results, "constraint/0/total_contact_force") / 4.274195941868662, 1, 1e-4);
  EXPECT_LT(number(results, "errors/max_nodal"), 1e-5);
  // From 257 x 257 nodes on by 16 in two levels.
  const double ratio = number(solve_mixed("membrane-over-ball", 5), "errors/mean_nodal") / number(results, "errors/mean_nodal");
  EXPECT_GT(ratio, 10);
  EXPECT_LT(ratio, 24);
}

TEST(MembraneOverBall, the_example_with_a_million_unknowns)
{
  const Json &results = solve_example("membrane-over-ball", {"mesh.refine=7"});
  EXPECT_LT(number(results, "errors/H1_semi"), 1.1 * number(solve_mixed("membrane-over-ball", 7), "errors/H1_semi"));
}

TEST(MembraneOverBall, published_values_of_the_five_point_stencil)
{
  // 513 x 513 and 1025 x 1025 nodes.
  const Json &coarse = solve_mixed("membrane-over-ball", 6, "P1"), &fine = solve_mixed("membrane-over-ball", 7, "P1");
  EXPECT_NEAR(number(coarse, "errors/mean_nodal") / 2.051e-6, 1, 1e-3);
  EXPECT_NEAR(number(coarse, "errors/max_nodal") / 1.918e-5, 1, 1e-3);
  EXPECT_NEAR(number(fine, "errors/mean_nodal") / 6.266e-7, 1, 1e-3);
  EXPECT_NEAR(number(fine, "errors/max_nodal") / 6.592e-6, 1, 1e-3);
  EXPECT_LE(most_newton_steps(fine), 9u);
}
