// A thousand random problems of every kind against a dense solver.
#include "random_problems.h"

using namespace unilateral;

TEST(RandomProblems, a_thousand_are_proved_or_refused)
{
  expect_right_answers(1000, 2000);
}
