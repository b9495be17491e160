// Thousands of files changed at random, and a hundred thousand texts of cases.
#include "mutated_case_text.h"
#include "mutated_files.h"

using mutation::MutatedFiles;

TEST_F(MutatedFiles, thousands_of_meshes_end_in_an_orderly_way)
{
  expect_orderly_ends(mutation::meshes(), 1000, 11);
}

TEST_F(MutatedFiles, hundreds_of_rasters_end_in_an_orderly_way)
{
  expect_orderly_ends(mutation::rasters(), 500, 12);
}

TEST_F(MutatedFiles, hundreds_of_profiles_end_in_an_orderly_way)
{
  expect_orderly_ends(mutation::profiles(), 200, 13);
}

TEST_F(MutatedFiles, hundreds_of_surfaces_end_in_an_orderly_way)
{
  expect_orderly_ends(mutation::surfaces(), 400, 14);
}

TEST_F(MutatedFiles, hundreds_of_cases_end_in_an_orderly_way)
{
  expect_orderly_ends(mutation::cases(), 500, 15);
}

TEST(MutatedCases, a_hundred_thousand_are_read_or_refused)
{
  unilateral::expect_mutations_to_be_read_or_refused(100000, 20240301);
}
