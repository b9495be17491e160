// Several hundred random elastic bodies: no bound is below its error.
#include "random_elastic_bodies.h"

#include <algorithm>
#include <vector>

using namespace unilateral;

TEST(BodyError, of_several_hundred_random_bodies)
{
  std::mt19937        random(1994);
  std::vector<double> effectivities;
  for (unsigned trial = 0; trial < 400; ++trial)
  {
    const std::string       element = std::vector<std::string>{"Q1", "P1", "Q2", "P2", "Q3", "P3"}[trial % 6];
    const RandomElasticBody body(random, element,
                                 trial % 12 < 6 && element[0] == 'Q' ? "[[mesh.local]]\nwhere = \"x < 0.4 && y < 0.3\"\n" : "");
    const RunResult         result = result_of_case<2>(body.text);
    ASSERT_TRUE(result.converged) << body.text;
    ASSERT_TRUE(result.estimate->guaranteed) << result.estimate->reason << "\n" << body.text;
    EXPECT_GE(*result.estimate->effectivity, 1) << body.text;
    effectivities.push_back(*result.estimate->effectivity);
  }
  std::sort(effectivities.begin(), effectivities.end());
  fmt::print("effectivity: least {}, median {}, most {}\n", effectivities.front(), effectivities[effectivities.size() / 2],
             effectivities.back());
}
