// Refinement by the estimated error.
#include "small_problem.h"

#include "unilateral/adaptive_loop.h"
#include "unilateral/solve.h"

#include <gtest/gtest.h>

#include <string>

using namespace unilateral;

namespace
{
  RunResult adapted(const std::string &adapt, const std::string &element = "Q1")
  {
    // A re-entrant corner would do; here the boundary of the contact and the corners of the load.
    const std::string text = "[mesh]\nbox = [[0, 0], [1, 1]]\ncells = 4\nadapt = " + adapt +
                             "\n[model]\nkind = \"membrane\"\nelement = \"" + element +
                             "\"\nload = \"if(hypot(x - 0.3, y - 0.3) < 0.2, 50, 0)\"\n[boundary]\nall = 0\n[constraint]\nupper = 0.1\n";
    Diagnostics diagnostics;
    Progress    quiet;
    return solve<2>(problem_of(case_of(text)), diagnostics, quiet).result;
  }
} // namespace

TEST(LargestContributions, are_the_fewest_that_make_up_the_share)
{
  EXPECT_EQ(largest_contributions({1, 4, 2, 3}, 0.5), (std::vector<bool>{false, true, false, true}));
  EXPECT_EQ(largest_contributions({1, 4, 2, 3}, 0.3), (std::vector<bool>{false, true, false, false}));
  EXPECT_EQ(largest_contributions({1, 1}, 1), (std::vector<bool>{true, true}));
}

TEST(AdaptiveLoop, goes_on_until_the_tolerance_is_met)
{
  for (const char *const element : {"Q1", "Q2", "P1"})
  {
    const auto result = adapted("{ tolerance = 0.1 }", element);
    EXPECT_TRUE(result.converged);
    EXPECT_TRUE(result.estimate->guaranteed) << result.estimate->reason;
    EXPECT_TRUE(result.meets_what_is_asked());
    const auto &cycles = result.estimate->cycles;
    ASSERT_GT(cycles.size(), 1u);
    EXPECT_LE(cycles.back().relative, 0.1);
    for (std::size_t k = 0; k + 1 < cycles.size(); ++k)
    {
      EXPECT_GT(cycles[k].relative, 0.1);
      EXPECT_LT(cycles[k].n_dofs, cycles[k + 1].n_dofs);
    }
    EXPECT_EQ(cycles.back().n_dofs, result.n_dofs);
  }
}

TEST(AdaptiveLoop, keeps_to_the_unknowns_it_may_have)
{
  const auto result = adapted("{ tolerance = 1e-3, max_unknowns = 500 }");
  EXPECT_TRUE(result.converged);
  EXPECT_FALSE(result.meets_what_is_asked());
  EXPECT_FALSE(result.estimate->tolerance_met);
  EXPECT_LE(result.n_dofs, 500u);
  EXPECT_GT(result.n_dofs, 100u);
}

TEST(AdaptiveLoop, reads_what_the_case_asks_for)
{
  const auto request =
    case_of("[mesh]\nbox = [[0], [1]]\nadapt = { tolerance = 0.02, max_unknowns = 77, goal = \"energy\" }\n[model]\nkind = \"membrane\"\n"
            "[boundary]\nall = 0\n[constraint]\nupper = 1\n");
  ASSERT_TRUE(request.mesh.adapt);
  EXPECT_EQ(request.mesh.adapt->tolerance, 0.02);
  EXPECT_EQ(request.mesh.adapt->max_unknowns, 77u);
  for (const char *const wrong :
       {"{ tolerance = 0 }", "{ max_unknowns = 5 }", "{ tolerance = 0.1, goal = \"force\" }", "0.1", "{ tolerance = 0.1, x = 1 }"})
    EXPECT_THROW(adapted(wrong), InputError) << wrong;
}
