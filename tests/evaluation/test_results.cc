// results.json and the evaluation of [[expect]].
#include "solved_case.h"

#include "unilateral/case/case_results.h"
#include "unilateral/case/expectations.h"
#include "unilateral/evaluation/upward_axis.h"

#include <fmt/format.h>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <cmath>
#include <functional>
#include <limits>

namespace
{
  using namespace unilateral;
  using Json = nlohmann::ordered_json;

  Case some_case()
  {
    Case request;
    request.path = "/somewhere/case.toml";
    request.name = "case";
    request.sha256 = "ab12";
    request.dimension = 2;
    request.mesh.source = MeshSpec::Source::box;
    request.mesh.box_lower = {0, 0};
    request.mesh.box_upper = {1, 1};
    request.mesh.cells = {4, 4};
    return request;
  }

  RunResult some_result()
  {
    RunResult result;
    result.converged = true;
    result.dimension = 2;
    result.n_cells = 16;
    result.n_dofs = 25;
    result.element = "Q1";
    result.formulation = "penalty";
    result.epsilon = 1e-6;
    result.energy = -0.25;
    result.probes.push_back({.point = {0.5, 0.25}, .value = {0.125}, .stress = {}, .von_mises = 0, .moments = {}});

    ConstraintResult constraint;
    constraint.on = "domain";
    constraint.side = "lower";
    constraint.total_contact_force = 4.2742;
    constraint.exact_pairing = true;
    result.constraints.push_back(constraint);

    for (unsigned level = 0; level < 2; ++level)
    {
      LevelReport report;
      report.level = level;
      report.seconds = 1.5 + level;
      report.history.resize(3);
      result.levels.push_back(report);
    }
    return result;
  }

  std::vector<std::string> keys(const Json &json)
  {
    std::vector<std::string> names;
    for (const auto &item : json.items())
      names.push_back(item.key());
    return names;
  }

  using Names = std::vector<std::string>;

  Expectation expectation(const std::string &quantity)
  {
    Expectation expectation;
    expectation.quantity = quantity;
    return expectation;
  }

  /// Evaluates one expectation against some_result().
  ExpectationResult evaluate(const Expectation &expectation)
  {
    Case request = some_case();
    request.expect = {expectation};
    RunResult  result = some_result();
    const bool passed = evaluate_expectations(result, request);
    EXPECT_EQ(result.expect.size(), 1u);
    EXPECT_EQ(passed, result.expect.at(0).passed);
    return result.expect.at(0);
  }
} // namespace

TEST(Results, keys_and_their_order)
{
  const Json json = to_json(some_result(), some_case());
  EXPECT_EQ(keys(json), (Names{"schema_version", "status", "program", "case", "mesh", "space", "constraint", "method", "solution",
                               "warnings", "solver", "timing", "memory", "expect"}));
  EXPECT_EQ(json["schema_version"], 1);
  EXPECT_EQ(json["status"], "converged");
  EXPECT_EQ(keys(json["program"]), (Names{"name", "version", "dealii", "compiler", "simd_bits", "mpi_ranks"}));
  EXPECT_EQ(keys(json["case"]), (Names{"path", "sha256", "title", "settings", "expanded"}));
  EXPECT_EQ(keys(json["mesh"]), (Names{"dimension", "n_cells", "n_levels", "h_min", "h_max"}));
  EXPECT_EQ(keys(json["space"]), (Names{"element", "n_dofs", "m"}));
  EXPECT_EQ(keys(json["constraint"][0]),
            (Names{"on", "side", "quadrature", "n_points", "n_active", "exact_pairing", "contact_measure", "total_contact_force",
                   "max_contact_pressure", "pressure_L2", "max_penetration", "complementarity"}));
  EXPECT_EQ(keys(json["method"]), (Names{"formulation", "epsilon", "epsilon_reason", "solver", "solver_reason", "tolerance"}));
  EXPECT_EQ(keys(json["solution"]), (Names{"energy", "norm_L2", "norm_H1_semi", "norm_energy", "min", "max", "probes"}));
  EXPECT_GT(json["memory"]["peak_bytes"].get<double>(), 1e6);
}

TEST(UpwardAxis, is_opposite_to_weight_and_else_across_the_side_in_contact)
{
  const auto up = [](const std::vector<double> &load, const std::string &on, const MeshDescription::Source source)
  {
    ProblemStatement statement;
    statement.mesh.source = source;
    statement.model.kind = ModelChoices::Kind::elasticity;
    if (!load.empty())
      statement.model.coefficients.load = std::vector<FieldFunction>(load.begin(), load.end());
    statement.constraints.resize(1);
    statement.constraints[0].on = on;
    return "xyz"[upward_axis(statement)];
  };
  using Source = MeshDescription::Source;
  EXPECT_EQ(up({}, "bottom", Source::box), 'y'); // bottom: where y is least
  EXPECT_EQ(up({}, "left", Source::box), 'y');
  EXPECT_EQ(up({}, "front", Source::box), 'z'); // front: where z is least
  EXPECT_EQ(up({}, "floor", Source::file), 'z');
  EXPECT_EQ(up({0, -9.81, 0}, "floor", Source::file), 'y');
  EXPECT_EQ(up({0, 0, -9.81}, "bottom", Source::box), 'z');
  EXPECT_EQ(up({0, 0, 9.81}, "bottom", Source::box), 'y'); // no weight
  EXPECT_EQ(up({0, -1, -1}, "bottom", Source::box), 'y');
}

TEST(Results, functionals_appear_by_name_where_there_are_any)
{
  RunResult result;
  result.functionals = {{"volume", 2.5}, {"flow", -1}};
  const auto json = numbers_json(result);
  EXPECT_EQ(keys(json["solution"]["functionals"]), (Names{"volume", "flow"}));
  EXPECT_EQ(json["solution"]["functionals"]["volume"], 2.5);
}

TEST(Results, status_says_when_the_solver_did_not_converge)
{
  RunResult result = some_result();
  result.converged = false;
  EXPECT_EQ(to_json(result, some_case())["status"], "not_converged");
}

TEST(Results, numbers_that_are_not_finite_become_null)
{
  RunResult result = some_result();
  result.energy = std::numeric_limits<double>::quiet_NaN();
  result.max = std::numeric_limits<double>::infinity();
  const Json json = Json::parse(to_text(to_json(result, some_case())));
  EXPECT_TRUE(json["solution"]["energy"].is_null());
  EXPECT_TRUE(json["solution"]["max"].is_null());
}

TEST(Results, errors_appear_with_an_exact_solution_only)
{
  RunResult result = some_result();
  EXPECT_FALSE(to_json(result, some_case()).contains("errors"));
  result.errors.emplace();
  result.errors->L2 = 1e-3;
  result.errors->max_nodal = 2e-3;
  EXPECT_EQ(keys(to_json(result, some_case())["errors"]), (Names{"L2", "max_nodal"}));
}

TEST(Results, doubles_survive_the_text)
{
  RunResult result = some_result();
  result.energy = 0.1 + 0.2;
  EXPECT_EQ(Json::parse(to_text(to_json(result, some_case())))["solution"]["energy"].get<double>(), 0.1 + 0.2);
}

TEST(Results, bytes_that_are_not_utf8_do_not_break_the_file)
{
  Case request = some_case();
  request.path = "/somewhere/\xff.toml";
  EXPECT_NO_THROW(Json::parse(to_text(to_json(some_result(), request))));
}

TEST(Results, two_runs_differ_in_timing_and_memory_only)
{
  RunResult first = some_result(), second = some_result();
  second.timing.total = 99;
  second.levels[1].seconds = 77;
  Json a = to_json(first, some_case()), b = to_json(second, some_case());
  EXPECT_NE(a["timing"], b["timing"]);
  for (Json *const json : {&a, &b})
  {
    json->erase("timing");
    json->erase("memory");
  }
  EXPECT_EQ(a, b);
}

TEST(Results, history_names_the_level_of_each_step)
{
  const Json solver = to_json(some_result(), some_case())["solver"];
  ASSERT_EQ(solver["levels"].size(), 2u);
  ASSERT_EQ(solver["history"].size(), 6u);
  EXPECT_EQ(solver["history"][5]["level"], 1);
}

TEST(Expectations, value_within_the_relative_or_absolute_tolerance)
{
  Expectation force = expectation("constraint.0.total_contact_force");
  force.value = 4.2740;
  EXPECT_FALSE(evaluate(force).passed);
  force.rtol = 1e-4;
  EXPECT_TRUE(evaluate(force).passed);
  force.rtol = 0;
  force.atol = 1e-3;
  EXPECT_TRUE(evaluate(force).passed);
  force.atol = 1e-5;
  EXPECT_FALSE(evaluate(force).passed);
}

TEST(Expectations, relative_tolerance_of_a_negative_value)
{
  Expectation energy = expectation("solution.energy");
  energy.value = -0.2501;
  energy.rtol = 1e-3;
  EXPECT_TRUE(evaluate(energy).passed);
}

TEST(Expectations, minimum_and_maximum)
{
  Expectation energy = expectation("solution.energy");
  energy.min = -0.3;
  energy.max = 0;
  EXPECT_TRUE(evaluate(energy).passed);
  energy.max = -0.26;
  EXPECT_FALSE(evaluate(energy).passed);
  energy.max.reset();
  energy.min = -0.2;
  EXPECT_FALSE(evaluate(energy).passed);
}

TEST(Expectations, probes_and_flags_can_be_asked_for)
{
  Expectation probe = expectation("solution.probes.0.value");
  probe.value = {0.125};
  EXPECT_TRUE(evaluate(probe).passed);
  Expectation pairing = expectation("constraint.0.exact_pairing");
  pairing.value = 1;
  EXPECT_TRUE(evaluate(pairing).passed);
}

TEST(Expectations, a_quantity_that_does_not_exist_fails_and_says_why)
{
  for (const char *const quantity : {"solution.enrgy", "constraint.1.n_active", "constraint.x", "solution.energy.value", "nothing", "",
                                     "errors.L2", "constraint.99999999999999999999.n_active"})
  {
    const ExpectationResult outcome = evaluate(expectation(quantity));
    EXPECT_FALSE(outcome.passed) << quantity;
    EXPECT_TRUE(std::isnan(outcome.value)) << quantity;
    EXPECT_FALSE(outcome.problem.empty()) << quantity;
  }
  EXPECT_NE(evaluate(expectation("solution.enrgy")).problem.find("energy"), std::string::npos);
}

TEST(Expectations, what_is_not_a_number_fails)
{
  for (const char *const quantity : {"status", "solution", "constraint"})
    EXPECT_FALSE(evaluate(expectation(quantity)).passed) << quantity;

  Case request = some_case();
  request.expect = {expectation("solution.energy")};
  RunResult result = some_result();
  result.energy = std::numeric_limits<double>::quiet_NaN();
  EXPECT_FALSE(evaluate_expectations(result, request));
}

TEST(Expectations, what_was_asked_is_in_the_results_as_numbers)
{
  Expectation asked = expectation("solution.energy");
  asked.value = -0.3;
  asked.rtol = 0.5;
  asked.max = 1;
  Case request = some_case();
  request.expect = {asked};
  RunResult result = some_result();
  evaluate_expectations(result, request);
  const Json json = to_json(result, request)["expect"][0];
  EXPECT_EQ(json["expected"], -0.3);
  EXPECT_EQ(json["rtol"], 0.5);
  EXPECT_EQ(json["atol"], 0);
  EXPECT_TRUE(json["min"].is_null());
  EXPECT_EQ(json["max"], 1);
}

TEST(Expectations, failures_are_errors_at_their_place)
{
  Expectation asked = expectation("solution.energy");
  asked.min = 3;
  asked.where = {"case.toml", 7, 12};
  Case request = some_case();
  request.expect = {asked, expectation("solution.energy")};
  RunResult result = some_result();
  evaluate_expectations(result, request);
  const auto failures = failed_expectations(result);
  ASSERT_EQ(failures.size(), 1u);
  EXPECT_EQ(failures[0].where.line, 7u);
  EXPECT_NE(failures[0].message.find("-0.25"), std::string::npos) << failures[0].message;
}

TEST(Expectations, every_number_of_a_run_can_be_asked_for_beforehand)
{
  Case request = some_case();
  request.constraints.resize(1);
  request.constraints[0].lower = FieldSpec::constant(0);
  request.output.probes = {{0.5, 0.25}};
  request.mesh.refine = 1;
  request.exact.u = {FieldSpec::constant(0)};
  RunResult result = some_result();
  result.errors.emplace().L2 = 1;
  result.certificate.emplace().available = true;

  const std::function<void(const Json &, const std::string &)> ask_for_all = [&](const Json &node, const std::string &path)
  {
    if (node.is_number() || node.is_boolean())
    {
      request.expect = {expectation(path)};
      Diagnostics diagnostics;
      check_expectations(request, diagnostics);
      EXPECT_FALSE(diagnostics.has_errors()) << path;
    }
    for (const auto &item : node.items())
      if (node.is_structured())
        ask_for_all(item.value(), (path.empty() ? "" : path + ".") + item.key());
  };
  const Json json = to_json(result, request);
  for (const char *const block :
       {"mesh", "space", "constraint", "method", "solution", "errors", "certificate", "solver", "timing", "memory"})
    ask_for_all(json[block], block);
}

TEST(Results, a_certificate_that_is_not_there_neither_holds_nor_fails)
{
  RunResult result = some_result();
  result.certificate.emplace();
  EXPECT_TRUE(to_json(result, some_case())["certificate"]["holds"].is_null());
  result.certificate->available = true;
  EXPECT_EQ(to_json(result, some_case())["certificate"]["holds"], true);
}

TEST(Expectations, outcomes_are_in_the_results)
{
  Case request = some_case();
  request.expect = {expectation("solution.energy"), expectation("solution.nothing")};
  RunResult result = some_result();
  EXPECT_FALSE(evaluate_expectations(result, request));
  const Json json = to_json(result, request)["expect"];
  ASSERT_EQ(json.size(), 2u);
  EXPECT_EQ(json[0]["passed"], true);
  EXPECT_EQ(json[0]["value"], -0.25);
  EXPECT_EQ(keys(json[0]), (Names{"quantity", "value", "expected", "rtol", "atol", "min", "max", "passed"}));
  EXPECT_TRUE(json[0]["expected"].is_null());
  EXPECT_EQ(json[1]["passed"], false);
  EXPECT_TRUE(json[1]["value"].is_null());
}

TEST(Results, the_error_in_the_energy_norm_of_a_body_of_revolution_is_what_its_energy_lacks)
{
  // A thick tube under pressure from inside, held along its axis: u_r = A r + B/r.
  const auto tube = [](const std::string &element, const unsigned cells)
  {
    return result_of<2>(fmt::format("[mesh]\nbox = [[1, 0], [2, 1]]\ncells = {}\n[model]\nkind = \"elasticity\"\nelement = \"{}\"\n"
                                    "assumption = \"axisymmetric\"\nyoung = 1\npoisson = 0.3\n[boundary]\nbottom = {{ y = 0 }}\n"
                                    "top = {{ y = 0 }}\nleft = {{ pressure = 0.01 }}\n[constraint]\non = \"right\"\ngap = 10\n"
                                    "[exact]\nu = [\"0.01*1.3/3*((1 - 0.6)*x + 4/x)\", 0]\n",
                                    cells, element));
  };
  const RunResult coarse = tube("Q1", 6), fine = tube("Q3", 12);
  ASSERT_TRUE(coarse.errors && coarse.errors->energy);
  EXPECT_NEAR(*coarse.errors->energy, std::sqrt(2 * (coarse.energy - fine.energy)), 1e-4 * *coarse.errors->energy);
  EXPECT_LT(*fine.errors->energy, 1e-3 * *coarse.errors->energy);
}
