// In which steps many processes divide a mesh.
#include "unilateral/base/division_steps.h"

#include "unilateral/base/processes.h"

#include <gtest/gtest.h>

#include <functional>
#include <numeric>

using namespace unilateral;

TEST(DivisionSteps, are_factors_of_the_number_of_processes)
{
  for (unsigned n = 1; n <= 400; ++n)
  {
    const auto steps = division_steps(n, 16);
    EXPECT_EQ(std::accumulate(steps.begin(), steps.end(), 1u, std::multiplies<>()), n);
    if (n <= 16)
    {
      EXPECT_EQ(steps.size(), 1u);
    }
    EXPECT_TRUE(std::is_sorted(steps.rbegin(), steps.rend())) << n;
  }
}

TEST(DivisionSteps, are_few_and_of_nearly_equal_size)
{
  using Steps = std::vector<unsigned>;
  EXPECT_EQ(division_steps(64, 16), (Steps{8, 8}));
  EXPECT_EQ(division_steps(96, 16), (Steps{12, 8}));
  EXPECT_EQ(division_steps(4096, 16), (Steps{16, 16, 16}));
  EXPECT_EQ(division_steps(65536, 16), (Steps{16, 16, 16, 16}));
  EXPECT_EQ(division_steps(100000, 16), (Steps{10, 10, 10, 10, 10}));
}

TEST(DivisionSteps, are_as_small_as_prime_factors_allow)
{
  using Steps = std::vector<unsigned>;
  EXPECT_EQ(division_steps(127, 16), (Steps{127}));
  EXPECT_EQ(division_steps(254, 16), (Steps{127, 2}));
}

TEST(DivisionSteps, are_taken_as_cells_become_enough)
{
  const auto         steps = division_steps(4096, 16);
  const unsigned     n = 4096;
  const DivisionStep none = next_division(steps, n, n, 15000, 1000), first = next_division(steps, n, n, 16000, 1000);
  EXPECT_EQ(none.n_parts, 1u);
  EXPECT_EQ(none.n_alike, n);
  EXPECT_EQ(first.n_parts, 16u);
  EXPECT_EQ(first.n_alike, 256u);
  EXPECT_EQ(next_division(steps, n, 256, 255000, 1000).n_parts, 1u);
  EXPECT_EQ(next_division(steps, n, 256, 256000, 1000).n_parts, 16u);
  EXPECT_EQ(next_division(steps, n, 256, 256000, 1000).n_alike, 16u);
  // Two steps at once, where a refinement has made enough cells for both.
  EXPECT_EQ(next_division(steps, n, 256, 4.1e6, 1000).n_parts, 256u);
  EXPECT_EQ(next_division(steps, n, 256, 4.1e6, 1000).n_alike, 1u);
}

TEST(Processes, form_groups)
{
  const Processes seventh(7, 24), block = seventh.block(6), every = seventh.every(6), of_block = block.every(2);
  EXPECT_EQ(block.size(), 6u);
  EXPECT_EQ(block.rank(), 1u);
  EXPECT_EQ(every.size(), 4u); // 1, 7, 13, 19
  EXPECT_EQ(every.rank(), 1u);
  EXPECT_EQ(of_block.size(), 3u); // 7, 9, 11
  EXPECT_EQ(of_block.rank(), 0u);
  EXPECT_TRUE(seventh.block(1).alone());
  EXPECT_EQ(seventh.every(1).rank(), 7u);
}
