// Bodies that only contact holds: nothing is called solved that is not in contact and in equilibrium.
#include "random_bodies.h"

using namespace unilateral;

TEST(BodiesHeldByContact, fifty_random_ones_are_proved_or_refused)
{
  expect_proved_solutions(0, 50);
}
