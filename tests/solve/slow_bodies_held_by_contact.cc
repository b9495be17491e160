// Five hundred random bodies that supports hold in part or not at all.
#include "random_bodies.h"

using namespace unilateral;

TEST(BodiesHeldByContact, five_hundred_random_ones_are_proved_or_refused)
{
  expect_proved_solutions(1000, 1500);
}
