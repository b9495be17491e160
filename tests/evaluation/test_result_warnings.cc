// What is said beside a result that is not what it seems; and nothing where it is.
#include "small_problem.h"

#include "unilateral/case/problem_of_case.h"
#include "unilateral/solve.h"
#include "unilateral/studies/mesh_study.h"
#include "unilateral/studies/preview.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

using namespace unilateral;

namespace
{
  template <int dim>
  RunResult solved(const std::string &text, const std::vector<Override> &overrides = {})
  {
    Diagnostics diagnostics;
    Progress    silent;
    return solve<dim>(problem_of(case_of(text, overrides)), diagnostics, silent).result;
  }

  bool warns(const RunResult &result, const std::string &words)
  {
    return std::any_of(result.warnings.begin(), result.warnings.end(),
                       [&](const Diagnostic &warning) { return warning.message.find(words) != std::string::npos; });
  }

  std::string all(const RunResult &result)
  {
    std::string text;
    for (const Diagnostic &warning : result.warnings)
      text += warning.message + "\n";
    return text;
  }

  const std::string block = "[mesh]\nbox = [[0, 0], [2, 1]]\ncells = [8, 4]\n[model]\nkind = \"elasticity\"\nyoung = 1000\npoisson = 0.3\n"
                            "[boundary]\nleft = \"symmetry\"\ntop = { pressure = 1 }\n[constraint]\non = \"bottom\"\ngap = \"0.01*x^2\"\n";

  std::string with(std::string text, const std::string &from, const std::string &to)
  {
    const auto at = text.find(from);
    EXPECT_NE(at, std::string::npos) << from;
    return text.replace(at, from.size(), to);
  }

  /// A quarter of a ring as Gmsh would write it: n straight-sided cells around, inner radius 20, outer 25.
  std::string ring_file(const unsigned n)
  {
    const auto    path = std::filesystem::temp_directory_path() / ("unilateral-ring-" + std::to_string(n) + ".msh");
    std::ofstream file(path);
    file << "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$PhysicalNames\n4\n1 1 \"inner\"\n1 2 \"outer\"\n1 3 \"ends\"\n2 4 "
            "\"ring\"\n$EndPhysicalNames\n$Nodes\n"
         << 2 * (n + 1) << "\n";
    file.precision(17);
    for (unsigned k = 0; k <= n; ++k)
      for (unsigned side = 0; side < 2; ++side)
      {
        const double angle = -0.25 * dealii::numbers::PI - 0.5 * dealii::numbers::PI * k / n, r = side ? 25 : 20;
        file << 2 * k + side + 1 << " " << r * std::cos(angle) << " " << r * std::sin(angle) << " 0\n";
      }
    file << "$EndNodes\n$Elements\n" << 3 * n + 2 << "\n";
    unsigned number = 0;
    for (unsigned k = 0; k < n; ++k)
    {
      file << ++number << " 3 2 4 1 " << 2 * k + 1 << " " << 2 * k + 2 << " " << 2 * k + 4 << " " << 2 * k + 3 << "\n";
      file << ++number << " 1 2 1 1 " << 2 * k + 1 << " " << 2 * k + 3 << "\n";
      file << ++number << " 1 2 2 2 " << 2 * k + 2 << " " << 2 * k + 4 << "\n";
    }
    file << ++number << " 1 2 3 3 1 2\n";
    file << ++number << " 1 2 3 3 " << 2 * n + 1 << " " << 2 * n + 2 << "\n$EndElements\n";
    return path.string();
  }

  std::string ring(const unsigned n)
  {
    // Drawn upwards against a pin, which it clasps with its inner side.
    return fmt::format("[mesh]\nfile = \"{}\"\n[model]\nkind = \"elasticity\"\nyoung = 210000\npoisson = 0.3\nload = [0, 1]\n[boundary]\n"
                       "ends = {{ x = 0 }}\n[constraint]\non = \"inner\"\ngap = {{ sphere = {{ center = [0, 0], radius = 20 }} }}\n",
                       ring_file(n));
  }
} // namespace

TEST(ResultWarnings, none_for_an_ordinary_block)
{
  EXPECT_EQ(all(solved<2>(block)), "");
}

TEST(ResultWarnings, strains_that_are_not_small)
{
  EXPECT_TRUE(warns(solved<2>(with(block, "young = 1000", "young = 1e-6")), "not small"));
}

TEST(ResultWarnings, a_pressure_that_jumps_inside_a_face_has_the_right_total)
{
  for (const std::string element : {"Q1", "Q2", "P1", "P2"})
  {
    const RunResult result =
      solved<2>(with(block, "pressure = 1", "pressure = \"if(x > 1.937, 1, 0)\""), {{"model.element", "\"" + element + "\""}});
    EXPECT_NEAR(result.balance->load[1], -0.063, 1e-8) << element;
  }
  const std::string in_space =
    "[mesh]\nbox = [[0, 0, 0], [1, 1, 1]]\ncells = 2\n[model]\nkind = \"elasticity\"\nyoung = 1000\npoisson = 0.3\n"
    "[boundary]\nfront = \"clamped\"\nback = { traction = [0, 0, \"if((x - 0.47)^2 + (y - 0.52)^2 < 0.09, -1, 0)\"] }\n"
    "[constraint]\non = \"right\"\ngap = 1\n";
  for (const std::string element : {"Q1", "P1"})
    EXPECT_NEAR(solved<3>(in_space, {{"model.element", "\"" + element + "\""}}).balance->load[2], -0.09 * dealii::numbers::PI, 1e-3)
      << element;
}

TEST(ResultWarnings, a_pressure_that_jumps_next_to_the_end_of_a_face_has_the_right_total_and_no_bound)
{
  const std::string plane = "mesh.box = [[0, 0], [1, 1]]\nmesh.cells = 1\nmodel = { kind = \"elasticity\", element = \"Q2\", young = 1000, "
                            "poisson = 0 }\nboundary.left = { x = 0 }\nconstraint.on = \"bottom\"\nconstraint.gap = 0\n";
  for (const double jump : {0.001, 0.01, 0.05, 0.5, 0.96, 0.99, 0.9999})
  {
    const auto   text = "boundary.top = { pressure = \"if(x > " + std::to_string(jump) + ", 6, 1)\" }\n";
    const auto   result = solved<2>(plane + text);
    const double force = 1 + 5 * (1 - jump);
    EXPECT_NEAR(result.constraints[0].total_contact_force, force, 1e-6) << jump;
    // In the middle all points see two values, and the bound looks at them.
    EXPECT_EQ(result.estimate->guaranteed, jump == 0.5) << jump << " " << result.estimate->reason;
  }
  for (const std::string pressure : {"exp(3*x)", "1 + x^2", "2 - sin(3*x)"})
    EXPECT_TRUE(solved<2>(plane + "boundary.top = { pressure = \"" + pressure + "\" }\n").estimate->guaranteed) << pressure;
  const auto in_space = solved<3>("mesh.box = [[0, 0, 0], [1, 1, 1]]\nmesh.cells = 1\nmodel = { kind = \"elasticity\", element = \"Q1\", "
                                  "young = 1000, poisson = 0 }\nboundary.left = { x = 0 }\nboundary.bottom = { y = 0 }\n"
                                  "boundary.back = { pressure = \"if(x > 0.99, 6, 1)\" }\nconstraint.on = \"front\"\nconstraint.gap = 0\n");
  EXPECT_NEAR(in_space.constraints[0].total_contact_force, 1.05, 0.03);
  EXPECT_FALSE(in_space.estimate->guaranteed);
}

TEST(ResultWarnings, contact_that_reaches_fixed_nodes)
{
  const std::string clamped = with(with(block, "left = \"symmetry\"", "left = \"clamped\""), "gap = \"0.01*x^2\"", "gap = 0");
  EXPECT_TRUE(warns(solved<2>(clamped, {{"mesh.cells", "[4, 2]"}}), "fixes")) << all(solved<2>(clamped));
  // A floor that the membrane lies on up to its edge.
  EXPECT_TRUE(warns(solved<1>("[mesh]\nbox = [[0], [1]]\ncells = 10\n[model]\nkind = \"membrane\"\nload = -1\n[boundary]\nall = 0\n"
                              "[constraint]\nlower = 0\n"),
                    "fixes"));
}

TEST(ResultWarnings, an_obstacle_that_ends_under_the_contact)
{
  // A ball that is smaller than the body which lies on it.
  const std::string small_ball = with(block, "gap = \"0.01*x^2\"", "gap = { sphere = { center = [0, -0.3], radius = 0.3 } }");
  const RunResult   result = solved<2>(with(small_ball, "pressure = 1", "pressure = 300"));
  EXPECT_GT(result.constraints[0].n_missed, 0u);
  EXPECT_TRUE(warns(result, "do not meet")) << all(result);
  // Far below its edge nothing is wrong.
  const std::string large_ball = with(block, "gap = \"0.01*x^2\"", "gap = { sphere = { center = [0, -1.6], radius = 1.6 } }");
  const RunResult   fine = solved<2>(with(large_ball, "pressure = 1", "pressure = 0.1"), {{"mesh.refine", "2"}});
  EXPECT_GT(fine.constraints[0].n_missed, 0u);
  EXPECT_FALSE(warns(fine, "do not meet")) << all(fine);
}

TEST(ResultWarnings, an_obstacle_that_ends_far_from_the_contact)
{
  // Cells are small where they touch, and large where points miss the cylinder.
  const auto result = solved<3>("[mesh]\nbox = [[0, 0, 0], [1, 1, 1]]\ncells = 4\nrefine = 1\n[[mesh.local]]\n"
                                "where = \"hypot(x - 0.1, hypot(y, z - 0.37)) < 0.12\"\ntimes = 3\n[model]\nkind = \"elasticity\"\n"
                                "element = \"P1\"\nyoung = 50\npoisson = 0.33\n[boundary]\ntop = [0, -0.06, 0]\n[constraint]\n"
                                "on = \"bottom\"\ngap = { cylinder = { point = [0, -0.3, 0.4], axis = [1, 0, 0], radius = 0.3 } }\n");
  EXPECT_GT(result.constraints[0].n_missed, 0u);
  EXPECT_FALSE(warns(result, "do not meet the obstacle")) << all(result);
}

TEST(ResultWarnings, a_plane_has_no_end_at_the_corner_of_the_body)
{
  const RunResult result =
    solved<2>("[mesh]\nbox = [[0, 0], [1, 1]]\ncells = 4\n[model]\nkind = \"elasticity\"\nyoung = 1000\npoisson = 0.3\n"
              "load = [0, -1]\n[boundary]\nleft = { x = 0 }\n[[part]]\nname = \"rim\"\nwhere = \"1\"\n[constraint]\n"
              "on = \"rim\"\ngap = { plane = { point = [0, -0.01], normal = [0, 1] } }\n");
  EXPECT_TRUE(result.converged) << result.reason;
  EXPECT_FALSE(warns(result, "do not meet")) << all(result);
}

TEST(ResultWarnings, values_that_contradict_each_other)
{
  const std::string membrane =
    "[mesh]\nbox = [[0, 0], [1, 1]]\ncells = 4\n[model]\nkind = \"membrane\"\nload = -1\n[boundary]\nleft = \"y\"\n"
    "all = 0\n[constraint]\nlower = -1\n";
  const RunResult result = solved<2>(membrane);
  EXPECT_TRUE(warns(result, "differ by 1")) << all(result);
  EXPECT_EQ(all(solved<2>(with(membrane, "left = \"y\"", "left = \"y*(1 - y)\""))), "");
}

TEST(ResultWarnings, facets_that_stand_for_a_curve)
{
  EXPECT_EQ(all(solved<2>(ring(12))), "") << "felt at the corners alone";
  const RunResult refined = solved<2>(ring(12), {{"mesh.refine", "2"}});
  EXPECT_TRUE(warns(refined, "flat facets")) << all(refined);
  EXPECT_TRUE(warns(solved<2>(ring(12), {{"constraint.quadrature", "\"gauss(2)\""}}), "flat facets"));
}

TEST(ResultWarnings, lengths_that_double_precision_has_not)
{
  EXPECT_THROW(solved<2>(with(block, "[2, 1]]", "[2e100, 1e100]]")), InputError);
}

TEST(Probes, outside_a_ball_but_inside_its_box_are_errors)
{
  const std::string ball =
    "[mesh]\nball = { center = [0, 1, 0], radius = 1 }\n[model]\nkind = \"membrane\"\nload = 6\n[boundary]\nsurface = 0\n"
    "[constraint]\nupper = 0.5\n[output]\nprobes = [[0.75, 0, 0]]\n";
  try
  {
    solved<3>(ball);
    ADD_FAILURE();
  }
  catch (const InputError &e)
  {
    EXPECT_NE(std::string(e.what()).find("0.75, 0, 0"), std::string::npos) << e.what();
  }
  EXPECT_EQ(solved<3>(with(ball, "[0.75, 0, 0]", "[0.5, 1, 0]")).probes.size(), 1u);
}

TEST(Units, what_only_contact_holds_may_be_of_any_size)
{
  for (const double size : {1., 1e-7, 1e-9})
  {
    Diagnostics diagnostics;
    Progress    silent;
    const auto  report =
      check<2>(problem_of(case_of(
                 fmt::format("[mesh]\nbox = [[0, 0], [{0}, {0}]]\ncells = 4\n[model]\nkind = \"elasticity\"\nyoung = 1e11\npoisson = 0.3\n"
                             "[boundary]\nleft = \"symmetry\"\ntop = {{ pressure = 1e6 }}\n[constraint]\non = \"bottom\"\ngap = 0\n",
                             size))),
               diagnostics, silent);
    ASSERT_EQ(report.stability.size(), 1u) << size;
    EXPECT_EQ(report.stability[0].rows[0].all.nullity, 0u) << size;
    const RunResult beam =
      solved<1>(fmt::format("[mesh]\nbox = [[0], [{0}]]\ncells = 8\n[model]\nkind = \"beam\"\nrigidity = {1}\nload = {2}\n"
                            "[boundary]\nall = \"free\"\n[constraint]\nlower = \"{3}*((x/{0} - 0.5)^2 - 0.01)\"\n",
                            size, size * size * size, -1., 0.01 * size));
    EXPECT_TRUE(beam.converged) << size;
    EXPECT_NEAR(beam.constraints[0].total_contact_force / size, 1, 1e-9) << size;
  }
}

TEST(Units, triangles_at_large_coordinates_have_constants)
{
  Diagnostics diagnostics;
  Progress    silent;
  const auto  report =
    check<2>(problem_of(case_of("[mesh]\nbox = [[0, 0], [100000, 100000]]\ncells = 4\n[model]\nkind = \"membrane\"\nelement = \"P1\"\n"
                                "load = -1\n[boundary]\nall = 0\n[constraint]\nlower = -0.01\n")),
             diagnostics, silent);
  ASSERT_EQ(report.stability.size(), 1u);
  EXPECT_TRUE(report.stability[0].rows.back().all.beta_h.has_value());
}

TEST(Units, far_from_the_origin_the_tolerance_ends_where_coordinates_do)
{
  const RunResult result = solved<2>(
    "[mesh]\nbox = [[720978.8073465921, -0.5649624836382462], [720979.5283253994, 0.8818878124884969]]\ncells = 3\n"
    "[model]\nkind = \"membrane\"\nstiffness = 0.27\nload = \"5.2 - 2.05*(x - 720978.8073465921)\"\n[boundary]\nleft = 0\n[constraint]\n"
    "upper = \"0.575 - 0.0152*(x - 720979.16783)\"\nquadrature = \"simpson\"\n[method]\ntolerance = 1e-12\nformulation = \"mixed\"\n");
  EXPECT_TRUE(result.converged) << result.reason;
}

TEST(Projection, takes_one_point_a_cell_in_the_plane)
{
  for (const std::string rule : {"gauss(1)", "midpoint"})
  {
    const RunResult result = solved<2>("[mesh]\nbox = [[0, 0], [1, 1]]\ncells = 4\n[model]\nkind = \"projection\"\nload = \"x - 0.5\"\n"
                                       "[constraint]\nlower = 0\nquadrature = \"" +
                                       rule + "\"\n");
    EXPECT_TRUE(result.converged);
    EXPECT_NEAR(result.max, 0.375, 1e-6);
  }
}

TEST(MeshStudy, leaves_out_levels_where_everything_is_fixed)
{
  Diagnostics diagnostics;
  Progress    silent;
  const auto  study =
    study_mesh<2>(problem_of(case_of("[mesh]\nshell = { center = [0, 0], inner = 1, outer = 2 }\nrefine = 3\n[model]\nkind = \"membrane\"\n"
                                     "load = -4\n[boundary]\nall = 0\n[constraint]\nlower = -0.1\n")),
                  {}, diagnostics, silent);
  EXPECT_EQ(study.rows.size(), 3u);
}
