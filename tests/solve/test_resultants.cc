// Loads of bodies by their force and moment: the resultants are exact on every mesh.
#include "elastic_block.h"
#include "small_problem.h"

#include "unilateral/discretisation/rigid_body_modes.h"
#include "unilateral/solve.h"

#include <fmt/format.h>

#include <gtest/gtest.h>

#include <unistd.h>

#include <cmath>
#include <filesystem>

using namespace unilateral;
using namespace dealii;

namespace
{
  const std::string material = "[model]\nkind = \"elasticity\"\nyoung = 1000\npoisson = 0.3\n";

  /// u_c = 1 for each component, then the rotations about @p p: in 2-D one, in 3-D three.
  template <int dim>
  std::vector<RigidBodyMode<dim>> motions_about(const Point<dim> &p)
  {
    std::vector<RigidBodyMode<dim>> modes;
    for (unsigned c = 0; c < dim; ++c)
      modes.push_back({"translation", [c](const Point<dim> &)
                       {
                         Tensor<1, dim> v;
                         v[c] = 1;
                         return v;
                       }});
    for (unsigned axis = dim == 2 ? 2 : 0; axis < 3; ++axis)
      modes.push_back({"rotation", [axis, p](const Point<dim> &x)
                       {
                         const unsigned a = (axis + 1) % 3, b = (axis + 2) % 3;
                         Tensor<1, dim> v;
                         v[a] = -(x[b] - p[b]);
                         v[b] = x[a] - p[a];
                         return v;
                       }});
    return modes;
  }

  /// The load of a case has this force and moment about @p p.
  template <int dim>
  void expect_resultants(const std::string &text, const Point<dim> &p, const std::vector<double> &expected)
  {
    SmallProblem<dim> small(text);
    const auto        work = work_on_modes(*small.problem, mode_matrix(*small.problem, motions_about(p)));
    ASSERT_EQ(work.load.size(), Eigen::Index(expected.size()));
    for (std::size_t k = 0; k < expected.size(); ++k)
      EXPECT_NEAR(work.load(k), expected[k], 1e-11 * work.load_size.maxCoeff()) << k << "\n" << text;
  }

  template <int dim>
  RunResult solve_text(const std::string &text)
  {
    Diagnostics diagnostics;
    Progress    silent;
    return solve<dim>(problem_of(case_of(text)), diagnostics, silent).result;
  }
} // namespace

TEST(Resultants, force_and_moment_are_exact_on_distorted_meshes)
{
  const std::string file = (std::filesystem::temp_directory_path() / fmt::format("resultants-{}.msh", getpid())).string();
  for (const bool simplex : {false, true})
  {
    ElasticBlock{2, 3, simplex, true, 0.4}.write(file);
    for (const unsigned degree : {1u, 2u, 3u})
      expect_resultants<2>(fmt::format("[mesh]\nfile = \"{}\"\n{}element = \"{}{}\"\n[boundary]\nleft = \"clamped\"\n"
                                       "right = {{ force = [3, -2], moment = 5, about = [0.3, 7] }}\n",
                                       file, material, simplex ? 'P' : 'Q', degree),
                           {0.3, 7}, {3, -2, 5});
    ElasticBlock{3, 2, simplex, true, 0.4}.write(file);
    for (const unsigned degree : {1u, 2u})
      expect_resultants<3>(fmt::format("[mesh]\nfile = \"{}\"\n{}element = \"{}{}\"\n[boundary]\nleft = \"clamped\"\n"
                                       "top = {{ force = [3, -2, 1], moment = [5, 6, -7], about = [0.3, 7, -1] }}\n",
                                       file, material, simplex ? 'P' : 'Q', degree),
                           {0.3, 7, -1}, {3, -2, 1, 5, 6, -7});
  }
  std::filesystem::remove(file);
}

TEST(Resultants, force_and_moment_are_exact_on_curved_parts_and_after_refinement)
{
  for (const std::string element : {"Q1", "Q2", "P2"})
  {
    expect_resultants<2>("[mesh]\nball = { center = [1, 2], radius = 1 }\nrefine = 1\n[[part]]\nname = \"cap\"\nwhere = \"x > 1\"\n" +
                           material + "element = \"" + element + "\"\n[boundary]\nsurface = \"clamped\"\ncap = { moment = 5 }\n",
                         {-3, 4}, {0, 0, 5});
    expect_resultants<3>("[mesh]\nball = { center = [0, 0, 0], radius = 1 }\n[[part]]\nname = \"cap\"\nwhere = \"z > 0\"\n" + material +
                           "element = \"" + element + "\"\n[boundary]\nsurface = \"clamped\"\ncap = { moment = [1, 2, 3] }\n",
                         {-3, 4, 5}, {0, 0, 0, 1, 2, 3});
  }
}

// u_y = M/(2 E I) (x^2 + nu y^2), stresses M y/I: pure bending in plane stress, in the space of Q2.
TEST(Resultants, a_moment_bends_a_strip_to_a_parabola)
{
  const auto result =
    solve_text<2>("[mesh]\nbox = [[0, -0.5], [4, 0.5]]\ncells = [4, 2]\n" + material +
                  "element = \"Q2\"\nassumption = \"plane stress\"\n[boundary]\nleft = \"symmetry\"\nright = { moment = 2 }\n"
                  "[output]\nprobes = [[0, 0], [4, 0], [2, 0.5]]\n");
  const double I = 1. / 12, curvature = 2 / (1000 * I);
  EXPECT_TRUE(result.converged) << result.reason;
  EXPECT_NEAR(result.probes[1].value[1] - result.probes[0].value[1], 0.5 * curvature * 16, 1e-9);
  EXPECT_NEAR(result.probes[2].value[0], -curvature * 2 * 0.5, 1e-10);
  EXPECT_NEAR((*result.probes[2].stress)[0], -2 * 0.5 / I, 1e-6);
  EXPECT_NEAR((*result.probes[2].stress)[1], 0, 1e-6);
}

TEST(Resultants, an_axisymmetric_body_bears_no_moment)
{
  EXPECT_THROW(solve_text<2>("[mesh]\nbox = [[0, 0], [1, 1]]\n" + material +
                             "assumption = \"axisymmetric\"\n[boundary]\nbottom = \"clamped\"\ntop = { moment = 1 }\n"),
               InputError);
}

TEST(Resultants, a_moment_that_varies_is_refused)
{
  EXPECT_THROW(
    solve_text<2>("[mesh]\nbox = [[0, 0], [1, 1]]\n" + material + "[boundary]\nbottom = \"clamped\"\ntop = { moment = \"x\" }\n"),
    InputError);
}
