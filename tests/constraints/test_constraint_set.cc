// K_h: which points, which weights, which rows.
#include "small_problem.h"
#include "unilateral/case/problem_of_case.h"

#include <gtest/gtest.h>

#include <deal.II/dofs/dof_tools.h>

#include <cmath>
#include <functional>

namespace
{
  using namespace unilateral;

  /// A unit cube of @p cells a direction with @p more lines in [model], [boundary], [constraint].
  template <int dim>
  std::string unit_cube(const unsigned cells, const std::string &element, const std::string &boundary, const std::string &constraint)
  {
    const std::string zeros[] = {"[0]", "[0, 0]", "[0, 0, 0]"}, ones[] = {"[1]", "[1, 1]", "[1, 1, 1]"};
    return "[mesh]\nbox = [" + zeros[dim - 1] + ", " + ones[dim - 1] + "]\ncells = " + std::to_string(cells) +
           "\n[model]\nkind = \"membrane\"\nload = 1\nelement = \"" + element + "\"\n[boundary]\n" + boundary + "\n" + constraint + "\n";
  }

  const std::string default_ceiling = "[constraint]\nupper = 2";

  std::string ceiling(const std::string &rule)
  {
    return "[constraint]\nupper = 2\nquadrature = \"" + rule + "\"";
  }

  template <int dim>
  ConstraintSet<dim> set_of(const std::string &text)
  {
    const Case         request = case_of(text);
    Diagnostics        diagnostics;
    const Problem<dim> problem(problem_of(request), diagnostics);
    return problem.make_constraint_set();
  }

  template <int dim>
  double sum_of_weights(const ConstraintSet<dim> &set)
  {
    double sum = 0;
    for (const auto &point : set.points)
      sum += point.weight;
    return sum;
  }

  template <int dim>
  double smallest_distance(const ConstraintSet<dim> &set)
  {
    double smallest = 1e300;
    for (std::size_t i = 0; i < set.size(); ++i)
      for (std::size_t j = 0; j < i; ++j)
        smallest = std::min(smallest, set.points[i].x.distance(set.points[j].x));
    return smallest;
  }

  /// Largest difference between v(x_i) from the trace and the polynomial v itself, interpolated at the nodes of V_h.
  template <int dim>
  double trace_error(const std::string &text, const std::function<double(const dealii::Point<dim> &)> &polynomial)
  {
    const Case                      request = case_of(text);
    Diagnostics                     diagnostics;
    const Problem<dim>              problem(problem_of(request), diagnostics);
    const auto                      set = problem.make_constraint_set();
    std::vector<dealii::Point<dim>> nodes(problem.space.dof_handler.n_dofs());
    dealii::DoFTools::map_dofs_to_support_points(*problem.space.mapping, problem.space.dof_handler, nodes);
    Vector v(nodes.size());
    for (std::size_t j = 0; j < nodes.size(); ++j)
      v(j) = polynomial(nodes[j]);
    const auto values = set.values_of(v);
    double     error = 0;
    for (std::size_t i = 0; i < set.size(); ++i)
      error = std::max(error, std::abs(values[i] - polynomial(set.points[i].x)));
    return error;
  }
} // namespace

TEST(ConstraintSet, shared_nodes_are_one_point)
{
  const std::string spring = "all = { flux = 0, spring = 1 }";
  for (const unsigned p : {1u, 2u, 3u})
  {
    const std::string Q = "Q" + std::to_string(p);
    const auto        line = set_of<1>(unit_cube<1>(7, Q, spring, default_ceiling));
    EXPECT_EQ(line.size(), 7 * p + 1);
    const auto square = set_of<2>(unit_cube<2>(5, Q, spring, default_ceiling));
    EXPECT_EQ(square.size(), (5 * p + 1) * (5 * p + 1));
    EXPECT_GT(smallest_distance(square), 0.04);
    EXPECT_EQ(set_of<3>(unit_cube<3>(2, Q, spring, default_ceiling)).size(), (2 * p + 1) * (2 * p + 1) * (2 * p + 1));
    for (std::size_t i = 0; i < square.size(); ++i)
    {
      ASSERT_EQ(square.trace[i].dofs.size(), 1u); // a node sees its own shape function only
      EXPECT_NEAR(square.trace[i].values[0], 1., 1e-12);
    }
  }
}

TEST(ConstraintSet, simpson_on_Q1_shares_points_off_the_nodes)
{
  const auto set = set_of<2>(unit_cube<2>(4, "Q1", "all = { spring = 1 }", ceiling("simpson")));
  EXPECT_EQ(set.size(), 9u * 9u);
  EXPECT_GT(smallest_distance(set), 0.12);
  EXPECT_NEAR(sum_of_weights(set), 1., 1e-13);
}

TEST(ConstraintSet, edges_on_triangles_and_tetrahedra)
{
  // A square of n x n, each cell cut in two: 3 n^2 + 2 n edges.
  const unsigned n = 4;
  const auto     set = set_of<2>(unit_cube<2>(n, "P2", "all = { spring = 1 }", default_ceiling));
  EXPECT_EQ(set.blocks.at(0).rule.name(), "edges");
  const Case       request = case_of(unit_cube<2>(n, "P2", "all = { spring = 1 }", default_ceiling));
  Diagnostics      diagnostics;
  const Problem<2> problem(problem_of(request), diagnostics);
  const auto      &triangulation = *problem.space.mesh.triangulation;
  EXPECT_EQ(set.size(), triangulation.n_active_lines());
  EXPECT_NEAR(sum_of_weights(set), 1., 1e-13);

  const Case       request_3d = case_of(unit_cube<3>(2, "P2", "all = { spring = 1 }", default_ceiling));
  const Problem<3> problem_3d(problem_of(request_3d), diagnostics);
  const auto       set_3d = problem_3d.make_constraint_set();
  EXPECT_EQ(set_3d.size(), problem_3d.space.mesh.triangulation->n_active_lines());
  EXPECT_NEAR(sum_of_weights(set_3d), 1., 1e-13);
}

TEST(ConstraintSet, gauss_points_are_shared_by_nobody)
{
  const auto set = set_of<2>(unit_cube<2>(4, "Q2", "all = { spring = 1 }", ceiling("gauss(3)")));
  EXPECT_EQ(set.size(), 16u * 9u);
  EXPECT_NEAR(sum_of_weights(set), 1., 1e-13);
  EXPECT_TRUE(set.blocks.at(0).exact_pairing);
}

TEST(ConstraintSet, weights_sum_to_the_measure)
{
  const std::string spring = "all = { spring = 1 }";
  EXPECT_NEAR(sum_of_weights(set_of<1>(unit_cube<1>(9, "Q3", spring, default_ceiling))), 1., 1e-13);
  EXPECT_NEAR(sum_of_weights(set_of<2>(unit_cube<2>(3, "P1", spring, default_ceiling))), 1., 1e-13);
  EXPECT_NEAR(sum_of_weights(set_of<2>(unit_cube<2>(3, "P3", spring, default_ceiling))), 1., 1e-13);
  EXPECT_NEAR(sum_of_weights(set_of<3>(unit_cube<3>(2, "P1", spring, default_ceiling))), 1., 1e-13);
  EXPECT_NEAR(sum_of_weights(set_of<3>(unit_cube<3>(2, "P3", spring, default_ceiling))), 1., 1e-12);
  const std::string disc = "[mesh]\nball = { center = [0, 0], radius = 2 }\nrefine = 0\n[model]\nkind = \"membrane\"\nelement = \"Q4\"\n"
                           "load = 1\n[boundary]\nsurface = { spring = 1 }\n[constraint]\nupper = 2\n";
  EXPECT_NEAR(sum_of_weights(set_of<2>(disc)), 4 * M_PI, 4e-4 * M_PI); // the coarsest mesh of curved cells
}

TEST(ConstraintSet, fixed_points_are_dropped)
{
  EXPECT_EQ(set_of<1>(unit_cube<1>(8, "Q1", "all = 0", default_ceiling)).size(), 7u);
  EXPECT_EQ(set_of<1>(unit_cube<1>(8, "Q1", "left = 0", default_ceiling)).size(), 8u);
  EXPECT_EQ(set_of<2>(unit_cube<2>(8, "Q2", "all = 0", default_ceiling)).size(), 15u * 15u);
  // Simpson on Q1: the points between two fixed nodes are as fixed as the nodes.
  EXPECT_EQ(set_of<2>(unit_cube<2>(8, "Q1", "all = 0", ceiling("simpson"))).size(), 15u * 15u);
  // Gauss points are inside: each sees a free node as long as its cell has one.
  EXPECT_EQ(set_of<2>(unit_cube<2>(8, "Q1", "all = 0", ceiling("gauss(2)"))).size(), 64u * 4u);
  EXPECT_EQ(set_of<2>(unit_cube<2>(4, "P2", "all = 0", default_ceiling)).size(), 3u * 16u + 2u * 4u - 16u);
}

TEST(ConstraintSet, nothing_left_to_constrain_is_an_error)
{
  EXPECT_THROW(set_of<2>(unit_cube<2>(1, "Q1", "all = 0", default_ceiling)), InputError);
}

TEST(ConstraintSet, trace_reproduces_the_polynomials_of_the_element)
{
  const std::string spring = "all = { spring = 1 }";
  const auto        cubic_1d = [](const dealii::Point<1> &x) { return 1 + x[0] * (2 - x[0] * (3 - x[0])); };
  const auto        biquadratic = [](const dealii::Point<2> &x) { return (1 + x[0] - 3 * x[0] * x[0]) * (2 - x[1] * x[1]); };
  const auto        quadratic = [](const dealii::Point<2> &x) { return 1 + x[0] - 3 * x[0] * x[0] + x[0] * x[1] - x[1] * x[1]; };
  const auto        cubic = [](const dealii::Point<2> &x) { return x[0] * x[0] * x[1] - 2 * x[1] * x[1] * x[1] + x[0]; };
  const auto        cubic_3d = [](const dealii::Point<3> &x) { return x[0] * x[1] * x[2] - x[2] * x[2] * x[2] + x[0] * x[0]; };
  EXPECT_LT(trace_error<1>(unit_cube<1>(5, "Q3", spring, ceiling("gauss(4)")), cubic_1d), 1e-13);
  EXPECT_LT(trace_error<2>(unit_cube<2>(3, "Q2", spring, ceiling("gauss(2)")), biquadratic), 1e-13);
  EXPECT_LT(trace_error<2>(unit_cube<2>(3, "Q2", spring, ceiling("lobatto(4)")), biquadratic), 1e-13);
  EXPECT_LT(trace_error<2>(unit_cube<2>(3, "P2", spring, ceiling("edges")), quadratic), 1e-13);
  EXPECT_LT(trace_error<2>(unit_cube<2>(3, "P2", spring, ceiling("gauss(3)")), quadratic), 1e-13);
  EXPECT_LT(trace_error<2>(unit_cube<2>(3, "P3", spring, ceiling("gauss(3)")), cubic), 1e-13);
  EXPECT_LT(trace_error<3>(unit_cube<3>(2, "P3", spring, ceiling("gauss(2)")), cubic_3d), 1e-13);
}

TEST(ConstraintSet, on_a_part_of_the_boundary)
{
  const auto on_top = [](const std::string &rule)
  { return "[constraint]\non = \"top\"\nlower = -1" + (rule.empty() ? "" : "\nquadrature = \"" + rule + "\""); };
  for (const unsigned p : {1u, 2u})
  {
    const auto set = set_of<2>(unit_cube<2>(6, "Q" + std::to_string(p), "bottom = 0", on_top("")));
    EXPECT_EQ(set.size(), 6 * p + 1);
    EXPECT_NEAR(sum_of_weights(set), 1., 1e-14);
    for (const auto &point : set.points)
      EXPECT_NEAR(point.x[1], 1., 1e-14);
    EXPECT_EQ(set.blocks.at(0).on, "top");
    EXPECT_EQ(set.blocks.at(0).side, Side::lower);
  }
  // The sides are fixed: the corners of the top go.
  EXPECT_EQ(set_of<2>(unit_cube<2>(6, "Q1", "left = 0\nright = 0\nbottom = 0", on_top(""))).size(), 5u);
  EXPECT_EQ(set_of<2>(unit_cube<2>(6, "Q1", "bottom = 0", on_top("gauss(2)"))).size(), 12u);
  // Triangles have segments as faces: Simpson is all right there.
  EXPECT_EQ(set_of<2>(unit_cube<2>(6, "P2", "bottom = 0", on_top("simpson"))).size(), 13u);
  const auto face = set_of<3>(unit_cube<3>(3, "Q1", "bottom = 0", on_top("")));
  EXPECT_EQ(face.size(), 16u);
  EXPECT_NEAR(sum_of_weights(face), 1., 1e-14);
  const auto triangles = set_of<3>(unit_cube<3>(2, "P1", "bottom = 0", on_top("")));
  EXPECT_NEAR(sum_of_weights(triangles), 1., 1e-14);
  // The end of a segment.
  const auto end = set_of<1>(unit_cube<1>(6, "Q1", "left = 0", "[constraint]\non = \"right\"\nupper = 0.1"));
  ASSERT_EQ(end.size(), 1u);
  EXPECT_EQ(end.points[0].x[0], 1.);
  EXPECT_EQ(end.points[0].weight, 1.);
}

TEST(ConstraintSet, directions_on_a_sphere_are_radial)
{
  for (const char *const element : {"P1", "P2", "Q1"})
  {
    SCOPED_TRACE(element);
    const auto set =
      set_of<3>(std::string("[mesh]\nshell = { center = [0, 0, 0], inner = 0.5, outer = 1 }\n[model]\nkind = \"elasticity\"\n"
                            "young = 1\npoisson = 0.3\nelement = \"") +
                element + "\"\n[boundary]\ninner = [0, 0, 0]\n[constraint]\non = \"outer\"\ngap = 0.1\n");
    ASSERT_GT(set.size(), 0u);
    for (std::size_t i = 0; i < set.size(); ++i)
      EXPECT_NEAR(set.directions[i] * set.points[i].x, set.points[i].x.norm(), 1e-12);
  }
}

TEST(ConstraintSet, two_sides_are_two_blocks)
{
  const auto set = set_of<1>(unit_cube<1>(8, "Q1", "all = 0", "[constraint]\nlower = \"-x\"\nupper = \"x+1\""));
  ASSERT_EQ(set.blocks.size(), 2u);
  EXPECT_EQ(set.blocks[0].end, 7u);
  EXPECT_EQ(set.blocks[1].begin, 7u);
  EXPECT_EQ(set.size(), 14u);
  for (std::size_t i = 0; i < 7; ++i)
  {
    EXPECT_EQ(set.points[i].sign, -1);
    EXPECT_NEAR(set.points[i].bound, -set.points[i].x[0], 1e-15);
    EXPECT_EQ(set.points[i + 7].sign, 1);
    EXPECT_NEAR(set.points[i + 7].bound, set.points[i + 7].x[0] + 1, 1e-15);
  }
}

TEST(ConstraintSet, boundary_values_that_violate_a_bound_are_an_error)
{
  EXPECT_THROW(set_of<1>(unit_cube<1>(8, "Q1", "all = 0", "[constraint]\nlower = 0.1")), InputError);
  EXPECT_THROW(set_of<1>(unit_cube<1>(8, "Q1", "all = 0", "[constraint]\nupper = \"x - 0.5\"")), InputError);
  EXPECT_THROW(set_of<2>(unit_cube<2>(4, "P1", "all = \"x\"", "[constraint]\nupper = 0.9")), InputError);
  EXPECT_THROW(set_of<2>(unit_cube<2>(4, "Q2", "left = 1\nright = 0", "[constraint]\nupper = 0.9")), InputError);
}

TEST(ConstraintSet, hanging_nodes_between_fixed_ones_do_not_violate_a_bound)
{
  // Between two nodes at which z^2 is prescribed the interpolant lies above it.
  EXPECT_NO_THROW(SmallProblem<3>("[mesh]\nbox = [[0, 0, 0], [1, 1, 1]]\ncells = 2\n[[mesh.local]]\nwhere = \"x < 0.4\"\n"
                                  "[model]\nkind = \"membrane\"\nload = 10\n[boundary]\nleft = \"z^2\"\nright = \"z^2\"\n"
                                  "top = \"z^2\"\n[constraint]\nupper = \"z^2\"\n"));
}

TEST(ConstraintSet, a_direction_that_no_face_faces_is_told)
{
  try
  {
    SmallProblem<2>("[mesh]\nbox = [[0, 0], [2, 1]]\ncells = [4, 2]\n[model]\nkind = \"elasticity\"\nyoung = 100\npoisson = 0.3\n"
                    "[boundary]\ntop = { traction = [0, -1] }\n[constraint]\non = \"bottom\"\ngap = 0\ndirection = [0, 1]\n");
    FAIL();
  }
  catch (const InputError &error)
  {
    EXPECT_EQ(error.diagnostics[0].name.text, "nothing-meets-obstacle");
    EXPECT_NE(std::string(error.what()).find("no face of 'bottom' faces the given direction [0, 1]"), std::string::npos) << error.what();
  }
}

TEST(ConstraintSet, boundary_values_that_touch_a_bound_are_fine)
{
  EXPECT_NO_THROW(set_of<1>(unit_cube<1>(8, "Q1", "all = 0", "[constraint]\nlower = 0")));
  EXPECT_NO_THROW(set_of<2>(unit_cube<2>(4, "Q1", "all = \"sqrt(x)/3\"", "[constraint]\nlower = \"sqrt(x)/3\"")));
  EXPECT_NO_THROW(set_of<2>(unit_cube<2>(4, "Q2", "all = \"x\"", "[constraint]\nupper = 1\nlower = 0")));
}

TEST(ConstraintSet, round_off_of_nodes_and_data_is_no_violation)
{
  const auto ball = [](const std::string &dimension, const std::string &constraint, const unsigned refine, const std::string &value = "0")
  {
    return "[parameters]\nr = \"sqrt(x^2 + y^2 + " + std::string(dimension == "2" ? "0" : "z^2") +
           ")\"\n[mesh]\nball = { center = " + (dimension == "2" ? "[0, 0]" : "[0, 0, 0]") + " }\nrefine = " + std::to_string(refine) +
           "\n[model]\nkind = \"membrane\"\nload = 1\n[boundary]\nall = \"" + value + "\"\n[constraint]\n" + constraint + "\n";
  };
  // Zero at the boundary but for the last digits of the coordinates; the root magnifies them to 1e-8.
  for (const std::string bound : {"upper = \"1 - r\"", "upper = \"1e6*(1 - r)\"", "upper = \"1e-6*(1 - r)\"", "lower = \"r - 1\"",
                                  "lower = \"sqrt(max(1 - r^2, 0))\"", "upper = \"-sqrt(max(1 - r^2, 0))\""})
  {
    for (const unsigned refine : {0, 3, 5})
      EXPECT_NO_THROW(SmallProblem<2>(ball("2", bound, refine))) << bound;
    EXPECT_NO_THROW(SmallProblem<3>(ball("3", bound, 2))) << bound;
  }
  EXPECT_NO_THROW(SmallProblem<2>(ball("2", "upper = \"1001 - r\"", 3, "1000")));
  // A true violation is one, small as it may be or where the bound jumps.
  EXPECT_THROW(set_of<1>(unit_cube<1>(8, "Q1", "all = 0", "[constraint]\nupper = \"if(x > 0, 1, -0.1)\"")), InputError);
  EXPECT_THROW(SmallProblem<2>(ball("2", "upper = \"1 - r - 1e-6\"", 3)), InputError);
  EXPECT_THROW(SmallProblem<2>(ball("2", "upper = \"1e-6*(1 - r) - 1e-12\"", 3)), InputError);
  EXPECT_THROW(SmallProblem<2>(ball("2", "lower = \"sqrt(max(1 - r^2, 0)) + 1e-6\"", 3)), InputError);
}

TEST(ConstraintSet, a_floor_above_the_ceiling_is_an_error)
{
  EXPECT_THROW(set_of<1>(unit_cube<1>(8, "Q1", "all = 0", "[constraint]\nlower = \"x - 0.4\"\nupper = \"0.3 - 0.1*x\"")), InputError);
  EXPECT_THROW(set_of<2>(unit_cube<2>(4, "Q1", "all = 0", "[constraint]\nlower = \"4*x*(1-x)*y*(1-y)\"\nupper = \"0.1 + x/10\"")),
               InputError);
  // Those of a part and of the domain, and of two constraints, whichever comes first.
  for (const std::string two : {"[[constraint]]\non = \"right\"\nlower = -0.1\n[[constraint]]\nupper = -0.15",
                                "[[constraint]]\nupper = \"x/4\"\n[[constraint]]\non = \"right\"\nlower = 0.3",
                                "[[constraint]]\nupper = 0.1\n[[constraint]]\nlower = \"0.2*y\""})
    EXPECT_THROW(set_of<2>(unit_cube<2>(4, "Q1", "left.spring = 3", two)), InputError) << two;
  EXPECT_NO_THROW(set_of<2>(
    unit_cube<2>(4, "Q1", "left.spring = 3", "[[constraint]]\non = \"right\"\nlower = -0.1\n[[constraint]]\nupper = \"-0.1 + (1 - x)\"")));
  EXPECT_NO_THROW(set_of<1>(unit_cube<1>(8, "Q1", "all = 0", "[constraint]\nlower = \"min(x, 1 - x)/2\"\nupper = \"min(x, 1 - x)/2\"")));
}
