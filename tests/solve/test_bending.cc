// m = 2 and m = 0 from case to result: beams and plates over obstacles, pointwise projection.
#include "small_problem.h"

#include "unilateral/case/problem_of_case.h"
#include "unilateral/case/write_case.h"
#include "unilateral/solve.h"
#include "unilateral/studies/epsilon_study.h"
#include "unilateral/studies/inf_sup_study.h"

#include <fmt/format.h>

#include <gtest/gtest.h>

#include <cmath>

using namespace unilateral;

namespace
{
  template <int dim>
  RunResult solve_text(const std::string &text, const std::vector<Override> &overrides = {})
  {
    Diagnostics diagnostics;
    Progress    silent;
    return solve<dim>(problem_of(case_of(text, overrides)), diagnostics, silent).result;
  }

  std::string beam(const unsigned cells, const std::string &rest)
  {
    return fmt::format("[mesh]\nbox = [[0], [1]]\ncells = {}\n[model]\nkind = \"beam\"\nload = 1\n", cells) + rest;
  }

  std::string under(const double ceiling, const std::string &condition)
  {
    return fmt::format("[boundary]\nall = \"{}\"\n[constraint]\nupper = {:.17g}\n[method]\nformulation = \"mixed\"\ntolerance = 1e-11\n",
                       condition, ceiling);
  }
} // namespace

TEST(Beam, touches_a_flat_ceiling_at_a_point_or_along_an_interval)
{
  // Simply supported: one point for 1/384 < d < 5/384 with the force 48 (5/384 - d), exact at the nodes.
  const auto point = solve_text<1>(beam(20, under(1. / 200, "simply supported")));
  ASSERT_TRUE(point.converged) << point.reason;
  EXPECT_NEAR(point.constraints[0].total_contact_force, 0.385, 1e-10);
  ASSERT_EQ(point.constraints[0].components->size(), 1);
  EXPECT_NEAR(point.constraints[0].components->at(0).concentrated, 0.385, 1e-10);
  EXPECT_FALSE(point.constraints[0].components->at(0).resolved);
  EXPECT_NEAR(point.reactions->at(0).force, -0.3075, 1e-10);

  // Interval contact on [0.3, 0.7]; the discrete forces of an independent computation with the vertex rule.
  for (const auto &[cells, force] : {std::pair(20u, 0.700175175175), std::pair(160u, 0.700000384602)})
  {
    const auto interval = solve_text<1>(beam(cells, under(3.375e-4, "simply supported")));
    EXPECT_NEAR(interval.constraints[0].total_contact_force, force, 1e-9);
    EXPECT_TRUE(interval.constraints[0].concentrated);
    EXPECT_NEAR(*interval.norm_H2_semi * *interval.norm_H2_semi, 4.05e-5, 4e-9 * (cells == 20 ? 100 : 1));
  }
  const auto clamped = solve_text<1>(beam(160, under(1.125e-4, "clamped")));
  EXPECT_NEAR(clamped.constraints[0].total_contact_force, 0.600000764686, 1e-9);
  EXPECT_NEAR(clamped.reactions->at(0).moment, 0.015, 1e-6);
  EXPECT_NEAR(clamped.energy, -7.65e-5, 1e-12);
}

TEST(Beam, split_of_the_contact_force_converges)
{
  // Contact on [0.3, 0.7] under q = 1: 0.4 spread out and 0.15 (clamped 0.1) at either end, wherever the nodes are.
  for (const auto &[condition, ceiling, concentrated] :
       {std::tuple("simply supported", 3.375e-4, 0.3), std::tuple("clamped", 1.125e-4, 0.2)})
    for (const std::string rule : {"nodal", "gauss(2)"})
      for (const unsigned cells : {20, 33, 40, 77, 160})
      {
        const auto result = solve_text<1>(beam(cells, under(ceiling, condition)), {{"constraint.0.quadrature", "\"" + rule + "\""}});
        ASSERT_EQ(result.constraints[0].components->size(), 1) << rule << " " << cells;
        const auto &piece = result.constraints[0].components->at(0);
        EXPECT_TRUE(piece.resolved);
        EXPECT_NEAR(piece.distributed + piece.concentrated, piece.force, 1e-14);
        EXPECT_NEAR(piece.concentrated, concentrated, 4. / (cells * cells)) << condition << " " << rule << " " << cells;
      }

  // The springs of the penalty method smear the two forces over a length of epsilon^(1/4) = 0.01.
  for (const std::string rule : {"nodal", "gauss(2)"})
  {
    const auto result =
      solve_text<1>(beam(40, under(3.375e-4, "simply supported")),
                    {{"constraint.0.quadrature", "\"" + rule + "\""}, {"method.formulation", "\"penalty\""}, {"method.epsilon", "1e-8"}});
    ASSERT_EQ(result.constraints[0].components->size(), 1) << rule;
    EXPECT_NEAR(result.constraints[0].components->at(0).concentrated, 0.3, 0.03) << rule;
  }
}

TEST(Plate, split_of_the_contact_force_converges)
{
  // A clamped disc under a flat ceiling, contact on r <= a: 64 pi a^2 spread out, the rest on the ring r = a.
  const std::string disc = "[mesh]\nball = { center = [0, 0], radius = 1 }\n[model]\nkind = \"plate\"\nload = 64\n[boundary]\n"
                           "surface = \"clamped\"\n[constraint]\nupper = 0.1031789456312521\n[method]\nformulation = \"mixed\"\n";
  struct Row
  {
    std::string element, rule;
    unsigned    refine;
    double      error; // relative, of either part
  };
  const double ring = 39.29490437825623, inside = 32.16990877275948;
  for (const Row &row : {Row{"c0ip2", "trapezoid", 2, 0.05}, Row{"c0ip2", "trapezoid", 3, 0.02}, Row{"c0ip2", "gauss(1)", 3, 0.02},
                         Row{"c0ip2", "nodal", 2, 0.06}, Row{"c0ip3", "trapezoid", 2, 0.02}})
  {
    const std::string of = fmt::format("{} {} {}", row.element, row.rule, row.refine);
    const auto        result = solve_text<2>(disc, {{"model.element", "\"" + row.element + "\""},
                                                    {"constraint.0.quadrature", "\"" + row.rule + "\""},
                                                    {"mesh.refine", fmt::format("{}", row.refine)}});
    ASSERT_EQ(result.constraints[0].components->size(), 1) << of;
    const auto &piece = result.constraints[0].components->at(0);
    EXPECT_EQ(piece.resolved, row.refine > 2) << of; // six cells wide, then thirteen
    EXPECT_NEAR(piece.concentrated, ring, row.error * ring) << of;
    EXPECT_NEAR(piece.distributed, inside, row.error * inside) << of;
  }
}

TEST(Beam, penalty_figures)
{
  struct Row
  {
    double epsilon, reaction, norm;
  };
  for (const Row &row : {Row{1e-5, 0.70161150175, 0.9684356684}, Row{1e-6, 0.70038605585, 1.086241438},
                         Row{1e-7, 0.70007725930, 1.257665018}, Row{1e-8, 0.70001460267, 1.511217692}})
  {
    const auto result =
      solve_text<1>(beam(640, "[boundary]\nall = \"simply supported\"\n[constraint]\nupper = 3.375e-4\nquadrature = \"gauss(2)\"\n"),
                    {{"method.epsilon", fmt::format("{}", row.epsilon)}});
    EXPECT_NEAR(result.constraints[0].total_contact_force, row.reaction, 1e-4 * row.reaction) << row.epsilon;
    EXPECT_NEAR(result.constraints[0].pressure_L2, row.norm, 1e-4 * row.norm) << row.epsilon;
    EXPECT_TRUE(result.certificate->available);
  }
}

TEST(Beam, supports_loads_and_springs_inside)
{
  // Two spans of 1/2 under q = 1: the middle support bears 5/8, the ends 3/16 each.
  const auto spans =
    solve_text<1>(beam(8, "[boundary]\nall = \"simply supported\"\n[[support]]\nat = 0.5\nvalue = 0\n[constraint]\nupper = 1\n"));
  ASSERT_EQ(spans.reactions->size(), 3);
  EXPECT_NEAR(spans.reactions->at(0).force, -3. / 16, 1e-12);
  EXPECT_NEAR(spans.reactions->at(2).force, -5. / 8, 1e-12);
  // A force in the middle of an unloaded beam deflects it by P/48.
  const auto force =
    solve_text<1>(beam(8, "[boundary]\nall = \"simply supported\"\n[[point_load]]\nat = 0.5\nforce = 3\n[constraint]\nupper = 1\n"
                          "[output]\nprobes = [0.5]\n"),
                  {{"model.load", "0"}});
  EXPECT_NEAR(force.probes[0].value[0], 3. / 48, 1e-13);
  EXPECT_NEAR(force.probes[0].moments[0], -3. / 4, 1e-12);
  // A spring in the middle bears R = k u: u = (5/384) / (1 + k/48).
  const auto spring =
    solve_text<1>(beam(8, "[boundary]\nall = \"simply supported\"\n[[support]]\nat = [0.5]\nspring = 96\n[constraint]\nupper = 1\n"
                          "[output]\nprobes = [0.5]\n"));
  EXPECT_NEAR(spring.probes[0].value[0], 5. / 384 / 3, 1e-13);
  EXPECT_THROW(solve_text<1>(beam(8, "[boundary]\nall = \"clamped\"\n[[support]]\nat = 0.3\nvalue = 0\n[constraint]\nupper = 1\n")),
               InputError);
}

/// Cubics are exact at the nodes: what is left is h^4/720 |q|^2 of each cell, which the recovered moments do not see.
TEST(Beam, supports_that_contradict_each_other_or_the_boundary_are_an_error)
{
  const std::string beam = "[mesh]\nbox = [[0], [1]]\ncells = 10\n[model]\nkind = \"beam\"\nload = -100\n[boundary]\nleft = \"clamped\"\n"
                           "[constraint]\nlower = -0.1\n";
  const auto support = [](const char *const at, const char *const what) { return fmt::format("[[support]]\nat = {}\n{}\n", at, what); };
  EXPECT_THROW(solve_text<1>(beam + support("0.5", "value = 0") + support("0.5", "value = 1")), InputError);
  EXPECT_THROW(solve_text<1>(beam + support("0", "value = 1")), InputError);
  EXPECT_THROW(solve_text<1>(beam + support("0", "slope = 0.1")), InputError);
  EXPECT_TRUE(solve_text<1>(beam + support("0", "value = 0") + support("0.5", "value = 0")).converged);
}

TEST(Beam, estimated_error_is_that_inside_the_cells)
{
  for (const char *const condition : {"clamped", "simply supported"})
    for (const unsigned cells : {2u, 4u, 8u})
    {
      SCOPED_TRACE(fmt::format("{}, {} cells", condition, cells));
      const auto result = solve_text<1>(beam(cells, under(1, condition)));
      EXPECT_NEAR(result.discretisation_indicator / std::sqrt(std::pow(1. / cells, 4) / 720), 1, 0.1);
    }
  // One cell in contact at both its nodes bears its load there.
  const auto contact = solve_text<1>(beam(40, under(3.375e-4, "simply supported")));
  EXPECT_LT(contact.discretisation_indicator, std::sqrt(std::pow(1. / 40, 4) / 720));
}

/// A clamped square plate under a uniform load: compliance 3.8912e-4 q^2 a^6/D (Timoshenko, Woinowsky-Krieger: w = 1.26e-3 in the middle).
TEST(Plate, estimated_error_is_near_the_true_one_on_coarse_meshes)
{
  for (const unsigned cells : {2u, 4u})
  {
    SCOPED_TRACE(cells);
    const auto result =
      solve_text<2>(fmt::format("[mesh]\nbox = [[0, 0], [1, 1]]\ncells = {}\n[model]\nkind = \"plate\"\nload = 1\n[boundary]\n"
                                "all = \"clamped\"\n[constraint]\nupper = 1\n",
                                cells));
    const double error = std::sqrt(3.8912e-4 + 2 * result.energy); // |u|^2 - |u_h|^2
    EXPECT_GT(result.discretisation_indicator / error, 0.5);
    EXPECT_LT(result.discretisation_indicator / error, 2.5);
  }
}

TEST(Beam, prescribed_slopes_are_along_x)
{
  // u = x (1 - x)^2 has the slopes 1 and 0 at the ends and u'''' = 0.
  const auto result =
    solve_text<1>(beam(4, "[boundary]\nleft = { value = 0, slope = 1 }\nright = { value = 0, slope = 0 }\n[constraint]\nupper = 9\n"
                          "[exact]\nu = \"x*(1-x)^2\"\n"),
                  {{"model.load", "0"}});
  EXPECT_LT(*result.errors->max_nodal, 1e-14);
  EXPECT_LT(*result.errors->H2_semi, 1e-6);
}

TEST(Beam, inf_sup_constants_of_cubic_hermite_elements)
{
  struct Row
  {
    std::string condition, rule;
    double      C_h, beta; ///< n = 24, all points; the smallest that is not zero
    unsigned    nullity;
  };
  for (const Row &row : {Row{"clamped", "nodal", 2.52e-4, 1.000, 0}, Row{"clamped", "gauss(3)", 2.92e-5, 0.837, 26},
                         Row{"simply supported", "gauss(2)", 4.82e-5, 0.814, 0}, Row{"simply supported", "gauss(3)", 2.89e-5, 0.837, 24},
                         Row{"simply supported", "simpson", 3.87e-6, 0.067, 0}, Row{"clamped", "simpson", 3.98e-6, 0.067, 1}})
  {
    Diagnostics diagnostics;
    Progress    silent;
    const auto  study = study_inf_sup<1>(problem_of(case_of(beam(24, "[boundary]\nall = \"" + row.condition +
                                                                       "\"\n[constraint]\nupper = 1\nquadrature = \"" + row.rule + "\"\n"))),
                                        {.n_levels = 1, .with_contact = false}, diagnostics, silent);
    const auto &all = study.rows.at(0).all;
    EXPECT_NEAR(all.C_h_nonzero, row.C_h, 0.005 * row.C_h) << row.condition << " " << row.rule;
    EXPECT_EQ(all.nullity, row.nullity) << row.condition << " " << row.rule;
    EXPECT_NEAR(all.nullity > 0 ? all.beta_h_nonzero.value_or(0) : all.beta_h.value_or(0), row.beta, 0.001)
      << row.condition << " " << row.rule;
  }
}

TEST(Beam, a_bound_far_away_does_not_keep_newtons_method_from_the_other_one)
{
  const std::string text = "[mesh]\nbox = [[0], [2]]\ncells = 1000\n[model]\nkind = \"beam\"\nload = -20\n[boundary]\nleft = \"clamped\"\n"
                           "[constraint]\nlower = \"-0.02 - 0.01*x\"\n";
  const auto        one = solve_text<1>(text), two = solve_text<1>(text + "upper = 0.3\n");
  ASSERT_TRUE(one.converged);
  ASSERT_TRUE(two.converged) << two.reason;
  EXPECT_NEAR(two.constraints[0].total_contact_force, 32.874, 0.001);
  EXPECT_NEAR(two.constraints[0].total_contact_force, one.constraints[0].total_contact_force, 1e-5);
}

TEST(Plate, the_certificate_does_not_depend_on_the_unit_of_length)
{
  for (const std::string element : {"hermite", "c0ip2"})
  {
    std::vector<double> relative;
    for (const double L : {1., 1e-6, 1e6})
    {
      const auto result = solve_text<2>(
        fmt::format("[mesh]\nbox = [[0, 0], [{0}, {0}]]\ncells = 6\n[model]\nkind = \"plate\"\nelement = \"{1}\"\nrigidity = 1\nload = -1\n"
                    "[boundary]\nall = \"clamped\"\n[constraint]\nlower = \"{2}*(-0.0008 - 0.0005*(x/{0} - 0.3)^2)\"\n",
                    L, element, std::pow(L, 4)));
      ASSERT_TRUE(result.converged) << result.reason;
      ASSERT_TRUE(result.certificate->available) << result.certificate->reason;
      relative.push_back(result.certificate->penalty_error_bound / result.energy_norm);
    }
    EXPECT_NEAR(relative[1], relative[0], 1e-3 * relative[0]) << element;
    EXPECT_NEAR(relative[2], relative[0], 1e-3 * relative[0]) << element;
  }
}

TEST(Plate, reactions_belong_to_parts_that_hold_it)
{
  // The corners are those of free sides, too.
  for (const std::string element : {"hermite", "c0ip2"})
  {
    const auto result = solve_text<2>("[mesh]\nbox = [[0, 0], [2, 1]]\ncells = [8, 4]\n[model]\nkind = \"plate\"\nelement = \"" + element +
                                      "\"\nrigidity = 1\npoisson = 0.3\nload = -1\n[boundary]\nright = \"clamped\"\n");
    ASSERT_EQ(result.reactions->size(), 1u) << element;
    EXPECT_EQ(result.reactions->at(0).on, "right");
    EXPECT_NEAR(result.reactions->at(0).force, 2, 1e-9) << element;
  }
}

TEST(Plate, hermite_and_interior_penalty_agree)
{
  const std::string text =
    "[mesh]\nbox = [[0, 0], [1, 1]]\ncells = 12\n[model]\nkind = \"plate\"\nload = 100\n[boundary]\nall = \"simply supported\"\n"
    "[constraint]\nupper = 0.2\nquadrature = \"trapezoid\"\n[method]\nformulation = \"mixed\"\n[output]\nprobes = [[0.25, 0.25]]\n";
  const auto hermite = solve_text<2>(text), cubic = solve_text<2>(text, {{"model.element", "\"c0ip3\""}}),
             quartic = solve_text<2>(text, {{"model.element", "\"c0ip4\""}}),
             triangles = solve_text<2>(text, {{"model.element", "\"c0ip3-triangles\""}});
  ASSERT_TRUE(hermite.converged && cubic.converged && quartic.converged && triangles.converged);
  EXPECT_GT(hermite.constraints[0].n_active, 0);
  for (const auto *other : {&cubic, &quartic, &triangles})
  {
    EXPECT_NEAR(other->energy, hermite.energy, 3e-3 * std::abs(hermite.energy));
    EXPECT_NEAR(other->constraints[0].total_contact_force, hermite.constraints[0].total_contact_force,
                0.03 * hermite.constraints[0].total_contact_force);
    EXPECT_NEAR(other->probes[0].value[0], hermite.probes[0].value[0], 2e-3 * hermite.probes[0].value[0]);
  }
  // The supports and the contact bear the load.
  double borne = 0;
  for (const auto &reaction : *hermite.reactions)
    borne -= reaction.force;
  EXPECT_NEAR(borne + hermite.constraints[0].total_contact_force, 100, 1e-6);
}

TEST(Plate, clamped_disc_without_and_with_contact)
{
  const std::string disc =
    "[mesh]\nball = { center = [0, 0], radius = 1 }\nrefine = 2\n[model]\nkind = \"plate\"\nelement = \"c0ip3\"\nload = 64\n"
    "[boundary]\nall = \"clamped\"\n[constraint]\n";
  // q R^4/(64 D) = 1 at the centre.
  EXPECT_NEAR(solve_text<2>(disc + "upper = 2\n[output]\nprobes = [[0, 0]]\n").probes[0].value[0], 1, 1e-3);
  const auto contact = solve_text<2>(disc + "upper = 0.1031789456312521\n");
  EXPECT_NEAR(contact.constraints[0].total_contact_force, 71.46481315101571, 0.02 * 71.46);
  EXPECT_NEAR(contact.energy, -9.685291446981027, 2e-3 * 9.685);
}

TEST(Plate, rigidity_from_thickness)
{
  const std::string text =
    "[mesh]\nbox = [[0, 0], [1, 1]]\ncells = 4\n[model]\nkind = \"plate\"\nload = 1\n{}\n[boundary]\nall = \"clamped\"\n"
    "[constraint]\nupper = 1\n[output]\nprobes = [[0.5, 0.5]]\n";
  const auto at = [&](const std::string &model) { return solve_text<2>(fmt::format(fmt::runtime(text), model)).probes[0].value[0]; };
  EXPECT_NEAR(at("young = 2.4\nthickness = 0.5\npoisson = 0.2"),
              at(fmt::format("poisson = 0.2\nrigidity = {:.17g}", 2.4 * 0.125 / (12 * 0.96))), 1e-14);
}

TEST(Plate, a_distorted_mesh_needs_interior_penalty)
{
  EXPECT_THROW(solve_text<2>("[mesh]\nball = { center = [0, 0], radius = 1 }\n[model]\nkind = \"plate\"\n[boundary]\nall = \"clamped\"\n"
                             "[constraint]\nupper = 1\n"),
               InputError);
}

TEST(Projection, is_exact_at_the_points_of_every_rule)
{
  for (const std::string rule : {"gauss(1)", "gauss(2)", "gauss(4)", "lobatto(3)", "simpson", "trapezoid", "midpoint", "nodal"})
    for (const double epsilon : {1e-1, 1e-6})
    {
      const double yield = epsilon / (1 + 2 * epsilon);
      const auto   result = solve_text<1>(
        fmt::format("[mesh]\nbox = [[0], [1]]\ncells = 7\n[model]\nkind = \"projection\"\nstiffness = 2\nload = \"sin(pi*x)\"\n"
                        "[constraint]\nupper = 0.25\nquadrature = \"{}\"\n[method]\nepsilon = {}\ntolerance = 1e-14\n[exact]\n"
                        "u = \"if(sin(pi*x) > 0.5, 0.25 + {:.17g}*(sin(pi*x) - 0.5), sin(pi*x)/2)\"\n"
                        "pressure = \"max(0, sin(pi*x) - 0.5)/{:.17g}\"\n",
                      rule, epsilon, yield, 1 + 2 * epsilon));
      EXPECT_LT(*result.errors->max_nodal, 1e-13) << rule << " " << epsilon;
      EXPECT_LT(*result.errors->pressure_L2, 1e-9) << rule << " " << epsilon;
      EXPECT_TRUE(result.constraints[0].max_violation_between_points);
    }
  // Continuous functions with the rule of their nodes, too.
  const auto nodal =
    solve_text<2>("[mesh]\nbox = [[0, 0], [1, 1]]\ncells = 5\n[model]\nkind = \"projection\"\nelement = \"Q2\"\nload = \"3*x*y\"\n"
                  "[constraint]\nlower = 0.5\nupper = 1\n[method]\nformulation = \"mixed\"\ntolerance = 1e-13\n[exact]\nu = "
                  "\"min(max(3*x*y, 0.5), 1)\"\n");
  EXPECT_LT(*nodal.errors->max_nodal, 1e-12);
}

TEST(Projection, C_h_is_1)
{
  Diagnostics diagnostics;
  Progress    silent;
  const auto  study = study_inf_sup<1>(
    problem_of(case_of("[mesh]\nbox = [[0], [1]]\ncells = 6\n[model]\nkind = \"projection\"\nload = 1\n[constraint]\nupper = 0.5\n"
                         "quadrature = \"gauss(3)\"\n")),
    {.n_levels = 2, .with_contact = false}, diagnostics, silent);
  for (const auto &row : study.rows)
    EXPECT_NEAR(row.all.C_h, 1, 1e-12);
}

TEST(Bending, the_theorems_hold_on_a_beam)
{
  Diagnostics diagnostics;
  Progress    silent;
  const auto  study = study_epsilon<1>(
    problem_of(case_of(beam(20, "[boundary]\nall = \"simply supported\"\n[constraint]\nupper = 3.375e-4\n"))), {}, diagnostics, silent);
  EXPECT_TRUE(study.holds.theorem1_bounded.value_or(false));
  EXPECT_TRUE(study.holds.theorem3_u.value_or(false));
  EXPECT_TRUE(study.holds.theorem3_p.value_or(false));
}

TEST(Bending, an_expanded_case_is_the_same_case)
{
  for (const std::string &text :
       {beam(8, "rigidity = \"1 + x\"\nreaction = 2\n[boundary]\nleft = { value = 0, slope = 0.1 }\nright = { spring = 3, moment = 1 }\n"
                "[[support]]\nat = 0.5\nvalue = 0\n[[point_load]]\nat = 0.25\nforce = 2\nmoment = 1\n[constraint]\nupper = 1\n"),
        std::string("[mesh]\nbox = [[0, 0], [1, 1]]\ncells = 2\n[model]\nkind = \"plate\"\nelement = \"c0ip2-triangles\"\nyoung = "
                    "2\nthickness = 0.1\n"
                    "load = 1\n[boundary]\nleft = \"clamped\"\nright = \"symmetry\"\n[constraint]\nupper = 1\n"),
        std::string("[mesh]\nbox = [[0, 0], [1, 1]]\n[model]\nkind = \"projection\"\nload = \"x\"\n[constraint]\nupper = 0.5\n")})
  {
    const Case once = case_of(text);
    EXPECT_EQ(expand(case_of(expand(once))), expand(once));
  }
}

TEST(Bending, on_a_line_of_symmetry_plates_of_all_elements_move)
{
  const std::string quarter = "[mesh]\nbox = [[0, 0], [1, 1]]\ncells = 8\n[model]\nkind = \"plate\"\nrigidity = 1\npoisson = 0.3\n"
                              "load = -1\nelement = \"{}\"\n[boundary]\nleft = \"symmetry\"\nbottom = \"symmetry\"\n"
                              "right = \"simply supported\"\ntop = \"simply supported\"\n[constraint]\nlower = -9\n"
                              "[output]\nprobes = [[0, 0]]\n";
  // The middle of a square of side 2: S. Timoshenko, Theory of Plates and Shells, table 8.
  for (const std::string element : {"hermite", "c0ip2", "c0ip3"})
    EXPECT_NEAR(solve_text<2>(fmt::format(fmt::runtime(quarter), element)).probes[0].value[0], -0.004062 * 16, 5e-4) << element;
}
