// A, H, B, W, s, f as sparse matrices, against numbers known by hand and against each other.
#include "small_problem.h"

#include "unilateral/discretisation/block_assembly.h"
#include "unilateral/evaluation/solution_errors.h"

#include <gtest/gtest.h>

#include <deal.II/lac/full_matrix.h>

#include <cmath>
#include <random>

namespace
{
  using namespace unilateral;

  std::string line(const std::string &model, const std::string &boundary, const std::string &constraint = "upper = 100")
  {
    return "[mesh]\nbox = [[0], [1]]\ncells = 8\n[model]\nkind = \"membrane\"\n" + model + "\n[boundary]\n" + boundary +
           "\n[constraint]\n" + constraint + "\n";
  }

  std::string square(const std::string &model, const std::string &boundary, const std::string &constraint = "upper = 100")
  {
    return "[mesh]\nbox = [[0, 0], [1, 1]]\ncells = 6\n[model]\nkind = \"membrane\"\n" + model + "\n[boundary]\n" + boundary +
           "\n[constraint]\n" + constraint + "\n";
  }

  Vector random_like(Vector v, const unsigned seed)
  {
    std::mt19937                           generator(seed);
    std::uniform_real_distribution<double> uniform(-1, 1);
    for (double &entry : v)
      entry = uniform(generator);
    return v;
  }

  /// A random function of V_h with zeros where Dirichlet data fix it.
  template <int dim>
  Vector random_function(const SmallProblem<dim> &p, const unsigned seed)
  {
    Vector v = random_like(p.zero_dofs(), seed);
    p.problem->space.dirichlet.set_zero(v);
    return v;
  }

  /// u with its Dirichlet values, from the solution without contact.
  template <int dim>
  Vector solve_without_contact(SmallProblem<dim> &p)
  {
    Vector            u = p.zero_dofs();
    const LinearSolve solve = p.discrete->solve_tangent(p.zero_points(), p.discrete->load(), {0, 1e-12}, u);
    EXPECT_TRUE(solve.converged) << solve.failure;
    p.problem->space.dirichlet.distribute(u);
    return u;
  }

  /// A body of 6 x 6 cells over a line.
  std::string body(const std::string &boundary, const std::string &contact = "")
  {
    return "[mesh]\nbox = [[0, 0], [1, 1]]\ncells = 6\n[model]\nkind = \"elasticity\"\nyoung = 100\npoisson = 0.3\nload = [0, "
           "-1]\n[boundary]\n" +
           boundary + "\n[constraint]\non = \"bottom\"\ngap = 0.001\n" + contact;
  }

  /// What `auto` chooses, and why.
  template <int dim>
  std::pair<std::string, std::string> chosen(const std::string &text, Assembled::Parameters parameters)
  {
    const SmallProblem<dim> p(text);
    const auto              discrete = assemble(*p.problem, p.constraint_set, parameters, false);
    return {discrete->linear_solver_name(), discrete->solver_reason()};
  }

  /// Relative distance of solve_tangent's answer from one with (A + B' D B) x = rhs, checked by multiplying.
  template <int dim>
  void expect_tangent_is_inverted(const std::string &text, const std::string &solver, const bool symmetric)
  {
    SmallProblem<dim> p(text, {{"method.solver", solver}});
    EXPECT_EQ(p.discrete->linear_solver_name(), solver);
    EXPECT_EQ(p.discrete->symmetric(), symmetric);
    std::vector<Vector> diagonals(2, p.zero_points());
    for (std::size_t i = 0; i < diagonals[0].size(); ++i)
    {
      diagonals[0](i) = i % 3 == 0 ? 50. : 0.;
      diagonals[1](i) = i % 2 == 0 ? 1e6 : 0.;
    }
    if (!p.problem->semicoercive())
      diagonals.push_back(p.zero_points());
    for (const Vector &d : diagonals)
    {
      const Vector exact = random_function(p, 3);
      Vector       rhs = p.zero_dofs(), work = p.zero_dofs(), trace = p.zero_points();
      p.discrete->apply_stiffness(rhs, exact);
      p.discrete->apply_trace(trace, exact);
      for (std::size_t i = 0; i < d.size(); ++i)
        trace(i) *= d(i) / p.discrete->weights()(i);
      p.discrete->apply_trace_transpose(work, trace);
      rhs += work;
      Vector            x = p.zero_dofs();
      const LinearSolve solve = p.discrete->solve_tangent(d, rhs, {0, 1e-11}, x);
      EXPECT_TRUE(solve.converged) << solver << ": " << solve.failure;
      x -= exact;
      EXPECT_LT(x.l2_norm(), 1e-8 * exact.l2_norm()) << solver;
      EXPECT_EQ(solve.iterations == 0, solver == "direct");
    }
  }

  /// assemble_blocks() against the matrix and load that deal.II makes of the same cells.
  template <int dim>
  void expect_blocks_are_those_of_rows(const std::string &text, const unsigned unknowns_of_block)
  {
    const SmallProblem<dim>      p(text);
    const auto                  &dirichlet = p.problem->space.dirichlet;
    const auto                  &rows = p.discrete->stiffness_matrix();
    dealii::Vector<double>       load(rows.m());
    const unsigned               b = block_size(*p.problem);
    SymmetricBlockMatrix         blocks = assemble_blocks(*p.problem, b, Volumes::included, load);
    dealii::SparsityPattern      pattern;
    dealii::SparseMatrix<double> matrix;
    EXPECT_EQ(b, unknowns_of_block);
    blocks.copy_to(pattern, matrix);
    dirichlet.set_zero(load);
    const double size = rows.linfty_norm();
    for (std::size_t i = 0; i < rows.m(); ++i)
    {
      EXPECT_NEAR(load(i), p.discrete->load()(i), 1e-12 * p.discrete->load().linfty_norm());
      for (auto entry = rows.begin(i); entry != rows.end(i); ++entry)
        if (!dirichlet.is_constrained(i))
        {
          EXPECT_NEAR(matrix.el(i, entry->column()), entry->value(), 1e-12 * size);
        }
      for (auto entry = matrix.begin(i); entry != matrix.end(i); ++entry)
        if (entry->column() != i && dirichlet.is_constrained(i))
        {
          EXPECT_EQ(entry->value(), 0);
        }
        else
        {
          EXPECT_NEAR(rows.el(i, entry->column()), entry->value(), dirichlet.is_constrained(i) ? size : 1e-12 * size);
        }
      EXPECT_GT(matrix.diag_element(i), 0);
    }
  }
} // namespace

TEST(Assembled, blocks_hold_what_rows_do)
{
  const std::string steel = "[model]\nkind = \"elasticity\"\nyoung = 100\npoisson = 0.3\nload = [1, -1]\n",
                    contact = "[constraint]\non = \"bottom\"\ngap = 0.1\n";
  expect_blocks_are_those_of_rows<2>(square("load = \"1 + x\"", "left = \"y\"\nright = { flux = 1, spring = 3 }"), 1);
  // Hanging nodes, prescribed displacements that are not zero, a rigid platen, a smooth guide that slopes.
  expect_blocks_are_those_of_rows<2>("[mesh]\nbox = [[0, 0], [1, 1]]\ncells = 4\nlocal = [{ where = \"x > 0.3 && y > 0.6\" }]\n" + steel +
                                       "element = \"Q2\"\n[boundary]\ntop = { x = 0.1, y = \"-x\" }\nright = { spring = [1, 2] }\n" +
                                       contact,
                                     2);
  expect_blocks_are_those_of_rows<2>("[mesh]\nbox = [[0, 0], [1, 1]]\ncells = 3\n" + steel +
                                       "element = \"P2\"\n[boundary]\ntop = { rigid = true, force = [0, -1] }\nleft = { x = 0 }\n" +
                                       contact,
                                     2);
  expect_blocks_are_those_of_rows<2>(
    "[mesh]\nshell = { center = [0, 0] }\n" + steel +
      "[boundary]\ninner = \"symmetry\"\nouter = { spring = 1 }\n[constraint]\non = \"outer\"\ngap = 0.1\n",
    2);
}

TEST(Assembled, stencil_of_the_string)
{
  const SmallProblem<1> p(line("stiffness = 3\nload = 2", "all = 0"));
  const auto           &A = p.discrete->stiffness_matrix();
  const double          h = 1. / 8;
  EXPECT_TRUE(p.discrete->symmetric());
  ASSERT_EQ(A.m(), 9u);
  for (std::size_t i = 0; i < 9; ++i)
  {
    if (p.problem->space.dirichlet.is_constrained(i))
    {
      EXPECT_EQ(p.discrete->load()(i), 0);
      EXPECT_EQ(p.discrete->stiffness_diagonal()(i), A.diag_element(i));
      continue;
    }
    EXPECT_NEAR(A.diag_element(i), 2 * 3 / h, 1e-12);
    EXPECT_NEAR(p.discrete->stiffness_diagonal()(i), 2 * 3 / h, 1e-12);
    EXPECT_NEAR(p.discrete->load()(i), 2 * h, 1e-14);
    double row_sum = 0;
    for (auto entry = A.begin(i); entry != A.end(i); ++entry)
    {
      row_sum += entry->value();
      if (entry->column() != i)
      {
        EXPECT_TRUE(std::abs(entry->value()) < 1e-14 || std::abs(entry->value() + 3 / h) < 1e-12);
      }
      if (p.problem->space.dirichlet.is_constrained(entry->column()))
      {
        EXPECT_EQ(entry->value(), 0);
      }
    }
    EXPECT_GE(row_sum, -1e-12);
  }
  // w = h, B = I, tau = h / (2 k / h)
  for (std::size_t i = 0; i < p.constraint_set.size(); ++i)
  {
    EXPECT_NEAR(p.discrete->weights()(i), h, 1e-15);
    EXPECT_NEAR(p.discrete->compliance()(i), h * h / (2 * 3), 1e-15);
  }
}

TEST(Assembled, reaction_and_velocity)
{
  const SmallProblem<1> plain(line("stiffness = 1", "left = 0"));
  const SmallProblem<1> p(line("stiffness = 1\nvelocity = [5]\nreaction = 7", "left = 0"));
  EXPECT_FALSE(p.discrete->symmetric());
  const SmallProblem<1> still(line("stiffness = 1\nvelocity = [0]\nreaction = 7", "left = 0"));
  EXPECT_TRUE(still.discrete->symmetric());
  // On a row inside: k [-1 2 -1]/h + b [-1 0 1]/2 + c h [1 4 1]/6. For u = x: b + c x integrated against a hat function.
  Vector x = p.zero_dofs(), Ax = p.zero_dofs();
  for (std::size_t i = 0; i < p.constraint_set.size(); ++i)
    x(p.constraint_set.trace[i].dofs[0]) = p.constraint_set.points[i].x[0];
  p.discrete->apply_stiffness(Ax, x);
  for (std::size_t i = 0; i < p.constraint_set.size(); ++i)
    if (const double xi = p.constraint_set.points[i].x[0]; xi < 0.99)
    {
      EXPECT_NEAR(Ax(p.constraint_set.trace[i].dofs[0]), (5 + 7 * xi) / 8, 1e-12);
    }
}

TEST(Assembled, flux_and_spring_at_the_ends)
{
  // -u'' = 0, u(0) = 0, u'(1) = 3 - 2 u(1): u = x.
  SmallProblem<1> p(line("stiffness = 1", "left = 0\nright = { flux = 3, spring = 2 }"));
  const Vector    u = solve_without_contact(p);
  for (std::size_t i = 0; i < p.constraint_set.size(); ++i)
    EXPECT_NEAR(u(p.constraint_set.trace[i].dofs[0]), p.constraint_set.points[i].x[0], 1e-13);
  // u(0) = 5 and u' = -1 on the right
  SmallProblem<1> q(line("stiffness = 2\nelement = \"Q3\"", "left = 5\nright = { flux = -2 }"));
  const Vector    v = solve_without_contact(q);
  const auto      values = q.constraint_set.values_of(v);
  for (std::size_t i = 0; i < values.size(); ++i)
    EXPECT_NEAR(values[i], 5 - q.constraint_set.points[i].x[0], 1e-12);
}

TEST(Assembled, flux_and_spring_on_sides_and_faces)
{
  // u = 1 + x + 2 y solves -Laplace u = 0: fluxes -1, 1, and at the top 2 = flux - 4 u.
  for (const std::string element : {"Q1", "Q2", "P1", "P2", "P3"})
  {
    SmallProblem<2> p(
      square("element = \"" + element + "\"",
             "bottom = \"1 + x\"\nleft = { flux = -1 }\nright = { flux = 1 }\ntop = { flux = \"2 + 4*(3 + x)\", spring = 4 }"));
    const auto values = p.constraint_set.values_of(solve_without_contact(p));
    for (std::size_t i = 0; i < values.size(); ++i)
      EXPECT_NEAR(values[i], 1 + p.constraint_set.points[i].x[0] + 2 * p.constraint_set.points[i].x[1], 1e-11) << element;
  }
  for (const std::string element : {"Q1", "P1", "P2", "P3"})
  {
    SmallProblem<3> p("[mesh]\nbox = [[0, 0, 0], [1, 1, 1]]\ncells = 2\n[model]\nkind = \"membrane\"\nelement = \"" + element +
                      "\"\n[boundary]\nall = { flux = 0 }\nleft = 0\nright = { flux = 1 }\n[constraint]\nupper = 100\n");
    const auto      values = p.constraint_set.values_of(solve_without_contact(p));
    for (std::size_t i = 0; i < values.size(); ++i)
      EXPECT_NEAR(values[i], p.constraint_set.points[i].x[0], 1e-11) << element;
  }
}

TEST(Assembled, dirichlet_data_are_lifted)
{
  // u = 1 + 2 x - 3 y + x y with -Laplace u = 0 is in Q1; rows that see fixed nodes move their part into s.
  SmallProblem<2> p(square("", "all = \"1 + 2*x - 3*y + x*y\"", "upper = 100\nlower = -100\nquadrature = \"gauss(2)\""));
  const Vector    u = solve_without_contact(p);
  Vector          eliminated = u, trace = p.zero_points();
  p.problem->space.dirichlet.set_zero(eliminated);
  p.discrete->apply_trace(trace, eliminated);
  for (std::size_t i = 0; i < p.constraint_set.size(); ++i)
  {
    const auto  &x = p.constraint_set.points[i].x;
    const double value = 1 + 2 * x[0] - 3 * x[1] + x[0] * x[1];
    // Bu - s = sign (u - bound)
    EXPECT_NEAR(trace(i) - p.discrete->obstacle()(i), p.constraint_set.points[i].sign * (value - p.constraint_set.points[i].bound), 1e-11);
  }
}

TEST(Assembled, trace_and_its_transpose_are_adjoint_in_the_weights)
{
  for (const std::string rule : {"nodal", "gauss(2)", "simpson"})
  {
    const SmallProblem<2> p(square("element = \"Q2\"", "left = 0", "lower = -1\nupper = \"1 + x\"\nquadrature = \"" + rule + "\""));
    const Vector          v = random_function(p, 1), q = random_like(p.zero_points(), 2);
    Vector                Bv = p.zero_points(), BtWq = p.zero_dofs();
    p.discrete->apply_trace(Bv, v);
    p.discrete->apply_trace_transpose(BtWq, q);
    EXPECT_NEAR(BtWq * v, pairing(*p.discrete, q, Bv), 1e-13) << rule;
    Vector fixed = BtWq;
    p.problem->space.dirichlet.set_zero(fixed);
    fixed -= BtWq;
    EXPECT_EQ(fixed.linfty_norm(), 0) << "no force on what is fixed";
  }
}

TEST(Assembled, compliance_is_the_diagonal_of_the_weighted_trace)
{
  const SmallProblem<2> p(square("element = \"Q2\"\nstiffness = \"1 + x\"", "left = 0", "upper = 1\nquadrature = \"gauss(2)\""));
  for (const std::size_t i : {std::size_t(0), std::size_t(17), p.constraint_set.size() - 1})
  {
    Vector e = p.zero_points(), force = p.zero_dofs();
    e(i) = 1;
    p.discrete->apply_trace_transpose(force, e);
    for (std::size_t j = 0; j < force.size(); ++j)
      force(j) /= p.discrete->stiffness_diagonal()(j);
    Vector displacement = p.zero_points();
    p.discrete->apply_trace(displacement, force);
    EXPECT_NEAR(displacement(i) / p.discrete->compliance()(i), 1, 1e-12);
  }
}

TEST(Assembled, tangent_is_inverted_by_every_solver)
{
  for (const std::string solver : {"direct", "amg"})
  {
    expect_tangent_is_inverted<2>(square("element = \"Q1\"", "all = 0"), solver, true);
    expect_tangent_is_inverted<2>(square("element = \"Q2\"", "left = 1", "upper = 5\nquadrature = \"gauss(2)\""), solver, true);
    expect_tangent_is_inverted<2>(square("element = \"P2\"", "all = 0", "lower = -5\nupper = 5"), solver, true);
    expect_tangent_is_inverted<2>(square("element = \"Q1\"\nvelocity = [20, \"-10*x\"]\nreaction = 1", "all = 0"), solver, false);
    expect_tangent_is_inverted<2>(square("element = \"P1\"\nvelocity = [3, 1]", "left = 0", "upper = 5\nquadrature = \"gauss(2)\""), solver,
                                  false);
    for (const std::string rule : {"", "quadrature = \"gauss(2)\""})
      for (const std::string boundary : {"top = [0, 0]", "left = \"symmetry\""}) // the second is held by contact alone
        expect_tangent_is_inverted<2>(body(boundary, rule), solver, true);
  }
}

TEST(Assembled, auto_factorises_once_where_that_is_predicted_to_be_quick)
{
  const std::string     held = body("top = [0, 0]"), membrane = square("", "all = 0");
  Assembled::Parameters parameters{.direct_limit_2d = 10};
  EXPECT_EQ(chosen<2>(held, parameters).first, "direct");
  EXPECT_EQ(chosen<2>(held, parameters).second.find("one factorisation for all contact sets ("), 0u);
  EXPECT_EQ(chosen<2>(membrane, parameters).first, "amg");
  for (const auto &too_much : {Assembled::Parameters{.direct_limit_2d = 10, .operations_per_entry = 1},
                               Assembled::Parameters{.direct_limit_2d = 10, .part_of_memory = 1e-12},
                               Assembled::Parameters{.direct_limit_2d = 10, .order_limit_2d = 50}})
    EXPECT_EQ(chosen<2>(held, too_much).first, "amg");
  EXPECT_EQ(chosen<2>(held, {}), std::pair(std::string("direct"), std::string("the quickest at this size")));
  EXPECT_EQ(chosen<1>(line("", "all = 0"), {.direct_limit_2d = 0, .direct_limit_3d = 0}).first, "direct");
  EXPECT_EQ(chosen<1>(line("", "all = 0"), {.solver = Method::Solver::amg}).first, "amg");
}

/// Nearly incompressible bodies: what an iteration keeps apart is what a factorisation has in its matrix.
TEST(Assembled, volumes_apart_are_those_included)
{
  for (const std::string element : {"P1", "P2", "Q1", "Q2", "Q3"})
    for (const std::string boundary : {"left = [0.02, 0.01]", "left = \"symmetry\"\ntop = { rigid = true }", "top = { rigid = true }"})
    {
      const std::vector<Override> nearly_incompressible = {{"model.poisson", "0.4999"}, {"model.element", "\"" + element + "\""}};
      auto                        included = nearly_incompressible, apart = nearly_incompressible;
      included.push_back({"method.solver", "\"direct\""});
      apart.push_back({"method.solver", "\"amg\""});
      SmallProblem<2> p(body(boundary), included), q(body(boundary), apart);
      EXPECT_NE(q.discrete->solver_reason().find("tension"), std::string::npos);

      const Vector u = random_function(p, 3);
      Vector       Au = p.zero_dofs(), of_q = p.zero_dofs();
      p.discrete->apply_stiffness(Au, u);
      q.discrete->apply_stiffness(of_q, u);
      of_q -= Au;
      EXPECT_LE(of_q.linfty_norm(), 1e-12 * Au.linfty_norm());
      for (const auto vector : {&DiscreteProblem::load, &DiscreteProblem::stiffness_diagonal, &DiscreteProblem::compliance})
      {
        const Vector &of_p = (p.discrete.get()->*vector)();
        Vector        difference((q.discrete.get()->*vector)());
        difference -= of_p;
        if (difference.size() == u.size())
          p.problem->space.dirichlet.set_zero(difference);
        EXPECT_LE(difference.linfty_norm(), 1e-12 * of_p.linfty_norm());
      }

      // Held by every point of contact.
      Vector d = p.zero_points(), x = p.zero_dofs(), y = p.zero_dofs();
      for (std::size_t i = 0; i < d.size(); ++i)
        d(i) = p.discrete->weights()(i) / p.discrete->compliance()(i);
      ASSERT_TRUE(p.discrete->solve_tangent(d, Au, {0, 0}, x).converged);
      const LinearSolve solve = q.discrete->solve_tangent(d, Au, {0, 1e-9}, y);
      ASSERT_TRUE(solve.converged) << solve.failure;
      y -= x;
      EXPECT_LE(y.linfty_norm(), 1e-6 * x.linfty_norm());
    }
}

TEST(Assembled, volumes_are_apart_where_a_factorisation_takes_too_much)
{
  const auto of_limits = [](const Assembled::Parameters &parameters)
  {
    const SmallProblem<2> p(body("top = [0, 0]"), {{"model.poisson", "0.4999"}, {"model.element", "\"P2\""}});
    const auto            discrete = assemble(*p.problem, p.constraint_set, parameters, false);
    return std::pair(discrete->linear_solver_name(), discrete->solver_reason().find("tension") != std::string::npos);
  };
  EXPECT_EQ(of_limits({}), std::pair(std::string("direct"), false));
  EXPECT_EQ(of_limits({.volumes_limit_2d = 50}), std::pair(std::string("amg"), true));
  // Found out after the matrix has been assembled with them.
  EXPECT_EQ(of_limits({.direct_limit_2d = 10, .operations_per_entry = 1e-3}), std::pair(std::string("amg"), true));
}

TEST(Assembled, the_pressure_by_one_factorisation_is_that_of_the_solution)
{
  for (const std::string rule : {"", "quadrature = \"gauss(2)\""})
    for (const double epsilon : {0., 1e-3})
    {
      SmallProblem<2> p(body("top = [0, -0.02]\nleft = \"symmetry\"", rule), {{"method.solver", "\"direct\""}});
      Vector          u = p.zero_dofs(), lambda = p.zero_points(), rest = p.zero_dofs(), contact = p.zero_dofs();
      ASSERT_TRUE(p.discrete->solve_for_pressure(epsilon, u, lambda));
      EXPECT_GT(contact_force(*p.discrete, lambda), 0);
      const ComplementarityResidual residual = complementarity_residual(*p.discrete, epsilon, u, lambda);
      EXPECT_LE(residual.norm, 1e-9 * residual.lambda_norm);
      p.discrete->apply_stiffness(rest, u);
      p.discrete->apply_trace_transpose(contact, lambda);
      rest += contact;
      rest -= p.discrete->load();
      EXPECT_LE(rest.linfty_norm(), 1e-10 * contact.linfty_norm());
    }
  SmallProblem<2> held_by_contact(body("left = \"symmetry\"", ""), {{"method.solver", "\"direct\""}});
  Vector          u = held_by_contact.zero_dofs(), lambda = held_by_contact.zero_points();
  EXPECT_FALSE(held_by_contact.discrete->solve_for_pressure(0, u, lambda));
}

TEST(Assembled, without_anything_that_holds_it_the_matrix_is_singular)
{
  SmallProblem<1> p(line("load = 1", "", "upper = 0"));
  EXPECT_TRUE(p.problem->semicoercive());
  Vector one = p.zero_dofs(), A_one = p.zero_dofs();
  one = 1.;
  p.discrete->apply_stiffness(A_one, one);
  EXPECT_LT(A_one.linfty_norm(), 1e-13);
}

TEST(Assembled, gram_matrix_is_the_full_inner_product)
{
  // (1, 1)_1 = 1, (x, x)_1 = 1 + 1/3, (x, 1)_1 = 1/2, (x^2, x^2)_1 = 4/3 + 1/5
  const SmallProblem<1> p(line("element = \"Q2\"\nstiffness = 9", "all = { spring = 1 }"), {}, /*with_gram=*/true);
  ASSERT_TRUE(p.discrete->has_gram());
  Vector one = p.zero_dofs(), x = p.zero_dofs(), xx = p.zero_dofs(), H = p.zero_dofs();
  for (std::size_t i = 0; i < p.constraint_set.size(); ++i)
  {
    const auto   dof = p.constraint_set.trace[i].dofs[0];
    const double xi = p.constraint_set.points[i].x[0];
    one(dof) = 1;
    x(dof) = xi;
    xx(dof) = xi * xi;
  }
  p.discrete->apply_gram(H, one);
  EXPECT_NEAR(H * one, 1, 1e-13);
  EXPECT_NEAR(H * x, 0.5, 1e-13);
  p.discrete->apply_gram(H, x);
  EXPECT_NEAR(H * x, 4. / 3, 1e-13);
  p.discrete->apply_gram(H, xx);
  EXPECT_NEAR(H * xx, 4. / 3 + 1. / 5, 1e-13);
  EXPECT_FALSE(SmallProblem<1>(line("", "all = 0")).discrete->has_gram());
}

TEST(Assembled, coefficients_by_region)
{
  // -(k u')' = 0 on (1, 3), k = 4 left of 2 and 1 right of it, u(1) = 0, u(3) = 1: slopes 1/5 and 4/5.
  const std::string file = "[mesh]\nfile = \"" PROJECT_DIR "/tests/data/segments-22.msh\"\n";
  SmallProblem<1> p(file + "[model]\nkind = \"membrane\"\n[[material]]\nregion = \"fine\"\nstiffness = 4\n[boundary]\nstart = 0\nend = 1\n"
                           "[constraint]\nupper = 100\n");
  const auto      values = p.constraint_set.values_of(solve_without_contact(p));
  ASSERT_GT(values.size(), 4u);
  for (std::size_t i = 0; i < values.size(); ++i)
  {
    const double x = p.constraint_set.points[i].x[0];
    EXPECT_NEAR(values[i], x < 2 ? (x - 1) / 5 : 0.2 + 0.8 * (x - 2), 1e-13);
  }
  // What a region does not say is that of [model]: the load is 3 on all of it, but 5 on the coarse part, whose k stays 1.
  SmallProblem<1> q(file + "[model]\nkind = \"membrane\"\nload = 3\n[[material]]\nregion = \"coarse\"\nload = 5\nreaction = 2\n"
                           "[boundary]\nstart = { spring = 1 }\n[constraint]\nupper = 100\n");
  double          total = 0;
  for (const double f : q.discrete->load())
    total += f;
  EXPECT_NEAR(total, 3 + 5, 1e-12);
  Vector one = q.zero_dofs(), A_one = q.zero_dofs();
  one = 1.;
  q.discrete->apply_stiffness(A_one, one);
  EXPECT_NEAR(A_one * one, 2 * 1 + 1, 1e-12);
}

// -div(K grad u) = f with K = [[1 + x, x y], [x y, 2 + y]], u = sin(pi x) y (1 - y) and no contact.
TEST(Assembled, variable_tensor_converges_with_the_order_of_the_element)
{
  const std::string text = R"toml([parameters]
ux = "pi*cos(pi*x)*y*(1 - y)"
uy = "sin(pi*x)*(1 - 2*y)"
uxx = "-pi^2*sin(pi*x)*y*(1 - y)"
uxy = "pi*cos(pi*x)*(1 - 2*y)"
uyy = "-2*sin(pi*x)"
[mesh]
box = [[0, 0], [1, 1]]
cells = 4
[model]
kind = "membrane"
stiffness = ["1 + x", "x*y", "2 + y"]
load = "-(ux + (1 + x)*uxx + y*uy + x*y*uxy + x*ux + x*y*uxy + uy + (2 + y)*uyy)"
[boundary]
all = 0
[constraint]
upper = 100
[exact]
u = "sin(pi*x)*y*(1 - y)"
)toml";
  for (const auto &[element, order] :
       {std::pair("Q1", 1), std::pair("Q2", 2), std::pair("Q3", 3), std::pair("P1", 1), std::pair("P2", 2), std::pair("P3", 3)})
  {
    double last_L2 = 0, last_H1 = 0;
    for (const char *const refine : {"1", "2"})
    {
      SmallProblem<2> p(text, {{"mesh.refine", refine}, {"model.element", element}});
      const Vector    u = solve_without_contact(p);
      const Errors    errors = solution_errors(*p.problem, p.constraint_set, u, p.zero_points());
      if (last_H1 > 0)
      {
        EXPECT_GT(std::log2(last_H1 / *errors.H1_semi), order - 0.1) << element;
        EXPECT_GT(std::log2(last_L2 / *errors.L2), order + 0.9) << element;
      }
      last_H1 = *errors.H1_semi;
      last_L2 = *errors.L2;
    }
    EXPECT_LT(last_H1, 0.2) << element;
  }
}

TEST(Assembled, tensor_in_space)
{
  // K constant, u linear in one direction and K grad u known: u = x + 2 y - z on the boundary is the solution inside.
  SmallProblem<3> p("[mesh]\nbox = [[0, 0, 0], [1, 2, 1]]\ncells = 2\n[model]\nkind = \"membrane\"\nstiffness = [3, 1, 0.5, 4, -1, 5]\n"
                    "[boundary]\nall = \"x + 2*y - z\"\nright = { flux = \"3*1 + 1*2 + 0.5*(-1)\" }\n"
                    "top = { flux = \"1*1 + 4*2 - 1*(-1)\" }\nback = { flux = \"0.5*1 - 1*2 + 5*(-1)\" }\n[constraint]\nupper = 100\n");
  const auto      values = p.constraint_set.values_of(solve_without_contact(p));
  for (std::size_t i = 0; i < values.size(); ++i)
  {
    const auto &x = p.constraint_set.points[i].x;
    EXPECT_NEAR(values[i], x[0] + 2 * x[1] - x[2], 1e-12);
  }
}

TEST(Assembled, the_tangent_is_kept_for_the_same_diagonal)
{
  SmallProblem<2> p(square("load = 1", "all = 0"), {{"method.solver", "direct"}});
  Vector          d = p.zero_points(), x = p.zero_dofs();
  p.discrete->solve_tangent(d, p.discrete->load(), {0, 1e-12}, x);
  const Vector free = x;
  d = 1e3;
  x = 0.;
  p.discrete->solve_tangent(d, p.discrete->load(), {0, 1e-12}, x);
  EXPECT_LT(x.l2_norm(), 0.1 * free.l2_norm());
  d = 0.;
  x = 0.;
  p.discrete->solve_tangent(d, p.discrete->load(), {0, 1e-12}, x);
  x -= free;
  EXPECT_LT(x.l2_norm(), 1e-12 * free.l2_norm());
}
