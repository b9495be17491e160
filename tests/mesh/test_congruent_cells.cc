// Cells that are alike are integrated once, and nobody can tell.
#include "small_problem.h"

#include "unilateral/base/time_by_part.h"
#include "unilateral/case/problem_of_case.h"
#include "unilateral/discretisation/element_systems.h"
#include "unilateral/mesh/congruent_cells.h"
#include "unilateral/solve.h"
#include "unilateral/spaces/cell_points.h"

#include <deal.II/fe/fe_nothing.h>
#include <deal.II/fe/mapping_q.h>
#include <deal.II/grid/grid_generator.h>
#include <deal.II/grid/grid_tools.h>

#include <gtest/gtest.h>

#include <set>
#include <type_traits>

using namespace unilateral;

namespace
{
  template <int dim>
  std::set<unsigned> shapes_of(const dealii::Triangulation<dim> &mesh, const unsigned mapping_degree = 1)
  {
    CellShapes<dim>    shapes(mesh, dealii::MappingQ<dim>(mapping_degree));
    std::set<unsigned> found;
    for (const auto &cell : mesh.active_cell_iterators())
      found.insert(shapes(cell));
    return found;
  }

  RunResult solved(const std::string &text, const unsigned dim)
  {
    Diagnostics diagnostics;
    Progress    silent;
    return dim == 2 ? solve<2>(problem_of(case_of(text)), diagnostics, silent).result
                    : solve<3>(problem_of(case_of(text)), diagnostics, silent).result;
  }

  void expect_same(const RunResult &a, const RunResult &b)
  {
    const auto near = [](const double x, const double y, const char *const what) { EXPECT_NEAR(x, y, 1e-9 * std::abs(y)) << what; };
    near(a.energy, b.energy, "energy");
    near(a.norm_L2, b.norm_L2, "L2");
    near(a.norm_H1_semi, b.norm_H1_semi, "H1");
    near(a.discretisation_indicator, b.discretisation_indicator, "estimate");
    near(a.constraints.at(0).total_contact_force, b.constraints.at(0).total_contact_force, "force");
    if (a.max_von_mises)
      near(*a.max_von_mises, *b.max_von_mises, "stress");
    if (a.balance)
    {
      for (std::size_t c = 0; c < a.balance->load.size(); ++c)
        EXPECT_NEAR(a.balance->load[c], b.balance->load[c], 1e-12);
    }
  }
} // namespace

TEST(CellShapes, a_box_has_one_and_a_parallelogram_keeps_its_own)
{
  dealii::Triangulation<2> square;
  dealii::GridGenerator::subdivided_hyper_cube(square, 3, -1e3, 1. / 3);
  square.refine_global(4);
  EXPECT_EQ(shapes_of(square), std::set<unsigned>{0});

  dealii::Triangulation<2> sheared;
  dealii::GridGenerator::general_cell(sheared, {{0, 0}, {1, 0.2}, {0.3, 1}, {1.3, 1.2}});
  sheared.refine_global(3);
  EXPECT_EQ(shapes_of(sheared), std::set<unsigned>{0});
}

TEST(CellShapes, different_cells_are_told_apart)
{
  dealii::Triangulation<2>               rectangles;
  const std::vector<std::vector<double>> spacing = {{1., 2., 1.}, {1., 1. + 1e-9}};
  dealii::GridGenerator::subdivided_hyper_rectangle(rectangles, spacing, dealii::Point<2>(), dealii::Point<2>(4, 2 + 1e-9), false);
  EXPECT_EQ(shapes_of(rectangles).size(), 4u);

  dealii::Triangulation<2> trapezoid;
  dealii::GridGenerator::general_cell(trapezoid, {{0, 0}, {1, 0}, {0, 1}, {1, 2}});
  trapezoid.refine_global(3);
  EXPECT_GT(shapes_of(trapezoid).size(), 7u);
}

TEST(CellShapes, curved_cells_are_like_no_other)
{
  dealii::Triangulation<2> square;
  dealii::GridGenerator::hyper_cube(square);
  square.refine_global(2);
  EXPECT_EQ(shapes_of(square, 2), std::set<unsigned>{CellShapes<2>::none});
}

TEST(CellShapes, points_and_weights_are_those_of_the_mapping)
{
  dealii::Triangulation<3> mesh;
  dealii::GridGenerator::hyper_ball(mesh);
  mesh.refine_global(1);
  const dealii::QGauss<3>     rule(3);
  const dealii::FE_Nothing<3> nothing;
  for (const unsigned degree : {1u, 2u})
  {
    const dealii::MappingQ<3> mapping(degree);
    dealii::FEValues<3>       values(mapping, nothing, rule, dealii::update_quadrature_points | dealii::update_JxW_values);
    CellPoints<3>             points(mapping, nothing.reference_cell(), rule.get_points());
    CellWeights<3>            weights(mapping, mesh, nothing.reference_cell(), rule);
    for (const auto &cell : mesh.active_cell_iterators())
    {
      values.reinit(cell);
      const auto &x = points.on(cell);
      const auto &w = weights.on(cell);
      for (const unsigned q : values.quadrature_point_indices())
      {
        EXPECT_LT(x[q].distance(values.quadrature_point(q)), 1e-14);
        EXPECT_NEAR(w[q], values.JxW(q), 1e-15);
      }
    }
  }
}

// A coefficient that is constant but said as a function of x lets no two cells be alike.
TEST(CellShapes, membranes_come_out_as_cell_by_cell)
{
  for (const char *const element : {"Q1", "Q2", "Q3", "P1", "P2"})
  {
    SCOPED_TRACE(element);
    const auto text = [&](const std::string &k)
    {
      return fmt::format(
        "[mesh]\nbox = [[0, 0], [1, 2]]\ncells = 3\nrefine = 1\n[model]\nkind = \"membrane\"\nelement = \"{}\"\nload = 4\n"
        "stiffness = [{}, 0.5, 3]\n[boundary]\nleft = \"y/3\"\nright = {{ spring = 2 }}\n[constraint]\nupper = 0.9\n[method]\n"
        "epsilon = 1e-4\ntolerance = 1e-12\n",
        element, k);
    };
    expect_same(solved(text("2"), 2), solved(text("\"2 + 0*x\""), 2));
  }
}

TEST(CellShapes, bodies_come_out_as_cell_by_cell)
{
  for (const char *const element : {"Q1", "Q2", "P1"})
    for (const double poisson : {0.3, 0.48})
    {
      SCOPED_TRACE(fmt::format("{}, nu = {}", element, poisson));
      const auto text = [&](const std::string &E)
      {
        return fmt::format(
          "[mesh]\nbox = [[0, 0, 0], [1, 1.5, 1]]\ncells = 2\n[model]\nkind = \"elasticity\"\nelement = \"{}\"\nyoung = {}\n"
          "poisson = {}\nload = [0.2, 0, -1]\n[boundary]\nback = [0, 0, -0.1]\n[constraint]\non = \"front\"\ngap = 0.01\n[method]\n"
          "epsilon = 1e-4\ntolerance = 1e-12\n",
          element, E, poisson);
      };
      expect_same(solved(text("10"), 3), solved(text("\"10 + 0*x\""), 3));
    }
}

// Where only the load varies, matrices repeat and loads are summed from what repeats of them.
TEST(CellShapes, loads_that_vary_come_out_as_cell_by_cell)
{
  const auto check = [](const auto dimension, const std::string &model)
  {
    SCOPED_TRACE(model);
    constexpr int              dim = decltype(dimension)::value;
    const std::string          box = dim == 2 ? "[[0, 0], [1, 2]]" : "[[0, 0, 0], [1, 2, 1]]";
    const SmallProblem<dim>    p("[mesh]\nbox = " + box + "\ncells = 2\nrefine = 1\n[model]\n" + model +
                                 "[boundary]\nleft = 0\n[constraint]\nupper = 1\n");
    const Problem<dim>        &problem = *p.problem;
    dealii::FEValues<dim>      values(*problem.space.mapping, *problem.space.fe, problem.cell_quadrature(), cell_flags(*problem.form));
    const unsigned             n = problem.space.fe->n_dofs_per_cell();
    dealii::FullMatrix<double> matrix(n, n);
    dealii::Vector<double>     load(n);
    auto                       cell = problem.space.dof_handler.begin_active();
    double                     first = 0, largest_change = 0;
    for_each_local_system<dim>(problem,
                               [&](const LocalSystem &local)
                               {
                                 if (cell == problem.space.dof_handler.end())
                                   return;
                                 matrix = 0.;
                                 load = 0.;
                                 values.reinit(cell++);
                                 problem.form->add_cell_terms(values, matrix, load);
                                 for (unsigned i = 0; i < n; ++i)
                                   EXPECT_NEAR(local.load(i), load(i), 1e-14);
                                 if (first == 0)
                                   first = load.l2_norm();
                                 largest_change = std::max(largest_change, std::abs(load.l2_norm() - first));
                               });
    EXPECT_EQ(cell, problem.space.dof_handler.end());
    EXPECT_GT(largest_change, 1e-3);
  };
  const std::integral_constant<int, 2> plane;
  const std::integral_constant<int, 3> space;
  for (const char *const element : {"Q1", "Q3", "P2"})
    check(plane, fmt::format("kind = \"membrane\"\nelement = \"{}\"\nload = \"sin(x) + y^2\"\nstiffness = 3\n", element));
  check(space, "kind = \"membrane\"\nelement = \"Q2\"\nload = \"x*y + z\"\n");
  check(space, "kind = \"membrane\"\nelement = \"P1\"\nload = \"x*y + z\"\n");
}

TEST(TimeByPart, the_inner_part_stops_the_clock_of_the_outer_one)
{
  const auto wait = [](const double seconds)
  {
    Stopwatch watch;
    for (double waited = 0; waited < seconds;)
      waited += watch.lap();
  };
  TimeByPart times;
  {
    const auto outer = times.run("outer");
    wait(0.01);
    {
      const auto inner = times.run("inner");
      wait(0.05);
    }
    wait(0.01);
  }
  wait(0.05);
  {
    const auto again = times.run("inner");
  }
  ASSERT_EQ(times.seconds().size(), 2u);
  EXPECT_EQ(times.seconds()[0].first, "outer");
  EXPECT_GE(times.seconds()[0].second, 0.02);
  EXPECT_LT(times.seconds()[0].second, 0.05);
  EXPECT_GE(times.seconds()[1].second, 0.05);
}
