// The inner solver: line search against brute force, energy descent, termination, the damped branch.
#include "small_problem.h"

#include "unilateral/inequality/line_search.h"
#include "unilateral/inequality/semismooth_newton.h"

#include <gtest/gtest.h>

#include <deal.II/lac/full_matrix.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>

namespace
{
  using namespace unilateral;
  using dealii::FullMatrix;

  /// A problem of small dense matrices with B = I and W = I.
  class Dense : public DiscreteProblem
  {
  public:
    Dense(FullMatrix<double> stiffness, const std::vector<double> &load, const std::vector<double> &bound, const bool symmetric)
      : A(std::move(stiffness)), f(load.size()), s(load.size()), ones(load.size()), diagonal(load.size()), tau(load.size()),
        is_symmetric(symmetric)
    {
      for (unsigned i = 0; i < load.size(); ++i)
      {
        f(i) = load[i];
        s(i) = bound[i];
        ones(i) = 1;
        diagonal(i) = A(i, i);
        tau(i) = 1 / A(i, i);
      }
    }

    void                       initialize_dof_vector(Vector &v) const override { v.reinit(f.size()); }
    void                       initialize_point_vector(Vector &q) const override { q.reinit(f.size()); }
    bool                       symmetric() const override { return is_symmetric; }
    const std::vector<Vector> &null_space() const override { return modes; }
    void                       apply_stiffness(Vector &Au, const Vector &u) const override
    {
      for (unsigned i = 0; i < f.size(); ++i)
      {
        Au(i) = 0;
        for (unsigned j = 0; j < f.size(); ++j)
          Au(i) += A(i, j) * u(j);
      }
    }
    void apply_gram(Vector &Hu, const Vector &u) const override { Hu = u; }
    void apply_trace(Vector &Bu, const Vector &u) const override { Bu = u; }
    void apply_trace_to_sizes(Vector &sizes, const Vector &u) const override
    {
      for (unsigned i = 0; i < u.size(); ++i)
        sizes(i) = std::abs(u(i));
    }
    void          apply_trace_transpose(Vector &BtWq, const Vector &q) const override { BtWq = q; }
    const Vector &stiffness_diagonal() const override { return diagonal; }
    const Vector &load() const override { return f; }
    const Vector &weights() const override { return ones; }
    const Vector &obstacle() const override { return s; }
    const Vector &compliance() const override { return tau; }
    const Vector &trace_mass() const override { return ones; }
    LocalRows     rows_near_free_boundary(const std::vector<bool> &) const override { return {}; }
    std::string   linear_solver_name() const override { return "direct"; }
    bool          solves_exactly() const override { return true; }
    std::size_t   n_operator_applications() const override { return 0; }

    LinearSolve solve_tangent(const Vector &d, const Vector &rhs, const SolveTolerance &, Vector &x, Vector *Ax) override
    {
      const unsigned         n = f.size();
      FullMatrix<double>     tangent(A);
      dealii::Vector<double> b(n), y(n);
      for (unsigned i = 0; i < n; ++i)
      {
        tangent(i, i) += d(i);
        b(i) = rhs(i);
      }
      tangent.gauss_jordan();
      tangent.vmult(y, b);
      LinearSolve result;
      result.converged = true;
      for (unsigned i = 0; i < n; ++i)
        x(i) = y(i);
      if (Ax)
        apply_stiffness(*Ax, x);
      return result;
    }

    FullMatrix<double>  A;
    Vector              f, s, ones, diagonal, tau;
    bool                is_symmetric;
    std::vector<Vector> modes; ///< null_space()
  };

  /// 1/2 u'Au - f'u + 1/2 sum w_i ((Bu - s + r lambda)_i^+)^2 / (eps + r_i)
  double augmented_energy(const AugmentedProblem &augmented, const Vector &u)
  {
    Vector gap;
    augmented.problem.initialize_point_vector(gap);
    augmented.shifted_gap(gap, u);
    double energy = energy_of(augmented.problem, u);
    for (std::size_t i = 0; i < gap.size(); ++i)
      energy += 0.5 * augmented.problem.weights()(i) * std::pow(std::max(gap(i), 0.), 2) / (augmented.epsilon + augmented.shift(i));
    return energy;
  }

  /// The size of f - Au - B'W lambda_next(u) in the norm of 1/diag(A).
  double residual_norm(const AugmentedProblem &augmented, const Vector &u)
  {
    Vector Au, force, pressure;
    augmented.problem.initialize_dof_vector(Au);
    augmented.problem.initialize_dof_vector(force);
    augmented.problem.initialize_point_vector(pressure);
    augmented.next_multiplier(pressure, u);
    augmented.problem.apply_stiffness(Au, u);
    augmented.problem.apply_trace_transpose(force, pressure);
    double sum = 0;
    for (std::size_t j = 0; j < Au.size(); ++j)
      sum += std::pow(augmented.problem.load()(j) - Au(j) - force(j), 2) / augmented.problem.stiffness_diagonal()(j);
    return std::sqrt(sum);
  }

  AugmentedProblem penalty_problem(DiscreteProblem &problem, const double epsilon)
  {
    AugmentedProblem augmented{problem, epsilon, {}, {}};
    problem.initialize_point_vector(augmented.shift);
    problem.initialize_point_vector(augmented.multiplier);
    return augmented;
  }

  const std::string bumpy_string = R"toml([mesh]
box = [[0], [1]]
cells = 200
[model]
kind = "membrane"
load = "60*sin(13*x)*cos(5*x) + 20"
[boundary]
all = 0
[constraint]
upper = "0.3 + 0.2*sin(40*x)"
)toml";

  const std::string membrane = R"toml([mesh]
box = [[0, 0], [1, 1]]
cells = 24
[model]
kind = "membrane"
load = "60*sin(7*x)*cos(5*y) + 20"
[boundary]
all = 0
[constraint]
upper = "0.2 + 0.1*sin(20*x)*y"
)toml";
} // namespace

TEST(ExactLineSearch, finds_the_minimum_of_random_piecewise_quadratics)
{
  std::mt19937                           generator(7);
  std::uniform_real_distribution<double> uniform(-1, 1);
  for (unsigned trial = 0; trial < 2000; ++trial)
  {
    const unsigned n = 1 + trial % 40;
    Vector         c(n), g(n), b(n);
    for (unsigned i = 0; i < n; ++i)
    {
      c(i) = std::pow(10., 4 * uniform(generator));
      g(i) = uniform(generator);
      b(i) = uniform(generator);
    }
    const double curvature = trial % 5 == 0 ? 1e-6 : std::abs(uniform(generator)) + 1e-3;
    double       at_zero = 0;
    for (unsigned i = 0; i < n; ++i)
      at_zero += c(i) * std::max(g(i), 0.) * b(i);
    const double slope = -at_zero - std::pow(10., 2 * uniform(generator)); // descends at t = 0

    const auto derivative = [&](const double t)
    {
      double value = slope + t * curvature;
      for (unsigned i = 0; i < n; ++i)
        value += c(i) * std::max(g(i) + t * b(i), 0.) * b(i);
      return value;
    };
    // Brute force: the kinks in order, and the zero of the line between two of them.
    std::vector<double> kinks = {0};
    for (unsigned i = 0; i < n; ++i)
      if (-g(i) / b(i) > 0)
        kinks.push_back(-g(i) / b(i));
    std::sort(kinks.begin(), kinks.end());
    double expected = 0;
    for (std::size_t k = 0; k < kinks.size(); ++k)
    {
      const double left = kinks[k], right = k + 1 < kinks.size() ? kinks[k + 1] : 2 * left + 1;
      if (k + 1 < kinks.size() && derivative(right) < 0)
        continue;
      const double at_left = derivative(left), at_right = derivative(right);
      expected = left - at_left * (right - left) / (at_right - at_left);
      break;
    }
    const double t = exact_line_search(slope, curvature, c, g, b);
    EXPECT_NEAR(t / expected, 1, 1e-5) << "trial " << trial;
    EXPECT_LE(std::abs(derivative(t)), 2e-8 * std::abs(derivative(0)) + 1e-9) << "trial " << trial;
  }
}

TEST(ExactLineSearch, without_constraints_it_is_the_quotient)
{
  Vector c(1), g(1), b(1);
  c(0) = 1;
  g(0) = -1;
  b(0) = -1; // never active
  EXPECT_NEAR(exact_line_search(-3, 2, c, g, b), 1.5, 1e-14);
  EXPECT_NEAR(exact_line_search(-1e-20, 1e-22, c, g, b), 100, 1e-5);
}

TEST(ExactLineSearch, a_step_beyond_all_kinks)
{
  // slope -1, no curvature of its own, one point that becomes active at t = 1000: minimum at 1000 + 1.
  Vector c(1), g(1), b(1);
  c(0) = 1;
  g(0) = -1000;
  b(0) = 1;
  EXPECT_NEAR(exact_line_search(-1, 0, c, g, b), 1001, 1e-3);
}

TEST(SemismoothNewton, energy_falls_in_every_step)
{
  SmallProblem<1> string(bumpy_string);
  SmallProblem<2> square(membrane);
  for (DiscreteProblem *const problem :
       {static_cast<DiscreteProblem *>(string.discrete.get()), static_cast<DiscreteProblem *>(square.discrete.get())})
    for (const double epsilon : {1e-2, 1e-5, 1e-9})
    {
      const AugmentedProblem augmented = penalty_problem(*problem, epsilon);
      Vector                 u;
      problem->initialize_dof_vector(u);
      double last = augmented_energy(augmented, u);
      bool   converged = false;
      for (unsigned step = 1; !converged && step < 200; ++step)
      {
        Progress           progress;
        const NewtonResult result = semismooth_newton(augmented, {.tolerance = 1e-10, .max_steps = 1}, {}, u, progress);
        const double       energy = augmented_energy(augmented, u);
        EXPECT_LE(energy, last + 1e-11 * std::abs(last)) << "step " << step << ", epsilon " << epsilon;
        EXPECT_EQ(result.history.size(), 1u);
        converged = result.converged;
        last = energy;
      }
      EXPECT_TRUE(converged);
    }
}

TEST(SemismoothNewton, ends_after_finitely_many_steps_at_the_solution)
{
  SmallProblem<2> p(membrane);
  for (const double epsilon : {1., 1e-3, 1e-6})
  {
    const AugmentedProblem augmented = penalty_problem(*p.discrete, epsilon);
    Vector                 u = p.zero_dofs();
    Progress               progress;
    const NewtonResult     result = semismooth_newton(augmented, {.tolerance = 1e-10}, {}, u, progress);
    EXPECT_TRUE(result.converged) << result.reason;
    EXPECT_LT(result.history.size(), 40u);
    EXPECT_EQ(result.history.back().flipped, 0u);
    EXPECT_LT(residual_norm(augmented, u), 1e-8);
  }
}

TEST(SemismoothNewton, from_the_solution_one_step_is_enough)
{
  SmallProblem<2>        p(membrane);
  const AugmentedProblem augmented = penalty_problem(*p.discrete, 1e-4);
  Vector                 u = p.zero_dofs();
  Progress               progress;
  semismooth_newton(augmented, {.tolerance = 1e-10}, {}, u, progress);
  const NewtonResult again = semismooth_newton(augmented, {.tolerance = 1e-10}, {}, u, progress);
  EXPECT_TRUE(again.converged);
  EXPECT_EQ(again.history.size(), 1u);
  // The same from the active set alone.
  Vector            gap = p.zero_points(), start = p.zero_dofs();
  std::vector<bool> active(gap.size());
  augmented.shifted_gap(gap, u);
  for (std::size_t i = 0; i < gap.size(); ++i)
    active[i] = gap(i) > 0;
  const NewtonResult predicted = semismooth_newton(augmented, {.tolerance = 1e-10}, active, start, progress);
  EXPECT_TRUE(predicted.converged);
  EXPECT_LE(predicted.history.size(), 2u);
  start -= u;
  EXPECT_LT(start.linfty_norm(), 1e-10);
}

TEST(SemismoothNewton, a_relative_tolerance_counts_from_the_first_step)
{
  SmallProblem<2>        p(membrane);
  const AugmentedProblem augmented = penalty_problem(*p.discrete, 1e-4);
  Progress               progress;
  std::size_t            steps_before = std::numeric_limits<std::size_t>::max();
  for (const double relative : {1e-12, 1e-3, 0.5})
  {
    Vector             u = p.zero_dofs();
    const NewtonResult result = semismooth_newton(augmented, {.tolerance = 0, .relative_tolerance = relative}, {}, u, progress);
    EXPECT_TRUE(result.converged) << result.reason;
    EXPECT_LE(result.history.size(), steps_before);
    // Nothing is left of the last steps that the first would call large.
    if (!result.at_round_off)
    {
      EXPECT_LE(std::min(result.residual, result.history.back().residual), relative * result.history.front().residual);
    }
    steps_before = result.history.size();
  }
  EXPECT_LT(steps_before, 8u);
}

TEST(SemismoothNewton, keeps_the_product_with_A)
{
  SmallProblem<2>        p(membrane);
  const AugmentedProblem augmented = penalty_problem(*p.discrete, 1e-4);
  Progress               progress;
  Vector                 u = p.zero_dofs(), Au = p.zero_dofs(), expected = p.zero_dofs();
  p.discrete->apply_stiffness(Au, u);
  EXPECT_TRUE(semismooth_newton(augmented, {.tolerance = 1e-10}, {}, u, Au, progress).converged);
  p.discrete->apply_stiffness(expected, u);
  const double size = expected.linfty_norm();
  expected -= Au;
  EXPECT_GT(size, 1e-3);
  EXPECT_LT(expected.linfty_norm(), 1e-13 * size);
}

TEST(SemismoothNewton, a_wrong_prediction_does_no_harm)
{
  SmallProblem<2>        p(membrane);
  const AugmentedProblem augmented = penalty_problem(*p.discrete, 1e-6);
  Vector                 expected = p.zero_dofs();
  Progress               progress;
  semismooth_newton(augmented, {.tolerance = 1e-11}, {}, expected, progress);
  std::vector<bool> all(p.constraint_set.size(), true), none(p.constraint_set.size(), false), every_other(p.constraint_set.size());
  for (std::size_t i = 0; i < every_other.size(); i += 2)
    every_other[i] = true;
  for (const auto &prediction : {all, none, every_other})
  {
    Vector             u = p.zero_dofs();
    const NewtonResult result = semismooth_newton(augmented, {.tolerance = 1e-11}, prediction, u, progress);
    EXPECT_TRUE(result.converged) << result.reason;
    u -= expected;
    EXPECT_LT(u.linfty_norm(), 1e-9);
  }
}

TEST(SemismoothNewton, random_symmetric_problems_against_enumeration)
{
  std::mt19937                           generator(11);
  std::uniform_real_distribution<double> uniform(-1, 1);
  for (unsigned trial = 0; trial < 200; ++trial)
  {
    constexpr unsigned  n = 5;
    FullMatrix<double>  M(n, n), A(n, n);
    std::vector<double> load(n), bound(n);
    for (unsigned i = 0; i < n; ++i)
    {
      load[i] = 3 * uniform(generator);
      bound[i] = 0.5 * uniform(generator);
      for (unsigned j = 0; j < n; ++j)
        M(i, j) = uniform(generator);
    }
    M.mTmult(A, M);
    for (unsigned i = 0; i < n; ++i)
      A(i, i) += 0.05;
    Dense                  problem(A, load, bound, true);
    const AugmentedProblem augmented = penalty_problem(problem, 1e-4);
    Vector                 u(n), far(n);
    Progress               progress;
    EXPECT_TRUE(semismooth_newton(augmented, {.tolerance = 1e-12}, {}, u, progress).converged);
    EXPECT_LT(residual_norm(augmented, u), 1e-8) << "trial " << trial;
    far = 100.;
    EXPECT_TRUE(semismooth_newton(augmented, {.tolerance = 1e-12}, {}, far, progress).converged);
    far -= u;
    EXPECT_LT(far.linfty_norm(), 1e-9) << "trial " << trial;
  }
}

// Non-symmetric, coercive, but no M-matrices: the plain active-set iteration returns to a set it has seen, and the steps are damped.
TEST(SemismoothNewton, cycles_of_nonsymmetric_problems_are_noticed_and_damped)
{
  std::mt19937                           generator(3);
  std::uniform_real_distribution<double> uniform(-1, 1);
  unsigned                               damped = 0, damped_and_solved = 0;
  for (unsigned trial = 0; trial < 4000; ++trial)
  {
    constexpr unsigned  n = 3;
    FullMatrix<double>  A(n, n);
    std::vector<double> load(n), bound(n, 0.);
    for (unsigned i = 0; i < n; ++i)
    {
      load[i] = uniform(generator);
      A(i, i) = 1;
      for (unsigned j = 0; j < i; ++j)
      {
        const double skew = 8 * uniform(generator);
        A(i, j) = skew; // x'Ax = |x|^2: coercive whatever the skew part
        A(j, i) = -skew;
      }
    }
    Dense                  problem(A, load, bound, false);
    const AugmentedProblem augmented = penalty_problem(problem, 1e-3);
    Vector                 u(n);
    Progress               progress;
    const NewtonResult     result = semismooth_newton(augmented, {.tolerance = 1e-12}, {}, u, progress);
    const bool             has_cycled =
      std::any_of(result.history.begin(), result.history.end(), [](const auto &step) { return step.step_length < 1; });
    damped += has_cycled;
    if (result.converged)
    {
      EXPECT_LT(residual_norm(augmented, u), 1e-8) << "trial " << trial;
      damped_and_solved += has_cycled;
    }
    else
    {
      EXPECT_EQ(result.history.size(), 200u);
      EXPECT_NE(result.reason.find("repeat"), std::string::npos) << result.reason;
    }
  }
  EXPECT_GT(damped, 10u);
  EXPECT_GE(damped_and_solved, 0.9 * damped);
}

TEST(SemismoothNewton, nonsymmetric_membrane_with_the_wind)
{
  for (const std::string velocity : {"[30, -20]", "[\"100*(y - 0.5)\", \"100*(0.5 - x)\"]"})
  {
    SmallProblem<2>        p(membrane, {{"model.velocity", velocity}});
    const AugmentedProblem augmented = penalty_problem(*p.discrete, 1e-6);
    Vector                 u = p.zero_dofs();
    Progress               progress;
    const NewtonResult     result = semismooth_newton(augmented, {.tolerance = 1e-10}, {}, u, progress);
    EXPECT_TRUE(result.converged) << result.reason;
    EXPECT_LT(result.history.size(), 40u);
    EXPECT_LT(residual_norm(augmented, u), 1e-8);
  }
}

TEST(SemismoothNewton, an_energy_without_a_minimum_is_a_reason_not_a_crash)
{
  // Nothing but contact holds it, and the load pulls it away: A is singular, J falls without end.
  FullMatrix<double> A(2, 2);
  A(0, 0) = A(1, 1) = 1;
  A(0, 1) = A(1, 0) = -1;
  Dense falling(A, {-1, -1}, {0, 0}, true);
  falling.modes.emplace_back(2);
  falling.modes[0] = 1.;
  const AugmentedProblem without = penalty_problem(falling, 1e-3);
  Vector                 u(2);
  Progress               progress;
  NewtonParameters       parameters{.tolerance = 1e-12};
  const NewtonResult     result = semismooth_newton(without, parameters, {}, u, progress);
  EXPECT_FALSE(result.converged);
  EXPECT_FALSE(result.reason.empty());
}

TEST(SemismoothNewton, asked_to_stop_it_throws)
{
  struct Stop : Progress
  {
    bool stop_requested() const override { return true; }
  };
  SmallProblem<1>        p(bumpy_string);
  const AugmentedProblem augmented = penalty_problem(*p.discrete, 1e-4);
  Vector                 u = p.zero_dofs();
  Stop                   stop;
  EXPECT_THROW(semismooth_newton(augmented, {.tolerance = 1e-10}, {}, u, stop), Interrupted);
}

TEST(SemismoothNewton, the_step_limit_is_kept)
{
  SmallProblem<1>        p(bumpy_string);
  const AugmentedProblem augmented = penalty_problem(*p.discrete, 1e-8);
  Vector                 u = p.zero_dofs();
  Progress               progress;
  const NewtonResult     result = semismooth_newton(augmented, {.tolerance = 1e-10, .max_steps = 2}, {}, u, progress);
  EXPECT_FALSE(result.converged);
  EXPECT_EQ(result.history.size(), 2u);
  EXPECT_FALSE(result.reason.empty());
}

TEST(SemismoothNewton, a_tolerance_below_round_off_ends_at_round_off)
{
  for (const std::string solver : {"direct", "amg"})
  {
    SmallProblem<2>        p(membrane, {{"method.solver", solver}});
    const AugmentedProblem augmented = penalty_problem(*p.discrete, 1e-4);
    Vector                 u = p.zero_dofs(), expected = p.zero_dofs();
    Progress               progress;
    semismooth_newton(augmented, {.tolerance = 1e-10}, {}, expected, progress);
    const NewtonResult result = semismooth_newton(augmented, {.tolerance = 1e-25}, {}, u, progress);
    EXPECT_TRUE(result.converged) << result.reason;
    EXPECT_LT(result.history.size(), 30u);
    u -= expected;
    EXPECT_LT(u.linfty_norm(), 1e-9);
  }
}
