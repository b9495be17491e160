// Whether a mesh can fit, asked before it is made.
#include "small_problem.h"

#include "unilateral/case/problem_of_case.h"
#include "unilateral/discretisation/memory_estimate.h"
#include "unilateral/solve.h"

#include <gtest/gtest.h>

#include <sys/resource.h>

using namespace unilateral;

namespace
{
  std::string square(const std::string &mesh, const std::string &element = "Q1")
  {
    return "[mesh]\n" + mesh + "\n[model]\nkind = \"membrane\"\nload = 1\nelement = \"" + element + "\"\n[boundary]\nall = 0\n";
  }

  FinestLevel finest(const std::string &text)
  {
    const Case request = case_of(text);
    return finest_level(problem_of(request), request.dimension, known_coarse_cells(problem_of(request), request.dimension));
  }
} // namespace

TEST(MemoryNeed, counts_cells_and_unknowns)
{
  const FinestLevel squares = finest(square("box = [[0, 0], [1, 1]]\ncells = [3, 4]\nrefine = 2", "Q3"));
  EXPECT_EQ(squares.n_cells, 192);
  EXPECT_EQ(squares.n_dofs, 192 * 9);
  EXPECT_EQ(finest(square("box = [[0, 0], [1, 1]]\ncells = 4\nrefine = 1", "P1")).n_cells, 128);
  EXPECT_EQ(finest(square("box = [[0, 0, 0], [1, 1, 1]]\ncells = 2\nrefine = 1", "P1")).n_cells, 320);
  EXPECT_EQ(finest(square("box = [[0], [1]]\ncells = 8", "P2")).n_dofs, 16);
}

TEST(MemoryNeed, stays_below_what_a_run_takes)
{
  rusage before = {}, after = {};
  getrusage(RUSAGE_SELF, &before);
  const std::string text = square("box = [[0, 0], [1, 1]]\ncells = 150") + "[method]\nsolver = \"amg\"\n";
  Diagnostics       diagnostics;
  Progress          silent;
  EXPECT_TRUE(solve<2>(problem_of(case_of(text)), diagnostics, silent).result.converged);
  getrusage(RUSAGE_SELF, &after);
  EXPECT_LT(finest(text).bytes, 1024. * (after.ru_maxrss - before.ru_maxrss));
}

TEST(MemoryNeed, refuses_at_the_number_that_is_to_blame)
{
  const auto where = [](const std::string &text, const double available)
  {
    const Case request = case_of(text);
    try
    {
      check_memory(problem_of(request), request.dimension, known_coarse_cells(problem_of(request), request.dimension), available);
    }
    catch (const InputError &e)
    {
      return e.diagnostics.at(0).where.line;
    }
    return 0u;
  };
  const std::string coarse = square("box = [[0, 0], [1, 1]]\ncells = 1000"),
                    fine = square("box = [[0, 0], [1, 1]]\ncells = 10\nrefine = 7");
  EXPECT_EQ(where(coarse, 1e8), 3u);
  EXPECT_EQ(where(fine, 1e8), 4u);
  EXPECT_EQ(where(square("ball = { center = [0, 0] }\nrefine = 11"), 1e8), 3u);
  EXPECT_EQ(where(coarse, 1e10), 0u);
  EXPECT_EQ(where(fine, 1e10), 0u);
  EXPECT_GT(available_memory().value_or(1e9), 1e7);
}
