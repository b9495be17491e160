// Sixty random problems of every kind against a dense solver; slow_random_problems.cc has a thousand others.
#include "random_problems.h"

using namespace unilateral;

TEST(RandomProblems, sixty_are_proved_or_refused)
{
  expect_right_answers(0, 60);
}

/// Strong convection, gauss(2): C_h = 0, and the active sets of Newton's method repeat until the penalty is softer.
TEST(RandomProblems, where_active_sets_repeat)
{
  expect_right_answers(1990, 1991);
}
