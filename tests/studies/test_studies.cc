// The rules side by side, meshes side by side, and the index of oscillation.
#include "small_problem.h"

#include "unilateral/case/case_results.h"
#include "unilateral/case/problem_of_case.h"
#include "unilateral/solve.h"
#include "unilateral/stability/pressure_oscillation.h"
#include "unilateral/studies/inf_sup_study.h"
#include "unilateral/studies/mesh_study.h"
#include "unilateral/studies/preview.h"
#include "unilateral/studies/quadrature_study.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>
#include <vector>

using namespace unilateral;

namespace
{
  const std::string string_under_ceiling =
    "[mesh]\nbox = [[0], [1]]\ncells = 6\nrefine = 3\n[model]\nkind = \"membrane\"\nelement = \"Q1\"\nload = 1\n[boundary]\nall = 0\n"
    "[constraint]\nupper = \"1/18\"\n[exact]\nu = \"if(x<1/3,1/18-(1/3-x)^2/2,if(x>2/3,1/18-(x-2/3)^2/2,1/18))\"\n"
    "pressure = \"if(x>1/3 && x<2/3, 1, 0)\"\n";
  const std::string square_under_ceiling =
    "[mesh]\nbox = [[0, 0], [1, 1]]\ncells = 4\nrefine = 2\n[model]\nkind = \"membrane\"\nload = 1\n[boundary]\nall = 0\n"
    "[constraint]\nupper = 0.03\n";

  const QuadratureStudy::Row &row_of(const QuadratureStudy &study, const std::string &rule)
  {
    for (const auto &row : study.rows)
      if (row.rule == rule)
        return row;
    throw std::out_of_range(rule);
  }

  template <int dim>
  MeshStudy meshes(const std::string &text, const MeshStudyOptions &options)
  {
    Diagnostics diagnostics;
    Progress    quiet;
    return study_mesh<dim>(problem_of(case_of(text)), options, diagnostics, quiet);
  }

  double last_rate(const MeshStudy &study, const std::string &name)
  {
    for (const auto &column : error_columns(study))
      if (column.name == name)
        for (const auto &rate : {rates(study, column)})
          for (std::size_t k = rate.size(); k-- > 0;)
            if (rate[k])
              return *rate[k];
    return std::nan("");
  }
} // namespace

TEST(QuadratureStudy, verdicts_and_forces)
{
  Diagnostics           diagnostics;
  Progress              quiet;
  const QuadratureStudy study =
    study_quadrature<1>(problem_of(case_of(string_under_ceiling)), {"nodal", "midpoint", "gauss(2)"}, diagnostics, quiet);
  ASSERT_EQ(study.rows.size(), 3u);
  EXPECT_EQ(row_of(study, "nodal").stability, Stability::stable);
  EXPECT_EQ(row_of(study, "midpoint").stability, Stability::weakly_unstable);
  EXPECT_EQ(row_of(study, "gauss(2)").stability, Stability::kernel);
  EXPECT_FALSE(row_of(study, "nodal").exact_pairing);
  EXPECT_TRUE(row_of(study, "midpoint").exact_pairing);
  EXPECT_EQ(row_of(study, "midpoint").constants->nullity, 1u);
  EXPECT_EQ(row_of(study, "gauss(2)").constants->nullity, 49u);
  EXPECT_NEAR(*row_of(study, "nodal").constants->beta_h, 1, 1e-3);
  for (const auto &row : study.rows)
  {
    EXPECT_TRUE(row.converged);
    EXPECT_NEAR(row.total_contact_force, 1. / 3, 2e-3) << row.rule;
    EXPECT_LT(row.errors->H1_semi.value(), 0.01) << row.rule;
  }
  EXPECT_LT(*row_of(study, "nodal").pressure_oscillation, 1e-3);
}

TEST(QuadratureStudy, chooses_the_rules_of_the_element)
{
  Diagnostics diagnostics;
  Progress    quiet;
  const auto  rules = [&](const std::string &element)
  {
    Case request = case_of(square_under_ceiling);
    request.mesh.refine = 0;
    request.model.element = *parse_element(element);
    std::string names;
    for (const auto &row : study_quadrature<2>(problem_of(request), {}, diagnostics, quiet).rows)
    {
      EXPECT_TRUE(row.refused.empty());
      names += (names.empty() ? "" : " ") + row.rule;
    }
    return names;
  };
  EXPECT_EQ(rules("Q1"), "nodal midpoint simpson gauss(2)");
  EXPECT_EQ(rules("Q2"), "nodal midpoint trapezoid gauss(2) gauss(3)");
  EXPECT_EQ(rules("P1"), "nodal midpoint edges gauss(2)");
  EXPECT_EQ(rules("P2"), "midpoint trapezoid edges gauss(2) gauss(3)");
  Case request = case_of(square_under_ceiling);
  request.mesh.refine = 0;
  const QuadratureStudy asked = study_quadrature<2>(problem_of(request), {"nodal", "edges"}, diagnostics, quiet);
  EXPECT_TRUE(asked.rows[0].refused.empty());
  EXPECT_NE(asked.rows[1].refused.find("triangles"), std::string::npos);
  EXPECT_THROW(study_quadrature<2>(problem_of(request), {"nodle"}, diagnostics, quiet), InputError);
}

TEST(MeshStudy, rates_against_the_exact_solution)
{
  const MeshStudy study = meshes<1>(string_under_ceiling, {});
  ASSERT_EQ(study.rows.size(), 4u);
  EXPECT_NEAR(last_rate(study, "H1_semi"), 1, 0.02);
  EXPECT_NEAR(last_rate(study, "L2"), 2, 0.05);
  EXPECT_EQ(study.epsilon_rule, "auto");
}

TEST(MeshStudy, refinement_by_the_error_has_the_best_order_where_uniform_meshes_have_not)
{
  // A quadrant is a thousand times as stiff: at its corner u behaves like a power of r of about 2/3.
  const std::string corner = "[mesh]\nbox = [[-1, -1], [1, 1]]\ncells = 8\nrefine = 4\n[model]\nkind = \"membrane\"\nload = 1\n"
                             "stiffness = \"if(x > 0 && y > 0, 1000, 1)\"\n[boundary]\nall = 0\n[constraint]\nupper = 0.08\n";
  const MeshStudy   study = meshes<2>(corner, {.adaptive = true});
  ASSERT_TRUE(study.adaptive);
  const AdaptiveMeshes &adaptive = *study.adaptive;
  EXPECT_TRUE(adaptive.converged);
  EXPECT_EQ(adaptive.max_unknowns, study.rows.back().n_dofs);
  ASSERT_GT(adaptive.rows.size(), 5u);
  EXPECT_EQ(adaptive.rows.front().n_dofs, study.rows.front().n_dofs);
  EXPECT_LE(adaptive.rows.back().n_dofs, study.rows.back().n_dofs);
  // As accurate as the finest uniform mesh with less than half of its unknowns.
  const auto enough =
    std::find_if(adaptive.rows.begin(), adaptive.rows.end(),
                 [&](const auto &row) { return row.discretisation_indicator <= study.rows.back().discretisation_indicator; });
  ASSERT_NE(enough, adaptive.rows.end());
  EXPECT_LT(double(enough->n_dofs), 0.5 * double(study.rows.back().n_dofs));
  EXPECT_EQ(orders(adaptive).size(), adaptive.rows.size() - 1);
  const auto  &first = adaptive.rows[adaptive.rows.size() / 2], &last = adaptive.rows.back(); // past the coarsest meshes
  const double order =
    std::log(first.discretisation_indicator / last.discretisation_indicator) / std::log(double(last.n_dofs) / double(first.n_dofs));
  EXPECT_GT(order, 0.45) << "of degree 1 in the plane 0.5 is the best";
  EXPECT_EQ(to_json(adaptive)["rows"].size(), adaptive.rows.size());
}

TEST(MeshStudy, adaptive_meshes_know_errors_and_end_at_the_tolerance_of_the_case)
{
  const MeshStudy study = meshes<1>(string_under_ceiling + "[mesh.adapt]\ntolerance = 0.05\n", {.n_levels = 2, .adaptive = true});
  ASSERT_TRUE(study.adaptive);
  const auto &last = study.adaptive->rows.back();
  EXPECT_LE(last.relative, 0.05);
  ASSERT_TRUE(last.errors && last.errors->energy);
  EXPECT_TRUE(last.guaranteed);
  EXPECT_LE(*last.errors->energy, last.total);
  EXPECT_NEAR(last.total_contact_force, 1. / 3, 0.02);
}

TEST(MeshStudy, meshes_that_cannot_be_refined_by_the_error_are_refused_at_once)
{
  const std::string periodic =
    "[mesh]\nbox = [[0, 0], [1, 1]]\ncells = 4\n[model]\nkind = \"membrane\"\nload = 1\n[boundary]\nbottom = 0\ntop = 0\n"
    "[[periodic]]\nparts = [\"left\", \"right\"]\n[constraint]\nupper = 0.03\n";
  EXPECT_THROW(meshes<2>(periodic, {.adaptive = true}), InputError);
  const std::string projection =
    "[mesh]\nbox = [[0], [1]]\ncells = 4\n[model]\nkind = \"projection\"\nload = \"x\"\n[constraint]\nupper = 0.5\n";
  EXPECT_THROW(meshes<1>(projection, {.adaptive = true}), InputError);
}

// A fixed epsilon stops the convergence; epsilon ~ h^(4/3) keeps the order of H1, since the penalty costs eps^(3/4).
TEST(MeshStudy, epsilon_and_h)
{
  const MeshStudy fixed = meshes<1>(string_under_ceiling, {.n_levels = 7, .epsilon = 1e-3, .power = {}});
  EXPECT_LT(last_rate(fixed, "H1_semi"), 0.2);
  EXPECT_NEAR(last_rate(fixed, "mixed_H1_semi"), 1, 0.02);
  for (const auto &row : fixed.rows)
    EXPECT_DOUBLE_EQ(row.epsilon, 1e-3);
  const MeshStudy coupled = meshes<1>(string_under_ceiling, {.n_levels = 8, .epsilon = 1e-2, .power = 2});
  EXPECT_NEAR(last_rate(coupled, "H1_semi"), 1, 0.1);
  EXPECT_DOUBLE_EQ(coupled.rows[3].epsilon, 1e-2 / 64);
  EXPECT_EQ(coupled.epsilon_rule, "0.01 (h/h0)^2");
}

TEST(MeshStudy, differences_between_levels_without_an_exact_solution)
{
  const MeshStudy study = meshes<2>(square_under_ceiling, {.n_levels = 4, .epsilon = {}, .power = {}});
  EXPECT_FALSE(study.rows[0].errors);
  EXPECT_NEAR(last_rate(study, "difference_H1_semi"), 1, 0.15);
  EXPECT_FALSE(study.rows.back().difference_L2);
  const Case request = case_of(square_under_ceiling);
  EXPECT_EQ(to_json(study, request)["rows"].size(), 4u);
}

TEST(MeshStudy, each_level_is_shown_once)
{
  class Levels : public Progress
  {
  public:
    void                  level_finished(const LevelReport &level) override { shown.push_back(level.level); }
    std::vector<unsigned> shown;
  };
  Diagnostics diagnostics;
  for (const std::optional<double> epsilon : {std::optional<double>(), std::optional<double>(0.01)})
  {
    Levels levels;
    study_mesh<1>(problem_of(case_of(string_under_ceiling)), {.epsilon = epsilon}, diagnostics, levels);
    EXPECT_EQ(levels.shown, (std::vector<unsigned>{0, 1, 2, 3}));
  }
  Levels levels;
  study_quadrature<1>(problem_of(case_of(string_under_ceiling)), {"nodal", "midpoint"}, diagnostics, levels);
  EXPECT_EQ(levels.shown, (std::vector<unsigned>{3, 3}));
}

TEST(PressureOscillation, sees_a_checkerboard_and_no_slope)
{
  const SmallProblem<2> small("[mesh]\nbox = [[0, 0], [1, 1]]\ncells = 12\n[model]\nkind = \"membrane\"\nreaction = 1\n[constraint]\n"
                              "upper = 1\nquadrature = \"midpoint\"\n");
  const auto           &set = small.constraint_set;
  Vector                linear = small.zero_points(), checkerboard = linear, few = linear;
  for (std::size_t i = 0; i < set.size(); ++i)
  {
    linear(i) = 1 + set.points[i].x[0] + 2 * set.points[i].x[1];
    const int parity = int(12 * set.points[i].x[0]) + int(12 * set.points[i].x[1]);
    checkerboard(i) = parity % 2 == 0 ? 1 : 0;
  }
  few(0) = 1;
  EXPECT_LT(*pressure_oscillation(*small.problem, set, 0, linear), 1e-10);
  // The neighbours of a point of value 1 have the mean 1/2 about it, those of a 0 likewise: sqrt(1/2) inside, more at the boundary, where
  // the linear function extrapolates.
  EXPECT_GT(pressure_oscillation(*small.problem, set, 0, checkerboard).value(), std::sqrt(0.5));
  EXPECT_LT(pressure_oscillation(*small.problem, set, 0, checkerboard).value(), 1.2);
  EXPECT_FALSE(pressure_oscillation(*small.problem, set, 0, few));
}

TEST(InfSupStudy, contact_zone_verdict_and_mode)
{
  Case request = case_of(string_under_ceiling);
  request.constraints[0].quadrature = parse_rule("midpoint");
  Diagnostics       diagnostics;
  Progress          quiet;
  const InfSupStudy study = study_inf_sup<1>(
    problem_of(request),
    {.n_levels = 4, .zone = FieldFunction([](const dealii::Point<1> &x) { return x[0] > 1. / 3 && x[0] < 2. / 3 ? 1. : 0.; })}, diagnostics,
    quiet);
  ASSERT_EQ(study.rows.size(), 4u);
  EXPECT_EQ(study.verdict->stability, Stability::weakly_unstable);
  EXPECT_NE(study.verdict->advice.find("nodal"), std::string::npos);
  ASSERT_TRUE(study.rows[2].contact);
  EXPECT_EQ(study.rows[2].all.nullity, 1u);
  EXPECT_EQ(study.rows[2].contact->nullity, 0u);
  EXPECT_NEAR(study.rows[2].zone->C_h, 4.11e-3, 2e-5);
  // The mode of the zone changes sign from cell to cell: 48 cells, then as many points.
  ASSERT_EQ(study.lowest_mode.cell_types.size(), 96u);
  const auto &mode = std::get<std::vector<double>>(study.lowest_mode.cell_arrays[0].values);
  unsigned    n_changes = 0;
  for (unsigned c = 17; c < 32; ++c)
    n_changes += mode[c - 1] * mode[c] < 0;
  EXPECT_GE(n_changes, 14u);
  EXPECT_EQ(mode[0], 0);
  const auto json = to_json(study, request);
  EXPECT_EQ(json["rows"].size(), 4u);
  EXPECT_EQ(json["zone_rows"].size(), 4u);
  EXPECT_EQ(json["verdict"], "weakly unstable");
}

TEST(Studies, take_the_diameter_of_the_largest_cell_for_h)
{
  Diagnostics       diagnostics;
  Progress          quiet;
  const double      diagonal = std::sqrt(2.) / 4;
  const MeshStudy   mesh = meshes<2>(square_under_ceiling, {.n_levels = 2});
  const InfSupStudy inf_sup = study_inf_sup<2>(problem_of(case_of(square_under_ceiling)), {.n_levels = 2}, diagnostics, quiet);
  const CheckReport checked = check<2>(problem_of(case_of(square_under_ceiling)), diagnostics, quiet);
  EXPECT_NEAR(mesh.rows[0].h, diagonal, 1e-12);
  EXPECT_NEAR(mesh.rows[1].h, diagonal / 2, 1e-12);
  EXPECT_NEAR(inf_sup.rows[0].h, diagonal, 1e-12);
  EXPECT_NEAR(checked.h_max, diagonal / 4, 1e-12);
}

TEST(InfSupStudy, a_zone_without_points_is_refused_before_anything_is_computed)
{
  class Phases : public Progress
  {
  public:
    void                     phase(const std::string &name, const std::string &) override { seen.push_back(name); }
    std::vector<std::string> seen;
  } phases;
  Diagnostics              diagnostics;
  const InfSupStudyOptions nowhere = {.n_levels = 3, .zone = FieldFunction(0.), .zone_name = "x > 5"};
  EXPECT_THROW(study_inf_sup<1>(problem_of(case_of(string_under_ceiling)), nowhere, diagnostics, phases), InputError);
  EXPECT_EQ(std::count(phases.seen.begin(), phases.seen.end(), "inf-sup"), 0);
  // A zone that only the finer levels have points in is one.
  const InfSupStudyOptions narrow = {
    .n_levels = 3, .zone = FieldFunction([](const dealii::Point<1> &x) { return std::abs(x[0] - 1. / 12) < 0.01 ? 1. : 0.; })};
  const InfSupStudy study = study_inf_sup<1>(problem_of(case_of(string_under_ceiling)), narrow, diagnostics, phases);
  ASSERT_EQ(study.rows.size(), 3u);
  EXPECT_FALSE(study.rows[0].zone);
  EXPECT_TRUE(study.rows[1].zone);
}

TEST(Check, shows_the_stability_of_each_constraint)
{
  Diagnostics       diagnostics;
  Progress          quiet;
  const CheckReport report = check<2>(problem_of(case_of(square_under_ceiling)), diagnostics, quiet);
  ASSERT_EQ(report.stability.size(), 1u);
  EXPECT_EQ(report.stability[0].verdict->stability, Stability::stable);
}

TEST(Check, tells_the_linear_solver)
{
  Diagnostics diagnostics;
  Progress    quiet;
  Case        request = case_of(square_under_ceiling);
  EXPECT_NE(check<2>(problem_of(request), diagnostics, quiet).linear_solver.find("direct"), std::string::npos);
  request.method.solver = Method::Solver::multigrid;
  EXPECT_NE(check<2>(problem_of(request), diagnostics, quiet).linear_solver.find("multigrid"), std::string::npos);
  request = case_of(string_under_ceiling);
  request.method.solver = Method::Solver::multigrid;
  EXPECT_THROW(check<1>(problem_of(request), diagnostics, quiet), InputError);
}

TEST(Theorem3, bound_of_a_run)
{
  Diagnostics diagnostics;
  Progress    quiet;
  Case        request = case_of(string_under_ceiling);
  request.method.epsilon = 1e-5;
  const auto solution = solve<1>(problem_of(request), diagnostics, quiet);
  ASSERT_TRUE(solution.result.certificate->theorem3_bound);
  EXPECT_GT(*solution.result.certificate->theorem3_bound, solution.result.certificate->penalty_error_bound);
  request.constraints[0].quadrature = parse_rule("gauss(2)");
  const auto kernel = solve<1>(problem_of(request), diagnostics, quiet);
  EXPECT_FALSE(kernel.result.certificate->theorem3_bound);
  EXPECT_NE(kernel.result.certificate->theorem3_reason.find("C_h = 0"), std::string::npos);
}
