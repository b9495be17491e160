// Sixty random problems of every kind against a dense solver; slow_random_problems.cc has a thousand others.
#include "random_problems.h"

using namespace unilateral;

TEST(RandomProblems, sixty_are_proved_or_refused)
{
  expect_right_answers(0, 60);
}
