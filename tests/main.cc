// main() of every test that does not bring its own: MPI, then GoogleTest.
#include "unilateral/base/mpi_session.h"

#include <gtest/gtest.h>

int main(int argc, char **argv)
{
  const unilateral::MpiSession session;
  testing::InitGoogleTest(&argc, argv);
  return RUN_ALL_TESTS();
}
