// Penalty and mixed method through one solver: limits, bounds, degenerate and badly held problems.
#include "small_problem.h"

#include "unilateral/case/problem_of_case.h"
#include "unilateral/nested_iteration.h"
#include "unilateral/solve.h"

#include <gtest/gtest.h>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace
{
  using namespace unilateral;

  struct Outcome
  {
    MultiplierResult result;
    Vector           u, lambda;
    double           force = 0, energy = 0;
  };

  /// A cold start from u = @p start, or zero.
  Outcome solve_at(DiscreteProblem &discrete, const double epsilon, const Vector *start = nullptr, const bool only_contact_holds_it = false)
  {
    Outcome outcome;
    discrete.initialize_dof_vector(outcome.u);
    discrete.initialize_point_vector(outcome.lambda);
    if (start)
      outcome.u = *start;
    Progress                   progress;
    const MultiplierParameters parameters{.epsilon = epsilon, .tolerance = 1e-10};
    const std::vector<bool>    predicted(only_contact_holds_it ? outcome.lambda.size() : 0, true);
    outcome.result = method_of_multipliers(discrete, parameters, predicted, outcome.u, outcome.lambda, progress);
    EXPECT_TRUE(outcome.result.converged) << "epsilon " << epsilon << ": " << outcome.result.reason;
    outcome.force = contact_force(discrete, outcome.lambda);
    outcome.energy = energy_of(discrete, outcome.u);
    return outcome;
  }

  double relative_difference(const Vector &a, const Vector &b)
  {
    Vector difference = a;
    difference -= b;
    return difference.linfty_norm() / b.linfty_norm();
  }

  std::string string_under_ceiling(const unsigned cells, const std::string &element = "Q1", const std::string &rule = "nodal")
  {
    return fmt::format(
      "[mesh]\nbox = [[0], [1]]\ncells = {}\n[model]\nkind = \"membrane\"\nload = 1\nelement = \"{}\"\n[boundary]\nall = 0\n"
      "[constraint]\nupper = \"1/18\"\nquadrature = \"{}\"\n",
      cells, element, rule);
  }

  std::string string_over_parabola(const unsigned cells)
  {
    return fmt::format("[mesh]\nbox = [[-1], [1]]\ncells = {}\n[model]\nkind = \"membrane\"\n[boundary]\nall = 0\n"
                       "[constraint]\nlower = \"1/2 - 2*x^2\"\n",
                       cells);
  }

  std::string membrane_over_ball(const unsigned cells, const std::string &rule = "nodal")
  {
    return fmt::format(
      "[parameters]\nr = \"sqrt(x^2 + y^2)\"\n[mesh]\nbox = [[-2, -2], [2, 2]]\ncells = {}\n[model]\nkind = \"membrane\"\n[boundary]\n"
      "all = \"0.6802594118917169*log(2/r)\"\n[constraint]\n"
      "lower = \"if(r < 0.9, sqrt(1 - min(r, 0.9)^2), sqrt(0.19) - 0.9/sqrt(0.19)*(r - 0.9))\"\nquadrature = \"{}\"\n",
      cells, rule);
  }

  const std::vector<double> epsilons = {1, 1e-1, 1e-2, 1e-3, 1e-4, 1e-5, 1e-6, 1e-8, 1e-10, 1e-12, 1e-14};

  void expect_limits(DiscreteProblem &discrete)
  {
    const Outcome mixed = solve_at(discrete, 0);
    double        last_force = 0, last_pressure_norm = 0, last_distance = 1e300;
    for (const double epsilon : epsilons)
    {
      const Outcome penalty = solve_at(discrete, epsilon);
      EXPECT_LE(penalty.result.history.size(), 150u) << "epsilon " << epsilon;
      // ||p_eps|| <= ||p_h||, and both it and the total force grow as epsilon falls; u_eps comes nearer in the energy norm.
      const double pressure_norm = std::sqrt(pairing(discrete, penalty.lambda, penalty.lambda));
      EXPECT_GE(penalty.force, last_force * (1 - 1e-8)) << "epsilon " << epsilon;
      EXPECT_GE(pressure_norm, last_pressure_norm * (1 - 1e-8)) << "epsilon " << epsilon;
      EXPECT_LE(pressure_norm, std::sqrt(pairing(discrete, mixed.lambda, mixed.lambda)) * (1 + 1e-8)) << "epsilon " << epsilon;
      EXPECT_LE(penalty.energy, mixed.energy + 1e-9 * std::abs(mixed.energy)) << "K_h is a part of V_h: the penalised minimum is lower";
      Vector difference = penalty.u;
      difference -= mixed.u;
      const double distance = energy_norm(discrete, difference);
      if (epsilon > 1e-9)
      {
        EXPECT_LT(distance, last_distance);
      }
      last_force = penalty.force;
      last_pressure_norm = pressure_norm;
      last_distance = distance;
    }
    const Outcome tiny = solve_at(discrete, 1e-14);
    EXPECT_LT(relative_difference(tiny.lambda, mixed.lambda), 1e-8);
    EXPECT_NEAR(tiny.force / mixed.force, 1, 1e-8);
    EXPECT_NEAR(tiny.energy / mixed.energy, 1, 1e-9);
  }

  /// Rules with a kernel (C_h = 0): the pressure is not unique, but every epsilon is solved, and the force is right.
  void expect_convergence_at_every_epsilon(DiscreteProblem &discrete, const double force, const double tolerance)
  {
    for (const double epsilon : epsilons)
    {
      const Outcome outcome = solve_at(discrete, epsilon);
      EXPECT_LE(outcome.result.history.size(), 150u) << "epsilon " << epsilon;
      EXPECT_LE(outcome.result.complementarity, 1e-8) << "epsilon " << epsilon;
      EXPECT_LE(outcome.result.equilibrium, 1e-8) << "epsilon " << epsilon;
      if (epsilon <= 1e-6)
      {
        EXPECT_NEAR(outcome.force / force, 1, tolerance) << "epsilon " << epsilon;
      }
    }
    EXPECT_NEAR(solve_at(discrete, 0).force / force, 1, tolerance);
  }
} // namespace

TEST(MethodOfMultipliers, epsilon_to_zero_in_one_dimension)
{
  for (const unsigned cells : {100u, 400u})
  {
    SmallProblem<1> ceiling(string_under_ceiling(cells)), parabola(string_over_parabola(cells)),
      quadratic(string_under_ceiling(cells, "Q2"));
    expect_limits(*ceiling.discrete);
    expect_limits(*parabola.discrete);
    expect_limits(*quadratic.discrete);
  }
}

TEST(MethodOfMultipliers, epsilon_to_zero_in_two_dimensions)
{
  SmallProblem<2> p(membrane_over_ball(64));
  expect_limits(*p.discrete);
}

TEST(MethodOfMultipliers, rules_with_a_kernel_converge_at_every_epsilon)
{
  SmallProblem<1> linear(string_under_ceiling(100, "Q1", "gauss(2)")), quadratic(string_under_ceiling(100, "Q2", "gauss(3)"));
  expect_convergence_at_every_epsilon(*linear.discrete, 1. / 3, 3e-3);
  expect_convergence_at_every_epsilon(*quadratic.discrete, 1. / 3, 3e-3);
}

TEST(MethodOfMultipliers, a_kernel_in_two_dimensions)
{
  SmallProblem<2> p(membrane_over_ball(32, "gauss(2)"));
  expect_convergence_at_every_epsilon(*p.discrete, 4.274195941868662, 2e-2);
}

// T-4: the discrete problem with the vertex rule.
TEST(MethodOfMultipliers, known_discrete_values)
{
  struct Known
  {
    unsigned cells;
    double   force, energy;
  };
  for (const Known known :
       {Known{64, 0.3332506614, -0.030857474155}, {256, 0.3333282271, -0.030863774593}, {1024, 0.3333330151, -0.030864171054}})
  {
    SmallProblem<1> p(string_under_ceiling(known.cells));
    const Outcome   mixed = solve_at(*p.discrete, 0);
    EXPECT_NEAR(mixed.force, known.force, 1e-10) << known.cells;
    EXPECT_NEAR(mixed.energy, known.energy, 1e-12) << known.cells;
  }
}

// The smaller the mesh, the smaller the shift R that carries the last digit of u into lambda: it must not stay there. Contact inside
// |x - 1/2| < 1/6 is pressed by lambda = f = 1.
TEST(MethodOfMultipliers, pressure_keeps_its_digits_on_fine_meshes)
{
  SmallProblem<1>   p(string_under_ceiling(30000));
  Vector            u = p.zero_dofs(), lambda = p.zero_points();
  std::vector<bool> predicted(lambda.size());
  for (std::size_t i = 0; i < lambda.size(); ++i)
    predicted[i] = std::abs(p.constraint_set.points[i].x[0] - 0.5) < 1. / 6;
  Progress               progress;
  const MultiplierResult result = method_of_multipliers(*p.discrete, {.epsilon = 0, .tolerance = 1e-8}, predicted, u, lambda, progress);
  EXPECT_TRUE(result.converged) << result.reason;
  EXPECT_LE(result.outer_iterations, 10u);
  for (std::size_t i = 0; i < lambda.size(); ++i)
  {
    if (std::abs(p.constraint_set.points[i].x[0] - 0.5) < 0.16)
    {
      ASSERT_NEAR(lambda(i), 1, 1e-7);
    }
  }
}

TEST(MethodOfMultipliers, polishing_that_comes_to_nothing_does_not_cost_the_tolerance)
{
  for (const unsigned steps : {1u, 2u, 10u})
    for (const double height : {0., 1000.})
    {
      SmallProblem<1> p(
        fmt::format("[mesh]\nbox = [[0], [1]]\ncells = 1000\n[model]\nkind = \"membrane\"\nload = 1\n[boundary]\nall = {0}\n"
                    "[constraint]\nupper = \"{0} + 1/18\"\n",
                    height));
      Vector                 u = p.zero_dofs(), lambda = p.zero_points();
      Progress               progress;
      const MultiplierResult result = method_of_multipliers(
        *p.discrete, {.tolerance = 1e-9, .polishing_steps = steps, .max_newton_steps = 2000}, {}, u, lambda, progress);
      EXPECT_TRUE(result.converged) << result.reason;
      const auto residual = complementarity_residual(*p.discrete, 0, u, lambda);
      EXPECT_LE(residual.norm, std::max(1e-9 * residual.lambda_norm, 4 * residual.round_off)) << steps << " steps at " << height;
    }
}

// T-3: P1 with the vertex rule and an M-matrix: 0 <= u_eps - u_h <= eps max |p_h| at every node.
TEST(MethodOfMultipliers, discrete_maximum_principle)
{
  for (const std::string &text : {string_under_ceiling(150), string_over_parabola(150)})
  {
    SmallProblem<1> p(text);
    const Outcome   mixed = solve_at(*p.discrete, 0);
    const double    sign = p.constraint_set.points[0].sign; // a lower obstacle is the same for -u
    for (const double epsilon : {1., 1e-2, 1e-4, 1e-6, 1e-8})
    {
      const Outcome penalty = solve_at(*p.discrete, epsilon);
      const double  bound = epsilon * mixed.lambda.linfty_norm(), round_off = 1e-12;
      for (std::size_t j = 0; j < mixed.u.size(); ++j)
      {
        EXPECT_GE(sign * (penalty.u(j) - mixed.u(j)), -round_off) << "epsilon " << epsilon;
        EXPECT_LE(sign * (penalty.u(j) - mixed.u(j)), bound * (1 + 1e-8) + round_off) << "epsilon " << epsilon;
      }
    }
  }
}

// T-2: |u_h - u_eps|_a <= 1/2 sqrt(eps) ||p_h||, ||p_eps|| <= ||p_h||, ||p_h - p_eps|| <= ||p_h||; whatever C_h is.
TEST(MethodOfMultipliers, contact_that_has_far_to_go_on_a_mesh_without_a_coarser_one)
{
  // From all nodes in contact the ends have 1571 and more of 20000 cells to go, which they did one by one.
  const SmallProblem<1> small("mesh.box = [[0], [9]]\nmesh.cells = 20000\nmodel = { kind = \"membrane\", load = -4 }\nboundary.all = 1\n"
                              "constraint.lower = 0\n");
  Vector                u = small.zero_dofs(), lambda = small.zero_points();
  Progress              quiet;
  const auto            result = method_of_multipliers(*small.discrete, {.epsilon = 1e-9}, {}, u, lambda, quiet);
  EXPECT_TRUE(result.converged) << result.reason;
  EXPECT_LT(result.history.size(), 130u);
  EXPECT_NEAR(small.discrete->sum_over_points([&](const std::size_t i) { return small.discrete->weights()(i) * lambda(i); }),
              4 * (9 - std::sqrt(2)), 1e-3);
}

TEST(MethodOfMultipliers, a_soft_penalty_does_not_cost_digits)
{
  // Where eps alone is as soft as the shift, lambda = (Bu - s)/eps has the last digit of Bu magnified as much.
  const SmallProblem<1> small("mesh.box = [[0], [4]]\nmesh.cells = 320\nmodel = { kind = \"beam\", load = -1 }\n"
                              "boundary.all = \"simply supported\"\nconstraint.lower = -0.01\n");
  const double          epsilon = 1.01e-3 * small.discrete->largest(small.discrete->compliance());
  Vector                u = small.zero_dofs(), lambda = small.zero_points(), r = small.zero_dofs();
  Progress              quiet;
  const auto            result = method_of_multipliers(*small.discrete, {.epsilon = epsilon}, {}, u, lambda, quiet);
  EXPECT_TRUE(result.converged) << result.reason;
  const auto certificate = certify(*small.discrete, epsilon, 1e-3, u, lambda, quiet);
  EXPECT_LT(certificate.algebraic_error - 4 * certificate.round_off, 1e-6 * certificate.energy_norm);
}

TEST(MethodOfMultipliers, bound_without_the_inf_sup_constant)
{
  const auto expect_bound = [](DiscreteProblem &discrete)
  {
    const Outcome mixed = solve_at(discrete, 0);
    const double  p_h = std::sqrt(pairing(discrete, mixed.lambda, mixed.lambda));
    for (const double epsilon : {10., 1., 1e-1, 1e-2, 1e-3, 1e-4, 1e-6, 1e-8})
    {
      const Outcome penalty = solve_at(discrete, epsilon);
      Vector        u = penalty.u, p = penalty.lambda;
      u -= mixed.u;
      p -= mixed.lambda;
      EXPECT_LE(energy_norm(discrete, u), 0.5 * std::sqrt(epsilon) * p_h * (1 + 1e-6) + 1e-9) << epsilon;
      EXPECT_LE(std::sqrt(pairing(discrete, p, p)), p_h * (1 + 1e-8)) << epsilon;
      EXPECT_LE(std::sqrt(pairing(discrete, penalty.lambda, penalty.lambda)), p_h * (1 + 1e-8)) << epsilon;
    }
  };
  SmallProblem<1> nodal(string_under_ceiling(128)), midpoint(string_under_ceiling(128, "Q1", "midpoint")),
    cubic(string_under_ceiling(40, "Q3"));
  SmallProblem<2> plane(membrane_over_ball(32));
  expect_bound(*nodal.discrete);
  expect_bound(*midpoint.discrete);
  expect_bound(*cubic.discrete);
  expect_bound(*plane.discrete);
}

// u = psi = -(x^2 - 1)(y^2 - 1) and f = -Laplace psi = 2 (x^2 + y^2 - 2): contact everywhere, no pressure anywhere.
TEST(MethodOfMultipliers, contact_without_pressure)
{
  for (const std::string &side : {std::string("lower"), std::string("upper")})
    for (const std::string &element : {std::string("Q1"), std::string("Q2"), std::string("P1")})
    {
      SmallProblem<2> p("[mesh]\nbox = [[-1, -1], [1, 1]]\ncells = 24\n[model]\nkind = \"membrane\"\nelement = \"" + element +
                        "\"\nload = \"2*(x^2 + y^2 - 2)\"\n[boundary]\nall = 0\n[constraint]\n" + side + " = \"-(x^2 - 1)*(y^2 - 1)\"\n");
      Vector          none = p.zero_dofs(), obstacle = p.zero_dofs(), above = p.zero_dofs(), below = p.zero_dofs(), rough = p.zero_dofs();
      for (std::size_t i = 0; i < p.constraint_set.size(); ++i)
      {
        const auto dof = p.constraint_set.trace[i].dofs[0];
        obstacle(dof) = p.constraint_set.points[i].bound;
        above(dof) = 1e3;
        below(dof) = -1e3;
        rough(dof) = i % 2 == 0 ? 10 : -10;
      }
      for (const double epsilon : {1e-3, 1e-8, 0.})
        for (const Vector *const start : {&none, &obstacle, &above, &below, &rough})
        {
          const Outcome outcome = solve_at(*p.discrete, epsilon, start);
          EXPECT_LE(outcome.result.history.size(), 60u);
          Vector error = outcome.u;
          error -= obstacle;
          EXPECT_LT(error.linfty_norm(), 5e-3) << element; // of the discretisation
          EXPECT_LT(outcome.force, 0.05) << element << ": 0 up to the discretisation, where the load is 10.7";
        }
    }
}

// Q2 holds psi exactly: then the discrete multiplier is zero too, and round-off decides which points touch.
TEST(MethodOfMultipliers, contact_without_pressure_to_the_last_digit)
{
  SmallProblem<2> p("[mesh]\nbox = [[-1, -1], [1, 1]]\ncells = 16\n[model]\nkind = \"membrane\"\nelement = \"Q2\"\n"
                    "load = \"2*(x^2 + y^2 - 2)\"\n[boundary]\nall = 0\n[constraint]\nlower = \"-(x^2 - 1)*(y^2 - 1)\"\n");
  for (const double epsilon : {1e-2, 1e-6, 1e-12, 0.})
  {
    const Outcome outcome = solve_at(*p.discrete, epsilon);
    EXPECT_LT(outcome.force, 1e-6);
    EXPECT_LE(outcome.result.history.size(), 30u);
    for (std::size_t i = 0; i < p.constraint_set.size(); ++i)
      EXPECT_NEAR(outcome.u(p.constraint_set.trace[i].dofs[0]), p.constraint_set.points[i].bound, 1e-9);
  }
}

// Pressed flat everywhere: lambda = f and u - s = eps f, exactly.
TEST(MethodOfMultipliers, a_domain_wholly_in_contact)
{
  SmallProblem<2> p(
    "[mesh]\nbox = [[0, 0], [1, 1]]\ncells = 20\n[model]\nkind = \"membrane\"\nload = 1000\n[boundary]\n[constraint]\nupper = 2\n");
  for (const double epsilon : {1., 1e-3, 1e-9, 0.})
  {
    const Outcome outcome = solve_at(*p.discrete, epsilon, nullptr, true);
    EXPECT_NEAR(outcome.force, 1000, 1e-5) << "epsilon " << epsilon;
    for (const double pressure : outcome.lambda)
      EXPECT_NEAR(pressure / 1000, 1, 1e-7) << "epsilon " << epsilon;
    for (const double value : outcome.u)
      EXPECT_NEAR(value, 2 + epsilon * 1000, 1e-9 * (2 + epsilon * 1000)) << "epsilon " << epsilon;
  }
  // Fixed at the rim and pressed hard: every free node touches.
  SmallProblem<2> q("[mesh]\nbox = [[0, 0], [1, 1]]\ncells = 20\n[model]\nkind = \"membrane\"\nload = 1000\n[boundary]\nall = "
                    "0\n[constraint]\nupper = 0\n");
  const Outcome   mixed = solve_at(*q.discrete, 0);
  EXPECT_EQ(*std::min_element(mixed.lambda.begin(), mixed.lambda.end()) > 0, true);
  EXPECT_NEAR(mixed.force, 1000 * 0.95 * 0.95, 1e-6);
  EXPECT_LT(mixed.u.linfty_norm(), 1e-9);
}

TEST(MethodOfMultipliers, held_by_contact_only)
{
  // No boundary value, no spring: the load presses a membrane down on a bowl. Equilibrium: the force is the whole load.
  SmallProblem<2> p("[mesh]\nbox = [[-1, -1], [1, 1]]\ncells = 20\n[model]\nkind = \"membrane\"\nload = -3\n[boundary]\n[constraint]\n"
                    "lower = \"0.2*(x^2 + y^2)*x - 4*(x - 0.25)^2\"\n");
  EXPECT_TRUE(p.problem->semicoercive());
  for (const double epsilon : {1., 1e-4, 1e-10, 0.})
  {
    const Outcome outcome = solve_at(*p.discrete, epsilon, nullptr, true);
    EXPECT_NEAR(outcome.force, 3 * 4, 1e-7) << "epsilon " << epsilon;
    EXPECT_LE(outcome.result.history.size(), 60u) << "epsilon " << epsilon;
  }
}

TEST(MethodOfMultipliers, no_contact_at_all)
{
  SmallProblem<2> p(
    "[mesh]\nbox = [[0, 0], [1, 1]]\ncells = 20\n[model]\nkind = \"membrane\"\nload = 1\n[boundary]\nall = 0\n[constraint]\n"
    "lower = -1\nupper = 1\n");
  for (const double epsilon : {1., 1e-6, 0.})
  {
    const Outcome outcome = solve_at(*p.discrete, epsilon);
    EXPECT_EQ(outcome.force, 0);
    EXPECT_NEAR(outcome.u.linfty_norm(), 0.0737, 1e-3); // the largest value of the torsion function of the unit square
  }
}

TEST(MethodOfMultipliers, no_load_at_all)
{
  SmallProblem<1> p("[mesh]\nbox = [[0], [1]]\ncells = 20\n[model]\nkind = \"membrane\"\n[boundary]\nall = 0\n[constraint]\nlower = 0\n");
  for (const double epsilon : {1., 1e-6, 0.})
  {
    const Outcome outcome = solve_at(*p.discrete, epsilon);
    EXPECT_EQ(outcome.force, 0);
    EXPECT_EQ(outcome.u.linfty_norm(), 0);
  }
}

/// Nothing tells how large its energy will be before it has moved: the tolerance of the first minimisation was zero.
TEST(MethodOfMultipliers, a_body_at_rest_that_an_obstacle_moves)
{
  for (const std::string nu : {"0.3", "0.4999"})
  {
    SmallProblem<2> p(
      "[mesh]\nbox = [[0, 0], [1, 1]]\ncells = 8\n[model]\nkind = \"elasticity\"\nelement = \"P2\"\nyoung = 100\npoisson = " + nu +
        "\n[boundary]\ntop = [0, 0]\n[constraint]\non = \"bottom\"\ngap = \"-0.01 + 0.04*(x - 0.3)^2\"\n",
      {{"method.solver", "\"amg\""}});
    const Outcome outcome = solve_at(*p.discrete, 1e-8);
    EXPECT_GT(outcome.force, 0);
    EXPECT_LT(outcome.result.linear_iterations, nu == "0.3" ? 200u : 1500u);
  }
}

TEST(MethodOfMultipliers, floor_and_ceiling_at_once)
{
  SmallProblem<1> p("[mesh]\nbox = [[-1], [1]]\ncells = 128\n[model]\nkind = \"membrane\"\nload = \"10*sin(pi*x)\"\n[boundary]\nall = 0\n"
                    "[constraint]\nlower = -0.2\nupper = 0.2\n");
  const Outcome   outcome = solve_at(*p.discrete, 0);
  double          lower = 0, upper = 0;
  const auto     &blocks = p.constraint_set.blocks;
  for (std::size_t i = 0; i < p.constraint_set.size(); ++i)
    (i < blocks[0].end ? lower : upper) += p.discrete->weights()(i) * outcome.lambda(i);
  EXPECT_GT(lower, 1.);
  EXPECT_NEAR(lower / upper, 1, 1e-9);
  EXPECT_NEAR(outcome.u.linfty_norm(), 0.2, 1e-9);
}

// Millimetres for metres and any unit of force: the digits of the answer do not know.
TEST(MethodOfMultipliers, units_do_not_matter)
{
  const auto run = [](const double length, const double stiffness, const double force)
  {
    // u and s scale with the length, f with force / length (1-D: k u'' = f).
    const std::string text =
      fmt::format("[mesh]\nbox = [[0], [{0}]]\ncells = 25\nrefine = 3\n[model]\nkind = \"membrane\"\nstiffness = {1}\n"
                  "load = {2}\n[boundary]\nall = 0\n[constraint]\nupper = {3}\n",
                  length, stiffness, force / length, length / 18);
    Diagnostics diagnostics;
    Progress    progress;
    return solve<1>(problem_of(case_of(text)), diagnostics, progress).result;
  };
  const RunResult metres = run(1, 1, 1);
  for (const auto &[length, stiffness] : {std::pair(1000., 1.), std::pair(1., 1e9), std::pair(1e-6, 3e-5), std::pair(1e6, 7e12)})
  {
    // k u'' with u ~ L, x ~ L: k / L = f, so f L / k is the same.
    const RunResult other = run(length, stiffness, stiffness);
    ASSERT_TRUE(other.converged) << other.reason;
    EXPECT_EQ(other.newton_iterations, metres.newton_iterations);
    EXPECT_EQ(other.constraints[0].n_active, metres.constraints[0].n_active);
    EXPECT_NEAR(other.constraints[0].total_contact_force / stiffness / metres.constraints[0].total_contact_force, 1, 1e-9);
    EXPECT_NEAR(other.max / length / metres.max, 1, 1e-9);
    EXPECT_NEAR(other.energy / (stiffness * length) / metres.energy, 1, 1e-9);
    EXPECT_NEAR(other.constraints[0].max_penetration / length / metres.constraints[0].max_penetration, 1, 1e-6);
  }
}

TEST(MethodOfMultipliers, complementarity_holds_point_by_point)
{
  SmallProblem<2> p(membrane_over_ball(32));
  const Outcome   mixed = solve_at(*p.discrete, 0);
  Vector          trace = p.zero_points();
  p.discrete->apply_trace(trace, mixed.u);
  for (std::size_t i = 0; i < trace.size(); ++i)
  {
    const double gap = trace(i) - p.discrete->obstacle()(i);
    EXPECT_GE(mixed.lambda(i), 0);
    EXPECT_LE(gap, 1e-10);
    EXPECT_LE(std::abs(mixed.lambda(i) * gap), 1e-9);
  }
  const auto residual = complementarity_residual(*p.discrete, 0, mixed.u, mixed.lambda);
  EXPECT_LT(residual.norm, 1e-9 * residual.lambda_norm);
}

TEST(MethodOfMultipliers, complementarity_residual_by_hand)
{
  // One free node: w = h = 1/2, A = 2/h = 4, tau = w / A = 1/8; B = 1.
  SmallProblem<1> p("[mesh]\nbox = [[0], [1]]\ncells = 2\n[model]\nkind = \"membrane\"\n[boundary]\nall = 0\n[constraint]\nupper = 0.25\n");
  ASSERT_EQ(p.constraint_set.size(), 1u);
  EXPECT_NEAR(p.discrete->compliance()(0), 1. / 8, 1e-14);
  Vector     u = p.zero_dofs(), lambda = p.zero_points();
  const auto dof = p.constraint_set.trace[0].dofs[0];
  // Free: lambda = 0 and a gap.
  EXPECT_EQ(complementarity_residual(*p.discrete, 0, u, lambda).norm, 0);
  // Pressure across a gap of 1/4: c = 1 - (1 - 8/4)^+ = 1.
  lambda(0) = 1;
  EXPECT_NEAR(complementarity_residual(*p.discrete, 0, u, lambda).norm, std::sqrt(0.5 / 8), 1e-14);
  // Penetration without pressure: u = 1/2, c = -8/4.
  lambda(0) = 0;
  u(dof) = 0.5;
  EXPECT_NEAR(complementarity_residual(*p.discrete, 0, u, lambda).norm, 2 * std::sqrt(0.5 / 8), 1e-14);
  // The penalty's relation: penetration 1/4 = eps lambda.
  lambda(0) = 25;
  EXPECT_NEAR(complementarity_residual(*p.discrete, 0.01, u, lambda).norm, 0, 1e-13);
}
