// Meshes that are refined in places: what hangs between coarse and fine cells changes neither the problem nor the answer.
#include "small_problem.h"

#include "unilateral/case/problem_of_case.h"
#include "unilateral/solve.h"
#include "unilateral/spaces/interpolation_to_finer_mesh.h"
#include "unilateral/studies/mesh_study.h"

#include <gtest/gtest.h>

#include <fmt/format.h>

#include <cmath>

namespace
{
  using namespace unilateral;

  const std::string square = "[mesh]\nbox = [[0, 0], [1, 1]]\ncells = 4\n";
  const std::string square_places = "local = [{ where = \"x > 0.5\" }, { where = \"hypot(x - 0.7, y - 0.4) < 0.2\", times = 2 }]\n";
  const std::string cube = "[mesh]\nbox = [[0, 0, 0], [1, 1, 1]]\ncells = 2\n";
  const std::string cube_places = "local = [{ where = \"x > 0.5 && y < 0.6\" }, { where = \"x > 0.8 && z < 0.1\", times = 2 }]\n";

  template <int dim>
  Solution<dim> solve_text(const std::string &text, const std::vector<Override> &overrides = {})
  {
    Diagnostics diagnostics;
    Progress    progress;
    return solve<dim>(problem_of(case_of(text, overrides)), diagnostics, progress);
  }

  template <int dim>
  void expect_hanging_nodes(const std::string &text)
  {
    const SmallProblem<dim> p(text);
    EXPECT_TRUE(p.problem->space.mesh.triangulation->has_hanging_nodes());
    EXPECT_GT(p.problem->space.hanging_nodes.n_constraints(), 5u);
  }

  /// The message of the error that a case has.
  std::string error_of(const std::string &text)
  {
    try
    {
      solve_text<2>(text);
    }
    catch (const InputError &e)
    {
      return e.diagnostics.front().message;
    }
    return "";
  }
} // namespace

TEST(LocalRefinement, cells_inside_become_finer_and_no_others)
{
  const SmallProblem<2> p(square + "local = [{ where = \"x < 0.1 && y < 0.1\", times = 3 }]\n" +
                          "[model]\nkind = \"membrane\"\n[boundary]\nall = 0\n[constraint]\nlower = -1\n");
  const auto           &mesh = *p.problem->space.mesh.triangulation;
  EXPECT_EQ(mesh.n_levels(), 4u);
  for (const auto &cell : mesh.active_cell_iterators())
  {
    const bool in_the_corner = cell->vertex(0).norm()<1e-12, away = cell->center()[0]> 0.5 || cell->center()[1] > 0.5;
    EXPECT_TRUE(!away || cell->level() == 0);
    EXPECT_TRUE(!in_the_corner || cell->level() == 3);
  }
  EXPECT_EQ(p.problem->space.level, 3u);
}

TEST(LocalRefinement, polynomials_of_V_h_are_solutions)
{
  for (const std::string solver : {"direct", "multigrid"})
  {
    const std::string membrane = "[model]\nkind = \"membrane\"\nelement = \"{}\"\nload = \"{}\"\n[boundary]\nall = \"{}\"\n"
                                 "[exact]\nu = \"{}\"\n[constraint]\nlower = -9\n[method]\nsolver = \"{}\"\ntolerance = 1e-12\n";
    const auto        expect_exact = [](const auto &solution)
    {
      EXPECT_LT(solution.result.errors->max_nodal, 1e-10);
      EXPECT_LT(solution.result.errors->H1_semi, 1e-9);
    };
    for (const unsigned p : {1, 2, 3})
    {
      const std::string u = p == 1   ? "1 + x - 2*y + x*y"
                            : p == 2 ? "x^2 - 3*y^2 + x*y"
                                     : "x^3 - y^2",
                        f = p == 1   ? "0"
                            : p == 2 ? "4"
                                     : "2 - 6*x";
      const std::string text = fmt::format(fmt::runtime(membrane), fmt::format("Q{}", p), f, u, u, solver);
      expect_exact(solve_text<2>(square + square_places + text));
      expect_hanging_nodes<2>(square + square_places + text);
    }
    const std::string u = "x^2 - 3*y^2 + x*z", text = fmt::format(fmt::runtime(membrane), "Q2", "4", u, u, solver);
    expect_exact(solve_text<3>(cube + cube_places + text));
    expect_hanging_nodes<3>(cube + cube_places + text);
  }
}

TEST(LocalRefinement, a_body_in_contact_bears_constant_stress)
{
  // Pressed on a plane by its top, sides free to move: sigma_zz = -E/100 everywhere, and the contact pressure is that.
  const std::string text = "[model]\nkind = \"elasticity\"\nyoung = 100\npoisson = 0.3\nelement = \"{}\"\n[boundary]\nleft = \"symmetry\"\n"
                           "bottom = \"symmetry\"\nback = {{ z = -0.01 }}\n[constraint]\non = \"front\"\ngap = 0\n"
                           "[exact]\nu = [\"0.003*x\", \"0.003*y\", \"-0.01*z\"]\n[method]\nformulation = \"mixed\"\nsolver = \"{}\"\n"
                           "tolerance = 1e-11\n";
  for (const std::string solver : {"direct", "multigrid"})
    for (const std::string element : {"Q1", "Q2"})
    {
      const auto solution = solve_text<3>(cube + cube_places + fmt::format(fmt::runtime(text), element, solver));
      EXPECT_LT(solution.result.errors->max_nodal, 1e-9) << element << solver;
      EXPECT_LT(solution.result.balance->residual, 1e-8);
      EXPECT_NEAR(solution.result.constraints[0].total_contact_force, 1, 1e-7);
      for (std::size_t i = 0; i < solution.constraint_set.size(); ++i)
        EXPECT_NEAR(solution.contact_pressure(i), 1, 1e-6);
      EXPECT_TRUE(solution.constraint_set.at_nodes());
    }
}

namespace
{
  template <int dim>
  void expect_weights_of_V_h(const std::string &mesh, const unsigned p)
  {
    const SmallProblem<dim> problem(mesh + fmt::format("[model]\nkind = \"membrane\"\nelement = \"Q{}\"\nreaction = 1\n[boundary]\nall = "
                                                       "\"free\"\n[constraint]\nlower = -1\n",
                                                       p));
    const auto             &set = problem.constraint_set;
    EXPECT_TRUE(set.at_nodes());
    EXPECT_EQ(set.size() + problem.problem->space.hanging_nodes.n_constraints(), problem.problem->space.dof_handler.n_dofs());
    double volume = 0, moment = 0;
    for (std::size_t i = 0; i < set.size(); ++i)
    {
      EXPECT_FALSE(problem.problem->space.hanging_nodes.is_constrained(set.trace[i].dofs[0]));
      EXPECT_GT(set.points[i].weight, 0);
      volume += set.points[i].weight;
      moment += set.points[i].weight * set.points[i].x[0];
    }
    EXPECT_NEAR(volume, 1, 1e-12);
    EXPECT_NEAR(moment, 0.5, 1e-12); // x is a function of V_h: that it is handed over changes nothing
  }
} // namespace

TEST(LocalRefinement, weights_of_nodal_rules_integrate_V_h_as_before_and_hanging_nodes_have_no_points)
{
  for (unsigned p = 1; p <= 8; ++p)
    expect_weights_of_V_h<2>(square + square_places, p);
  for (unsigned p = 1; p <= 4; ++p)
    expect_weights_of_V_h<3>(cube + cube_places, p);
}

TEST(LocalRefinement, all_solvers_find_the_same_with_the_free_boundary_across_the_levels)
{
  for (const std::string rule : {"nodal", "gauss(1)", "gauss(2)"})
  {
    const std::string text = "[mesh]\nbox = [[-2, -2], [2, 2]]\ncells = 8\nrefine = 1\n"
                             "local = [{ where = \"x > 0.1\" }, { where = \"hypot(x - 0.5, y - 0.5) < 0.3\", times = 2 }]\n"
                             "[model]\nkind = \"membrane\"\n[boundary]\nall = 0\n[constraint]\n"
                             "lower = \"1 - x^2 - y^2\"\nquadrature = \"" +
                             rule + "\"\n[method]\nepsilon = 1e-6\ntolerance = 1e-10\nsolver = ";
    const auto direct = solve_text<2>(text + "\"direct\"\n");
    ASSERT_TRUE(direct.result.converged);
    for (const std::string solver : {"amg", "multigrid"})
    {
      const auto other = solve_text<2>(text + "\"" + solver + "\"\n");
      EXPECT_TRUE(other.result.converged);
      EXPECT_NEAR(other.result.energy, direct.result.energy, 1e-8 * direct.result.energy) << rule << solver;
      EXPECT_NEAR(other.result.constraints[0].total_contact_force, direct.result.constraints[0].total_contact_force, 1e-5);
    }
  }
}

TEST(LocalRefinement, plates_take_it)
{
  // Bending by moments on all edges: w = (x^2 + y^2)/2 is a function of V_h, and C1.
  const auto plate = solve_text<2>(square + square_places +
                                   "[model]\nkind = \"plate\"\nelement = \"c0ip2\"\nrigidity = 1\npoisson = 0.3\n"
                                   "[boundary]\nall = { value = \"(x^2 + y^2)/2\", moment = 1.3 }\n[exact]\nu = \"(x^2 + y^2)/2\"\n"
                                   "[constraint]\nlower = -9\n");
  EXPECT_LT(plate.result.errors->max_nodal, 1e-9);
}

TEST(LocalRefinement, a_function_is_the_same_on_a_finer_mesh)
{
  const std::string text =
    square + square_places + "[model]\nkind = \"membrane\"\nelement = \"Q2\"\n[boundary]\nall = 0\n[constraint]\nlower = -9\n";
  const SmallProblem<2> coarse(text), fine(text, {{"mesh.refine", "1"}});
  Vector                u(coarse.problem->space.dof_handler.n_dofs()), expected(fine.problem->space.dof_handler.n_dofs());
  const auto            sample = [](const Problem<2> &problem, Vector &values)
  {
    for (const auto &node : problem.space.nodal_values())
      values(node.dof) = node.x[0] * node.x[0] - node.x[0] * node.x[1];
  };
  sample(*coarse.problem, u);
  sample(*fine.problem, expected);
  Vector carried = on_finer_mesh(coarse.problem->space.dof_handler, u, fine.problem->space.dof_handler);
  carried -= expected;
  EXPECT_LT(carried.linfty_norm(), 1e-13);
  EXPECT_THROW(on_finer_mesh(fine.problem->space.dof_handler, expected, coarse.problem->space.dof_handler), std::invalid_argument);
}

/// Triangles and tetrahedra are bisected: nothing hangs, and a constraint that holds everywhere leaves the solution of the equation, which
/// is quadratic here, exact.
TEST(LocalRefinement, triangles_and_tetrahedra)
{
  const std::string membrane = "[model]\nkind = \"membrane\"\nelement = \"{}\"\nload = -2\n[boundary]\nall = \"x^2\"\n"
                               "[constraint]\nlower = -1\n[exact]\nu = \"x^2\"\n";
  for (const std::string element : {"P2", "P3"})
  {
    const std::string     rest = fmt::format(fmt::runtime(membrane), element);
    const SmallProblem<2> p(square + square_places + rest);
    EXPECT_FALSE(p.problem->space.mesh.triangulation->has_hanging_nodes());
    EXPECT_GT(p.problem->space.mesh.triangulation->n_active_cells(), 60u);
    EXPECT_LT(p.problem->space.mesh.triangulation->n_active_cells(), 800u);
    const auto solution = solve_text<2>(square + square_places + rest);
    EXPECT_LT(solution.result.errors->max_nodal, 1e-12) << element;
    const auto solid = solve_text<3>(cube + cube_places + rest);
    EXPECT_LT(solid.result.errors->max_nodal, 1e-12) << element;
    const auto iterated = solve_text<3>(cube + cube_places + rest, {{"method.solver", "\"amg\""}});
    EXPECT_LT(iterated.result.errors->max_nodal, 1e-8) << element;
  }
}

TEST(LocalRefinement, functions_are_carried_over_to_bisected_cells_as_they_are)
{
  const Case request =
    case_of(square + square_places + "[model]\nkind = \"membrane\"\nelement = \"P2\"\n[boundary]\nright = 0\n[constraint]\nlower = -1\n");
  Diagnostics         diagnostics;
  Problem<2>          problem(problem_of(request), diagnostics);
  const auto          value = [](const dealii::Point<2> &p) { return p[0] * p[0] - 3 * p[0] * p[1] + p[1]; };
  std::vector<Vector> functions = {Vector(problem.space.dof_handler.n_dofs())};
  for (const auto &node : problem.space.nodal_values())
    functions[0](node.dof) = value(node.x);
  for (unsigned level = 0; level < 3; ++level)
  {
    problem.refine(functions);
    for (const auto &node : problem.space.nodal_values())
      EXPECT_NEAR(functions[0](node.dof), value(node.x), 1e-13);
  }
}

TEST(LocalRefinement, a_study_of_meshes_compares_levels)
{
  // Without an exact solution, so that differences between levels are taken.
  const auto study_of = [](const std::string &element)
  {
    const Case  request = case_of(square + "local = [{ where = \"x < 0.4 && y < 0.7\" }]\n[model]\nkind = \"membrane\"\nelement = \"" +
                                  element + "\"\nload = 1\n[boundary]\nall = 0\n[constraint]\nupper = 9\n");
    Diagnostics diagnostics;
    Progress    progress;
    return study_mesh<2>(problem_of(request), {.n_levels = 4}, diagnostics, progress);
  };
  const auto study = study_of("Q1");
  ASSERT_EQ(study.rows.size(), 4u);
  EXPECT_GT(*study.rows[0].difference_L2 / *study.rows[1].difference_L2, 3);
  EXPECT_GT(*study.rows[1].difference_L2 / *study.rows[2].difference_L2, 3.5);
  // Levels of triangles are no refinements of each other.
  for (const auto &row : study_of("P1").rows)
    EXPECT_FALSE(row.difference_L2);
}

TEST(LocalRefinement, mistakes)
{
  const std::string rest = "[model]\nkind = \"membrane\"\nelement = \"{}\"\n[boundary]\nall = 0\n[constraint]\nlower = -1\n";
  const auto        with = [&](const std::string &local, const std::string &element = "Q1")
  { return error_of(square + "local = " + local + "\n" + fmt::format(fmt::runtime(rest), element)); };
  EXPECT_EQ(with("[{ where = \"x > 0.5\" }]"), "");
  EXPECT_NE(with("[{ where = \"x > 5\" }]").find("nothing to refine"), std::string::npos);
  EXPECT_NE(with("[{ times = 2 }]").find("does not say where"), std::string::npos);
  EXPECT_NE(with("[{ where = \"x > 0\", times = 0 }]").find("'times' must lie between 1"), std::string::npos);
  EXPECT_NE(with("[{ where = \"x > q\" }]").find("'q'"), std::string::npos);
  EXPECT_NE(with("[{ wher = \"x > 0\" }]").find("did you mean 'where'"), std::string::npos);
}
