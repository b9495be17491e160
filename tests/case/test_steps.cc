// [[step]] and [steps]: what they set, and what is wrong with them.
#include "unilateral/case/case_results.h"
#include "unilateral/case/load_steps.h"
#include "unilateral/case/problem_of_case.h"
#include "unilateral/case/read_case.h"
#include "unilateral/case/write_case.h"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include <algorithm>

using namespace unilateral;

namespace
{
  const std::string rest =
    "[mesh]\nbox = [[0, 0], [1, 1]]\n[model]\nkind = \"membrane\"\nload = \"f\"\n[boundary]\nall = 0\n[constraint]\nupper = 1\n";

  Case read(const std::string &text)
  {
    Diagnostics diagnostics;
    return parse_case(text, "case.toml", {}, diagnostics);
  }

  double load_in(const Case &request, const std::size_t k)
  {
    return problem_of(case_of_step(request, k)).model.coefficients.load->front().value(dealii::Point<2>(0.5, 0.5));
  }

  /// The message about @p text, a part of it expected, at @p line.
  void expect_error(const std::string &text, const std::string &message, const unsigned line)
  {
    try
    {
      read(text);
      FAIL() << text;
    }
    catch (const InputError &e)
    {
      EXPECT_TRUE(std::any_of(e.diagnostics.begin(), e.diagnostics.end(),
                              [&](const Diagnostic &d)
                              { return d.message.find(message) != std::string::npos && d.where.line == line && d.where.column > 0; }))
        << e.what();
    }
  }
} // namespace

TEST(Steps, what_a_step_sets_stays)
{
  const Case request = read("[parameters]\nf = 1\ng = 2\n[[step]]\nf = 3\n[[step]]\ng = 5\n[[step]]\nset = { \"model.load\" = \"f + g\" "
                            "}\n[[step]]\nf = \"2*g\"\n" +
                            rest);
  ASSERT_EQ(request.steps.size(), 4u);
  EXPECT_EQ(load_in(request, 0), 3);
  EXPECT_EQ(load_in(request, 1), 3);
  EXPECT_EQ(load_in(request, 2), 8);
  EXPECT_EQ(load_in(request, 3), 15);
  // Expanding changes nothing.
  const Case again = read(expand(request));
  for (std::size_t k = 0; k < 4; ++k)
    EXPECT_EQ(load_in(again, k), load_in(request, k));
  EXPECT_EQ(expand(again), expand(request));
}

TEST(Steps, numbers_of_a_step_have_what_the_case_says_until_a_step_sets_it)
{
  const Case request =
    read("parameters = { f = 1, g = 2 }\n[[step]]\nf = 3\n[[step]]\nset = { \"constraint.0.upper\" = 5, \"constraint.lower\" "
         "= -1, \"model.load\" = \"g\" }\n[[step]]\ng = 4\n" +
         rest);
  EXPECT_EQ(stepped_values(request, 0).dump(),
            R"({"f":3.0,"constraint.0.upper":1.0,"constraint.lower":null,"model.load":"\"f\"","g":2.0})");
  EXPECT_EQ(stepped_values(request, 1).dump(),
            R"({"f":3.0,"constraint.0.upper":5.0,"constraint.lower":-1.0,"model.load":"\"g\"","g":2.0})");
  EXPECT_EQ(stepped_values(request, 2).dump(),
            R"({"f":3.0,"constraint.0.upper":5.0,"constraint.lower":-1.0,"model.load":"\"g\"","g":4.0})");
}

TEST(Steps, numbers_of_a_step_know_what_other_keys_set)
{
  const Case request =
    read("[parameters]\nf = 1\n[[step]]\nset = { \"constraint.upper\" = 2 }\n[[step]]\nset = { \"constraint.0.upper\" = 3 }\n" + rest);
  EXPECT_EQ(stepped_values(request, 0).dump(), R"({"constraint.upper":2.0,"constraint.0.upper":2.0})");
  EXPECT_EQ(stepped_values(request, 1).dump(), R"({"constraint.upper":3.0,"constraint.0.upper":3.0})");
}

TEST(Steps, lists_and_ranges_are_steps_in_short)
{
  const Case request =
    read("[parameters]\nf = 1\ng = 0\n[steps]\nf = \"1:3:3\"\ng = [0, 1, \"2 + f\"]\nset = { \"constraint.upper\" = [1, 2, 3] }\n" + rest);
  ASSERT_EQ(request.steps.size(), 3u);
  for (std::size_t k = 0; k < 3; ++k)
  {
    EXPECT_EQ(load_in(request, k), 1. + k);
    EXPECT_EQ(case_of_step(request, k).constraints[0].upper->value, 1. + k);
  }
  EXPECT_EQ(read("parameters = { f = 1 }\n[steps]\ncount = 7\n" + rest).steps.size(), 7u);
}

TEST(Steps, what_does_not_change_is_the_same_function_in_the_next_step)
{
  const Case request =
    read("[parameters]\nf = 1\nk = \"1 + x\"\n[steps]\nf = [1, 2]\n" + rest + "[[material]]\nregion = \"domain\"\nstiffness = \"2*k\"\n");
  StepFields  fields;
  Diagnostics diagnostics;
  const auto  first = problem_of(case_of_step(request, 0), diagnostics, fields);
  const auto  second = problem_of(case_of_step(request, 1), diagnostics, fields);
  EXPECT_TRUE(first.materials[0].coefficients.stiffness->front().same_as(second.materials[0].coefficients.stiffness->front()));
  EXPECT_FALSE(first.model.coefficients.load->front().same_as(second.model.coefficients.load->front()));
}

TEST(Steps, mistakes_are_reported_where_they_are)
{
  const std::string parameters = "[parameters]\nf = 1\n";
  expect_error(parameters + "[[step]]\nff = 3\n" + rest, "has no 'ff'; known: f", 4);
  expect_error(parameters + "[[step]]\nf = \"2*q\"\n" + rest, "q", 4);
  expect_error(parameters + "[[step]]\nset = { \"mesh.refine\" = 3 }\n" + rest, "same in all steps", 4);
  expect_error(parameters + "[[step]]\nset = { \"model.element\" = \"Q2\" }\n" + rest, "same in all steps", 4);
  expect_error(parameters + "[[step]]\nset = { \"model.lod\" = 3 }\n" + rest, "unknown key 'lod'", 4);
  expect_error(parameters + "[[step]]\nset = 3\n" + rest, "must be a table", 4);
  expect_error(parameters + "[steps]\nf = 3\n" + rest, "must be a list", 4);
  expect_error(parameters + "[steps]\nf = [1, 2]\ncount = 3\n" + rest, "'count' is 3", 5);
  expect_error(parameters + "[steps]\n" + rest, "makes no steps", 3);
  expect_error(parameters + "[steps]\nf = [1, 2]\n[[step]]\nf = 3\n" + rest, "two ways", 3);
  expect_error(parameters + "[steps]\nf = \"1:2:20000\"\n" + rest, "must be a list", 4);
  expect_error("parameters = { f = { previous = \"u\" } }\n" + rest, "no step before", 1);
  expect_error("parameters = { f = { previous = \"v\" } }\n[steps]\ncount = 2\n" + rest, "'v' is no quantity", 1);
  expect_error("parameters = { f = { previous = \"u\", quantity = \"u\" } }\n[steps]\ncount = 2\n" + rest, "only the solution of a run", 1);
  expect_error("parameters = { f = { run = \"nowhere.out\" } }\n" + rest, "there is no folder", 1);
  expect_error("parameters = { f = { run = \"a\", raster = \"b\" } }\n" + rest, "must hold one of", 1);
  expect_error(parameters + "[[step]]\nf = 2\n[[part]]\nname = \"foot\"\nwhere = \"x < f\"\n" + rest, "depends on 'f'", 7);
}

TEST(Steps, mistakes_of_all_steps_are_reported_in_one_go)
{
  const std::string text = "[parameters]\nf = 1\n[[step]]\nff = 3\n[[step]]\nf = 3\n[[step]]\nset = { \"model.lod\" = 3 }\n" + rest;
  expect_error(text, "has no 'ff'", 4);
  expect_error(text, "unknown key 'lod'", 8);
}

TEST(Steps, values_from_outside_that_steps_replace_are_warned_of)
{
  const std::string text = "[parameters]\nf = 1\ng = 2\n[[step]]\nf = \"3 + 0*g\"\n[[step]]\nset = { \"boundary.all\" = 0.5 }\n" + rest;
  const auto        warnings = [&](const std::string &key)
  {
    Diagnostics diagnostics;
    parse_case(text, "case.toml", {{key, "4"}}, diagnostics);
    return diagnostics.all();
  };
  EXPECT_TRUE(warnings("parameters.g").empty());
  const auto at_once = warnings("parameters.f"), later = warnings("boundary.all");
  ASSERT_EQ(at_once.size(), 1u);
  EXPECT_EQ(at_once[0].where.line, 4u);
  EXPECT_NE(at_once[0].message.find("has no effect"), std::string::npos) << at_once[0].message;
  ASSERT_EQ(later.size(), 1u);
  EXPECT_EQ(later[0].where.line, 6u);
  EXPECT_NE(later[0].message.find("up to step 1"), std::string::npos) << later[0].message;
}
