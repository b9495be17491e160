// Layers beside stiff springs on the boundary: the estimate knows of what the mesh does not resolve.
#include "solved_case.h"

#include <fmt/format.h>

#include <gtest/gtest.h>

#include <cmath>
#include <string>

using namespace unilateral;

namespace
{
  /// Springs that hold the top side at 1, but for its ends, which are held at 0. No contact.
  std::string membrane(const std::string &element, const unsigned cells)
  {
    return fmt::format("[mesh]\nbox = [[0, 0], [1, 1]]\ncells = {}\n[model]\nkind = \"membrane\"\nelement = \"{}\"\nload = -5\n"
                       "[boundary]\nall = 0\ntop = {{ spring = 1000, flux = 1000 }}\n[constraint]\nlower = -100\n",
                       cells, element);
  }

  std::string body(const std::string &element, const unsigned cells)
  {
    return fmt::format("[mesh]\nbox = [[0, 0], [1, 1]]\ncells = {}\n[model]\nkind = \"elasticity\"\nelement = \"{}\"\nyoung = 1\n"
                       "poisson = 0.3\n[boundary]\nleft = [0, 0]\nright = [0, 0]\ntop = {{ spring = 1000, traction = [0, 1000] }}\n"
                       "[constraint]\non = \"bottom\"\ngap = 100\n",
                       cells, element);
  }

  /// The estimate of the mesh's error over sqrt(2 (J(u_h) - J(u))), u from a fine mesh.
  double effectivity(const std::string &coarse, const RunResult &fine)
  {
    const RunResult result = result_of<2>(coarse);
    return result.discretisation_indicator / std::sqrt(2 * (result.energy - fine.energy));
  }
} // namespace

TEST(UnresolvedSprings, LayersThatNoCellResolvesAreEstimated)
{
  const RunResult membrane_fine = result_of<2>(membrane("P3", 96)), body_fine = result_of<2>(body("P3", 48));
  for (const std::string element : {"Q1", "P1", "P2"})
    for (const unsigned cells : {4u, 8u, 16u})
    {
      SCOPED_TRACE(element + ", " + std::to_string(cells));
      const double of_membrane = effectivity(membrane(element, cells), membrane_fine),
                   of_body = effectivity(body(element, cells), body_fine);
      EXPECT_GT(of_membrane, 0.8);
      EXPECT_LT(of_membrane, 1.5);
      EXPECT_GT(of_body, 0.7);
      EXPECT_LT(of_body, 1.8);
    }
}

TEST(UnresolvedSprings, SpringsThatHoldWhatTheyShouldAddNothing)
{
  // u = x is exact: k u' + s u = 1 + s at x = 1.
  for (const double s : {1., 1e3, 1e8})
  {
    const auto result = result_of<1>(fmt::format("[mesh]\nbox = [[0], [1]]\ncells = 4\n[model]\nkind = \"membrane\"\n[boundary]\nleft = 0\n"
                                                 "right = {{ spring = {0}, flux = {1} }}\n[constraint]\nlower = -1\n",
                                                 s, 1 + s));
    EXPECT_LT(result.discretisation_indicator, 1e-6) << s;
  }
}
