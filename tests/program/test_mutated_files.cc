// Files changed at random, about a minute of them; slow_mutated_files.cc has thousands.
#include "mutated_files.h"

using mutation::MutatedFiles;

TEST_F(MutatedFiles, meshes_end_in_an_orderly_way)
{
  expect_orderly_ends(mutation::meshes(), 45, 1);
}

TEST_F(MutatedFiles, rasters_end_in_an_orderly_way)
{
  expect_orderly_ends(mutation::rasters(), 27, 2);
}

TEST_F(MutatedFiles, profiles_end_in_an_orderly_way)
{
  expect_orderly_ends(mutation::profiles(), 15, 3);
}

TEST_F(MutatedFiles, surfaces_end_in_an_orderly_way)
{
  expect_orderly_ends(mutation::surfaces(), 20, 4);
}

TEST_F(MutatedFiles, cases_end_in_an_orderly_way)
{
  expect_orderly_ends(mutation::cases(), 30, 5);
}
