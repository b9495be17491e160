// Element matrices and geometric multigrid, against the assembled matrices of the same case.
#include "both_ways.h"

#include "unilateral/case/problem_of_case.h"
#include "unilateral/discretisation/cell_systems.h"
#include "unilateral/inequality/certificate.h"
#include "unilateral/solve.h"

#include <gtest/gtest.h>

#include <fmt/format.h>

#include <fstream>
#include <random>

namespace
{
  using namespace unilateral;

  struct Text
  {
    std::string name, text;
    unsigned    dim = 2;
  };

  std::string membrane(const std::string &element,
                       const std::string &rest = "",
                       const std::string &mesh = "box = [[0, 0], [2, 1]]\ncells = [6, 6]\nrefine = 2",
                       const std::string &constraint = "lower = -0.2")
  {
    return fmt::format("[mesh]\n{}\n[model]\nkind = \"membrane\"\nelement = \"{}\"\nload = -1\n{}\n[boundary]\nall = \"0.1*x\"\n"
                       "[constraint]\n{}\n",
                       mesh, element, rest, constraint);
  }

  const std::string cube = "box = [[0, 0, 0], [1, 1, 2]]\ncells = [3, 2, 3]\nrefine = 1";

  // Refined in places, more than once: cells of three levels.
  const std::string square_in_places = "box = [[0, 0], [2, 1]]\ncells = [6, 6]\nrefine = 1\n"
                                       "local = [{ where = \"x > 0.9\" }, { where = \"x > 1.2 && y < 0.5\", times = 2 }]";
  const std::string cube_in_places =
    "box = [[0, 0, 0], [1, 1, 2]]\ncells = [2, 2, 3]\nlocal = [{ where = \"z < 0.7\" }, { where = \"x + y + z < 0.4\" }]";

  std::string body(const std::string &model, const std::string &boundary, const std::string &mesh, const std::string &constraint)
  {
    return fmt::format("[mesh]\n{}\n[model]\nkind = \"elasticity\"\nyoung = 10\n{}\n[boundary]\n{}\n[constraint]\n{}\n", mesh, model,
                       boundary, constraint);
  }

  std::vector<Text> texts()
  {
    std::vector<Text> all;
    for (const unsigned p : {1, 2, 3, 4, 6})
      all.push_back({fmt::format("Q{}", p), membrane(fmt::format("Q{}", p))});
    for (const unsigned p : {1, 2, 3})
      all.push_back({fmt::format("cubeQ{}", p), membrane(fmt::format("Q{}", p), "", cube), 3});
    for (const unsigned p : {1, 2, 3})
      all.push_back({fmt::format("trianglesP{}", p), membrane(fmt::format("P{}", p))});
    for (const unsigned p : {1, 2}) // the points of P3 couple unknowns
      all.push_back({fmt::format("tetrahedraP{}", p), membrane(fmt::format("P{}", p), "", cube), 3});
    all.push_back({"trianglesExpressions", membrane("P2", "stiffness = \"1 + x*y\"\nreaction = \"x^2\"")});
    all.push_back({"trianglesVelocity", membrane("P1", "velocity = [3, 1]")});
    all.push_back({"trianglesTensor", membrane("P3", "stiffness = [2, 0.5, 1]\nreaction = 3")});
    all.push_back({"trianglesPlane", body("poisson = 0.3\nelement = \"P2\"\nload = [0, -1]", "top = [0, -0.01]\nleft = \"symmetry\"",
                                          "box = [[0, 0], [2, 1]]\ncells = [6, 6]\nrefine = 2", "on = \"bottom\"\ngap = \"0.001*x^2\"")});
    all.push_back(
      {"tetrahedraBody",
       body("poisson = 0.3\nelement = \"P2\"", "top = [0, 0, -0.01]\nleft = { spring = 3 }", cube, "on = \"bottom\"\ngap = \"0.001*x^2\""),
       3});
    all.push_back({"expressions", membrane("Q2", "stiffness = \"1 + x*y\"\nreaction = \"x^2\"")});
    all.push_back({"tensor", membrane("Q1", "stiffness = [2, 0.5, 1]\nreaction = 3")});
    all.push_back({"velocity", membrane("Q1", "velocity = [3, 1]")});
    all.push_back({"rotation", membrane("Q2", "velocity = [\"-10*y\", \"10*x\"]\nreaction = 1")});
    all.push_back({"wind", membrane("Q1", "velocity = [0, 2, 5]", cube), 3});
    all.push_back({"disc", membrane("Q2", "", "ball = { center = [0, 0], radius = 1 }\nrefine = 2")});
    all.push_back({"ball", membrane("Q1", "", "ball = { center = [0, 0, 0], radius = 1 }\nrefine = 2"), 3});
    all.push_back(
      {"gauss", membrane("Q1", "", "box = [[0, 0], [2, 1]]\ncells = [6, 6]\nrefine = 2", "lower = -0.01\nquadrature = \"gauss(2)\"")});
    all.push_back(
      {"midpoint", membrane("Q2", "", "box = [[0, 0], [2, 1]]\ncells = [6, 6]\nrefine = 2", "lower = -0.01\nquadrature = \"gauss(1)\"")});
    all.push_back({"plane", body("poisson = 0.3\nload = [0, -1]", "top = [0, -0.01]", "box = [[0, 0], [2, 1]]\ncells = [6, 6]\nrefine = 2",
                                 "on = \"bottom\"\ngap = \"0.001*x^2\"")});
    all.push_back({"springs", body("poisson = 0.3\nelement = \"Q2\"", "top = { traction = [0.1, -0.2], spring = 3 }\nleft = \"symmetry\"",
                                   "box = [[0, 0], [2, 1]]\ncells = [6, 6]\nrefine = 2", "on = \"bottom\"\ngap = \"0.001*x^2\"")});
    all.push_back({"rubber", body("poisson = 0.49", "top = [0, -0.01]", "box = [[0, 0], [2, 1]]\ncells = [6, 6]\nrefine = 2",
                                  "on = \"bottom\"\ngap = \"0.001*x^2\"")});
    all.push_back({"revolution", body("poisson = 0.3\nassumption = \"axisymmetric\"", "top = [0, -0.01]",
                                      "box = [[0, 0], [2, 1]]\ncells = [6, 6]\nrefine = 2", "on = \"bottom\"\ngap = \"0.001*x^2\"")});
    all.push_back(
      {"cube", body("poisson = 0.3", "top = [0, 0, -0.01]\nleft = \"symmetry\"", cube, "on = \"bottom\"\ngap = \"0.001*x^2\""), 3});
    all.push_back({"ballInBall", body("poisson = 0.3", "all = { spring = 1 }", "ball = { center = [0, 0], radius = 1 }\nrefine = 3",
                                      "on = \"surface\"\ngap = \"0.01*x\"")});
    for (const unsigned p : {1, 2, 3})
      all.push_back({fmt::format("inPlacesQ{}", p), membrane(fmt::format("Q{}", p), "stiffness = \"1 + x*y\"", square_in_places)});
    for (const unsigned p : {1, 2})
      all.push_back({fmt::format("cubeInPlacesQ{}", p), membrane(fmt::format("Q{}", p), "", cube_in_places), 3});
    all.push_back({"gaussInPlaces", membrane("Q1", "", square_in_places, "lower = -0.01\nquadrature = \"gauss(2)\"")});
    all.push_back({"planeInPlaces", body("poisson = 0.3\nelement = \"Q2\"\nload = [0, -1]", "top = [0, -0.01]", square_in_places,
                                         "on = \"bottom\"\ngap = \"0.001*x^2\"")});
    all.push_back(
      {"bodyInPlaces",
       body("poisson = 0.3", "back = [0, 0, -0.01]\nleft = \"symmetry\"", cube_in_places, "on = \"front\"\ngap = \"0.001*x^2\""), 3});
    all.push_back({"bodyGauss",
                   body("poisson = 0.3", "back = [0, 0, -0.01]\nleft = \"symmetry\"", cube,
                        "on = \"front\"\ngap = \"0.001*x^2\"\nquadrature = \"gauss(1)\""),
                   3});
    all.push_back({"bodyGaussInPlaces",
                   body("poisson = 0.3", "back = [0, 0, -0.01]\nleft = \"symmetry\"", cube_in_places,
                        "on = \"front\"\ngap = \"0.001*x^2\"\nquadrature = \"gauss(1)\""),
                   3});
    // Lines of make_supports() that slope, and hanging nodes on them.
    all.push_back({"shaftInPlaces",
                   body("poisson = 0.3", "outer = { spring = 1 }\ninner = \"symmetry\"",
                        "shell = { center = [0, 0, 0], inner = 0.5, outer = 1 }\nlocal = [{ where = \"x > 0.3\" }]",
                        "on = \"outer\"\ngap = \"0.01*x\""),
                   3});
    return all;
  }

  /// A mesh file of 2 n^2 triangles of which no two are congruent; their corners in the square are moved at random.
  std::string write_irregular_triangles(const unsigned n)
  {
    const std::string                      path = testing::TempDir() + "irregular-triangles.msh";
    std::ofstream                          file(path);
    std::mt19937                           generator(1);
    std::uniform_real_distribution<double> shift(-0.2, 0.2);
    file << "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Nodes\n" << (n + 1) * (n + 1) << "\n";
    for (unsigned j = 0, number = 1; j <= n; ++j)
      for (unsigned i = 0; i <= n; ++i, ++number)
      {
        const bool   inside = i > 0 && i < n && j > 0 && j < n;
        const double dx = shift(generator), dy = shift(generator);
        file << number << " " << (i + (inside ? dx : 0)) / n << " " << (j + (inside ? dy : 0)) / n << " 0\n";
      }
    file << "$EndNodes\n$Elements\n" << 2 * n * n << "\n";
    for (unsigned j = 0, number = 1; j < n; ++j)
      for (unsigned i = 0; i < n; ++i)
      {
        const unsigned a = j * (n + 1) + i + 1, b = a + 1, c = a + n + 1, d = c + 1;
        file << number++ << " 2 2 1 1 " << a << " " << b << " " << d << "\n"
             << number++ << " 2 2 1 1 " << a << " " << d << " " << c << "\n";
      }
    file << "$EndElements\n";
    return path;
  }

  void expect_equal(const Vector &a, const Vector &b, const double tolerance)
  {
    Vector difference = a;
    difference -= b;
    EXPECT_LE(difference.linfty_norm(), tolerance * b.linfty_norm());
  }

  template <int dim>
  void expect_same_operators(const std::string &text)
  {
    const BothWays<dim> both(text);
    const auto         &one = *both.assembled.discrete;
    const auto         &other = *both.matrix_free;
    const Vector        u = both.random_function(1);
    Vector              Au = u, Au_other = u;
    one.apply_stiffness(Au, u);
    both.assembled.problem->space.dirichlet.set_zero(Au);
    other.apply_stiffness(Au_other, u);
    expect_equal(Au_other, Au, 1e-12);
    expect_equal(other.load(), one.load(), 1e-12);
    expect_equal(other.obstacle(), one.obstacle(), 1e-13);
    expect_equal(other.compliance(), one.compliance(), 1e-12);

    // Single precision, to its accuracy: a step of the smoother with D = 1 and gain -1 from b = 0 is the product.
    const auto &sweep = *both.hierarchy->levels.back().sweep;
    const auto &position = sweep.positions();
    LevelVector x(sweep.size(), 0.f), zero(sweep.size(), 0.f), terms(sweep.size(), 0.f), one_everywhere(sweep.size(), 1.f),
      product(sweep.size(), 0.f);
    for (std::size_t i = 0; i < u.size(); ++i)
      x[position[i]] = u(i);
    sweep.smooth({.x = x.data(),
                  .previous_step = nullptr,
                  .step = product.data(),
                  .b = zero.data(),
                  .inverse_diagonal = one_everywhere.data(),
                  .keep = 0,
                  .gain = -1},
                 {}, terms.data());
    Vector rounded = u;
    for (std::size_t i = 0; i < u.size(); ++i)
      rounded(i) = product[position[i]];
    if (both.hierarchy->finest().further_blocks().empty() && !both.hierarchy->convection)
    {
      both.assembled.problem->space.dirichlet.set_zero(rounded);
      expect_equal(rounded, Au, 2e-5);
    }
  }

  template <int dim>
  void expect_inverse(const std::string &text)
  {
    BothWays<dim> both(text);
    auto         &problem = *both.matrix_free;
    for (const double stiffness : {0., 0.1, 1., 1e3, 1e5, 1e8})
    {
      // Single precision does not tell directions apart when one is that much stiffer: those at a node, or those that the penalty of a
      // face leaves free. The method of multipliers keeps it near 1.
      const bool elastic = text.find("elasticity") != std::string::npos, coupled = text.find("gauss") != std::string::npos;
      const bool curved = text.find("ball") != std::string::npos || text.find("shell") != std::string::npos;
      if (elastic && stiffness > (coupled ? 1 : curved ? 1e5 : 1e8))
        continue;
      Vector d;
      problem.initialize_point_vector(d);
      for (std::size_t i = 0; i < d.size(); ++i)
        if (both.assembled.constraint_set.points[i].x.norm() > 0.6)
          d(i) = stiffness * problem.weights()(i) / problem.compliance()(i);
      const Vector exact = both.random_function(2);
      Vector       rhs = exact, work = exact, trace = d;
      problem.apply_stiffness(rhs, exact);
      problem.apply_trace(trace, exact);
      for (std::size_t i = 0; i < d.size(); ++i)
        trace(i) *= d(i) / problem.weights()(i);
      problem.apply_trace_transpose(work, trace);
      both.assembled.problem->space.dirichlet.set_zero(work);
      rhs += work;
      Vector x = exact;
      x = 0.;
      const LinearSolve solve = problem.solve_tangent(d, rhs, {0, 1e-9}, x);
      EXPECT_TRUE(solve.converged) << stiffness << ": " << solve.failure;
      EXPECT_LE(solve.iterations, 60) << stiffness;
      // The error in the energy of A + B' D B, in which the residual is measured.
      const double size = std::sqrt(exact * rhs);
      x -= exact;
      problem.apply_stiffness(work, x);
      problem.apply_trace(trace, x);
      double error = x * work;
      for (std::size_t i = 0; i < d.size(); ++i)
        error += d(i) * trace(i) * trace(i);
      // GMRES looks at the Euclidean norm of the residual, in which stiff rows count for more.
      EXPECT_LT(std::sqrt(std::abs(error)), (problem.symmetric() ? 1e-7 : 1e-6) * size) << stiffness;
    }
  }

  void PrintTo(const Text &text, std::ostream *out)
  {
    *out << text.name;
  }

  class MatrixFreeCase : public testing::TestWithParam<Text>
  {
  };
} // namespace

TEST_P(MatrixFreeCase, equals_the_assembled_operators)
{
  if (GetParam().dim == 2)
    expect_same_operators<2>(GetParam().text);
  else
    expect_same_operators<3>(GetParam().text);
}

TEST_P(MatrixFreeCase, multigrid_inverts_the_tangent)
{
  if (GetParam().dim == 2)
    expect_inverse<2>(GetParam().text);
  else
    expect_inverse<3>(GetParam().text);
}

TEST(MatrixFree, what_is_as_good_as_incompressible_is_left_to_assembled_matrices)
{
  for (const auto &[poisson, taken] : {std::pair("0.499", true), {"0.4999", false}, {"0.4999\nassumption = \"plane stress\"", true}})
  {
    Diagnostics      diagnostics;
    const Problem<2> problem(problem_of(case_of(body(std::string("poisson = ") + poisson, "top = [0, -0.01]",
                                                     "box = [[0, 0], [2, 1]]\nrefine = 1", "on = \"bottom\"\ngap = 0"))),
                             diagnostics);
    EXPECT_EQ(obstacle_to_multigrid(problem).empty(), taken) << poisson;
  }
}

TEST(MatrixFree, solves_with_a_velocity_as_a_direct_solver_does)
{
  const std::string text = membrane("Q1", "velocity = [\"3*y\", 2]", "box = [[0, 0], [2, 1]]\ncells = 6\nrefine = 3", "lower = -0.02") +
                           "[method]\nformulation = \"mixed\"\ntolerance = 1e-10\nsolver = ";
  Diagnostics diagnostics;
  Progress    progress;
  const auto  direct = solve<2>(problem_of(case_of(text + "\"direct\"\n")), diagnostics, progress).result,
             multigrid = solve<2>(problem_of(case_of(text + "\"multigrid\"\n")), diagnostics, progress).result;
  ASSERT_TRUE(direct.converged && multigrid.converged) << direct.reason << "; " << multigrid.reason;
  EXPECT_EQ(multigrid.levels.back().linear_solver, "multigrid");
  EXPECT_GT(direct.constraints[0].total_contact_force, 0.1);
  EXPECT_EQ(multigrid.constraints[0].n_active, direct.constraints[0].n_active);
  EXPECT_NEAR(multigrid.constraints[0].total_contact_force, direct.constraints[0].total_contact_force, 1e-8);
  EXPECT_NEAR(multigrid.norm_L2, direct.norm_L2, 1e-9);
}

TEST(MatrixFree, strong_convection_is_left_to_assembled_matrices)
{
  for (const auto &[velocity, taken] : {std::pair("[10, 0]", true), {"[1000, 0]", false}})
  {
    Diagnostics      diagnostics;
    const Problem<2> problem(problem_of(case_of(membrane("Q1", std::string("velocity = ") + velocity))), diagnostics);
    EXPECT_EQ(obstacle_to_multigrid(problem).empty(), taken) << velocity;
  }
}

TEST(Multigrid, smooths_the_more_the_less_a_material_yields)
{
  const auto smoother = [](const double nu) { return Multigrid::Parameters::for_volume_to_shape_stiffness(2 * nu / (1 - 2 * nu)); };
  EXPECT_EQ(Multigrid::Parameters::for_volume_to_shape_stiffness(0).smoother_degree, Multigrid::Parameters().smoother_degree);
  EXPECT_EQ(smoother(0.3).smoothing_range, Multigrid::Parameters().smoothing_range);
  EXPECT_EQ(smoother(0.49).smoother_degree, 5u);
  EXPECT_GT(smoother(0.49).smoothing_range, 30);
  EXPECT_EQ(smoother(0.4999).smoother_degree, 10u);
}

TEST(MatrixFree, bounds_the_algebraic_error_however_hard_a_material_is_to_solve_for)
{
  for (const auto *const nu : {"0.3", "0.49", "0.499"})
  {
    BothWays<2> both(body(std::string("poisson = ") + nu, "top = [0, -0.01]", "box = [[0, 0], [2, 1]]\ncells = [4, 4]\nrefine = 3",
                          "on = \"bottom\"\ngap = \"0.001*x^2\""));
    Vector      u = both.assembled.zero_dofs(), lambda = both.assembled.zero_points();
    Progress    progress;
    ASSERT_TRUE(method_of_multipliers(*both.assembled.discrete, {}, {}, u, lambda, progress).converged);
    Vector error = both.random_function(3);
    error *= 1e-6 * u.linfty_norm();
    u += error;
    const double shift = suitable_shift(true);
    const auto   direct = certify(*both.assembled.discrete, 0, shift, u, lambda, progress),
               multigrid = certify(*both.matrix_free, 0, shift, u, lambda, progress);
    ASSERT_TRUE(direct.available && multigrid.available) << nu;
    EXPECT_GE(multigrid.algebraic_error, direct.algebraic_error / 1.05) << nu;
    EXPECT_LE(multigrid.algebraic_error, direct.algebraic_error * 1.05) << nu;
  }
}

TEST(MatrixFree, high_degrees_are_left_to_assembled_matrices)
{
  for (const unsigned degree : {6u, 7u})
  {
    Diagnostics      diagnostics;
    const Problem<2> problem(problem_of(case_of(membrane(fmt::format("Q{}", degree)))), diagnostics);
    EXPECT_EQ(obstacle_to_multigrid(problem).empty(), degree == 6);
  }
}

INSTANTIATE_TEST_SUITE_P(All, MatrixFreeCase, testing::ValuesIn(texts()), [](const auto &info) { return info.param.name; });

TEST(MatrixFree, all_descendants_of_a_triangle_share_a_matrix_however_many_triangles_there_are)
{
  for (const std::string load : {"-1", "\"x*y\""})
  {
    const auto text = [&](const unsigned refine)
    {
      return fmt::format("[mesh]\nfile = \"{}\"\nrefine = {}\n[model]\nkind = \"membrane\"\nelement = \"P2\"\nload = {}\n[boundary]\n"
                         "all = 0\n[constraint]\nlower = -0.2\n",
                         write_irregular_triangles(12), refine, load);
    };
    const SmallProblem<2>  small(text(2));
    const Problem<2>      &problem = *small.problem;
    const CellNumbering<2> numbering(*problem.space.fe, 2);
    CellSystems<2>         systems(problem, numbering);
    for (const auto &cell : problem.space.dof_handler.active_cell_iterators())
      systems.integrate(cell);
    EXPECT_EQ(problem.space.n_cells(), 288u * 16);
    EXPECT_EQ(systems.matrices.size(), 288u * 36);
    expect_same_operators<2>(text(2));
  }
}
