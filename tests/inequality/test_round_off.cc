// The certificate bounds what rounding does, too: against mixed solutions of the same matrices in long double.
#include "small_problem.h"

#include "unilateral/inequality/augmented_problem.h"
#include "unilateral/inequality/certificate.h"

#include <gtest/gtest.h>

#include <Eigen/Dense>

#include <optional>
#include <random>

using namespace unilateral;

namespace
{
  using Real = long double;
  using Matrix = Eigen::Matrix<Real, Eigen::Dynamic, Eigen::Dynamic>;
  using Column = Eigen::Matrix<Real, Eigen::Dynamic, 1>;

  Column column_of(const Vector &v)
  {
    Column result(v.size());
    for (std::size_t i = 0; i < v.size(); ++i)
      result(i) = v(i);
    return result;
  }

  /// The matrices of a small problem, as they are in double precision.
  struct Dense
  {
    explicit Dense(const DiscreteProblem &discrete)
      : f(column_of(discrete.load())), s(column_of(discrete.obstacle())), w(column_of(discrete.weights())), A(f.size(), f.size()),
        B(s.size(), f.size())
    {
      Vector unit, image, trace;
      discrete.initialize_dof_vector(unit);
      discrete.initialize_dof_vector(image);
      discrete.initialize_point_vector(trace);
      for (Eigen::Index j = 0; j < f.size(); ++j)
      {
        unit = 0.;
        unit(j) = 1;
        discrete.apply_stiffness(image, unit);
        discrete.apply_trace(trace, unit);
        A.col(j) = column_of(image);
        B.col(j) = column_of(trace);
      }
      for (Eigen::Index j = 0; j < f.size(); ++j)
        if (A.col(j).norm() == 0)
          A(j, j) = 1; // an entry that is prescribed
    }

    Real energy_norm(const Column &v) const { return std::sqrt(std::max<Real>(0, v.dot(A * v))); }

    /// A u + B'W lambda = f with lambda >= 0, Bu <= s, started from the active set of @p lambda; nothing where the set does not come to
    /// rest.
    std::optional<Column> mixed_solution(const Vector &lambda) const
    {
      std::vector<bool> active(s.size());
      for (Eigen::Index i = 0; i < s.size(); ++i)
        active[i] = lambda(i) > 0;
      const Eigen::Index n = f.size();
      for (unsigned iteration = 0; iteration < 60; ++iteration)
      {
        std::vector<Eigen::Index> points;
        for (Eigen::Index i = 0; i < s.size(); ++i)
          if (active[i])
            points.push_back(i);
        const Eigen::Index m = points.size();
        Matrix             K = Matrix::Zero(n + m, n + m);
        Column             right(n + m);
        K.topLeftCorner(n, n) = A;
        right.head(n) = f;
        for (Eigen::Index k = 0; k < m; ++k)
        {
          K.block(0, n + k, n, 1) = B.row(points[k]).transpose() * w(points[k]);
          K.block(n + k, 0, 1, n) = B.row(points[k]) * w(points[k]);
          right(n + k) = w(points[k]) * s(points[k]);
        }
        const Eigen::FullPivLU<Matrix> factors(K);
        Column                         x = factors.solve(right);
        if (!(factors.rank() == n + m))
          return {}; // pressures that are not unique have no active set to come to rest
        x += factors.solve(right - K * x);
        const Column u = x.head(n);
        const Column excess = B * u - s;
        bool         changed = false;
        const Real   scale = s.cwiseAbs().maxCoeff() + u.cwiseAbs().maxCoeff(), largest = m > 0 ? x.tail(m).cwiseAbs().maxCoeff() : 0;
        for (Eigen::Index k = 0; k < m; ++k)
          if (x(n + k) < -1e-16L * largest)
          {
            active[points[k]] = false;
            changed = true;
          }
        for (Eigen::Index i = 0; i < s.size(); ++i)
          if (!active[i] && excess(i) > 1e-17L * scale)
          {
            active[i] = true;
            changed = true;
          }
        if (!changed)
          return u;
      }
      return {};
    }

    Column f, s, w;
    Matrix A, B;
  };

  std::string random_membrane(std::mt19937 &random, const unsigned dim)
  {
    const auto        uniform = [&](double a, double b) { return std::uniform_real_distribution<double>(a, b)(random); };
    const double      k = std::pow(10, uniform(-6, 6)), shift = random() % 2 ? 0. : uniform(-1000, 1000);
    const std::string x = dim == 1 ? "x" : "x + 0.7*y";
    std::string       text = dim == 1 ? fmt::format("[mesh]\nbox = [[0], [1]]\ncells = {}\n", 6 + random() % 60)
                                      : fmt::format("[mesh]\nbox = [[0, 0], [1, 1]]\ncells = [{}, {}]\n", 3 + random() % 5, 3 + random() % 5);
    text += fmt::format("[model]\nkind = \"membrane\"\nelement = \"{}\"\nstiffness = {:.17g}\n",
                        std::vector<std::string>{"Q1", "Q2", "P1"}[random() % 3], k);
    text += fmt::format("load = \"{:.6g}*cos({:.3g}*({}))\"\n", k * uniform(1, 20), uniform(0, 9), x);
    // Far from zero, u and the obstacle are known to fewer digits.
    text += fmt::format("[boundary]\nall = {:.17g}\n[constraint]\n", shift);
    text += fmt::format("upper = \"{:.17g} + {:.4g} + {:.4g}*sin({:.3g}*({}))^2\"\nquadrature = \"nodal\"\n", shift, uniform(0.03, 0.2),
                        uniform(0, 0.2), uniform(1, 9), x);
    return text;
  }

  std::string random_block(std::mt19937 &random)
  {
    const auto   uniform = [&](double a, double b) { return std::uniform_real_distribution<double>(a, b)(random); };
    const double E = std::pow(10, uniform(-3, 9)), force = E * std::pow(10, uniform(-5, -1)), high = uniform(-1, 3);
    std::string  text = fmt::format("[mesh]\nbox = [[0, {0:.17g}], [{1:.17g}, {2:.17g}]]\ncells = [{3}, {4}]\n", high, uniform(0.5, 3),
                                    high + uniform(0.5, 2), 2 + random() % 3, 2 + random() % 3);
    text += fmt::format("[model]\nkind = \"elasticity\"\nelement = \"{}\"\nyoung = {:.17g}\npoisson = {:.3g}\nload = [0, {:.6g}]\n",
                        std::vector<std::string>{"Q1", "Q2", "Q3"}[random() % 3], E, uniform(0, 0.45), -force);
    text += "[boundary]\nleft = \"symmetry\"\n[constraint]\non = \"bottom\"\n";
    text += random() % 2 ? fmt::format("gap = {{ plane = {{ point = [{:.17g}, {:.17g}], normal = [{:.17g}, 1] }} }}\n", uniform(0, 1),
                                       high - uniform(0, 0.3), uniform(-0.1, 0.1))
                         : fmt::format("gap = \"{:.4g} + {:.4g}*(x - {:.3g})^2\"\n", uniform(0, 0.3), uniform(0, 0.01), uniform(0, 1));
    return text;
  }

  struct Outcome
  {
    bool   known = false;
    double bound = 0, error = 0, norm = 0;
  };

  template <int dim>
  Outcome compare(const std::string &text, const double epsilon_by_compliance, const double tolerance)
  {
    SmallProblem<dim> small(text);
    auto             &discrete = *small.discrete;
    Progress          silent;
    std::vector<bool> first(discrete.weights().size(), !discrete.null_space().empty());
    const double      epsilon = epsilon_by_compliance * discrete.compliance()(0), shift = suitable_shift(small.constraint_set.at_nodes());
    Vector            u = small.zero_dofs(), lambda = small.zero_points();
    method_of_multipliers(discrete, {.epsilon = epsilon, .tolerance = tolerance, .shift = shift}, first, u, lambda, silent);
    const Certificate certificate = certify(discrete, epsilon, shift, u, lambda, silent);
    Vector            u_h(u), lambda_h(lambda);
    method_of_multipliers(discrete, {.tolerance = 1e-13, .shift = shift}, positive(lambda), u_h, lambda_h, silent);
    const Dense dense(discrete);
    const auto  exact = dense.mixed_solution(lambda_h);
    if (!exact || !certificate.available)
      return {};
    return {true, certificate.penalty_error_bound, double(dense.energy_norm(*exact - column_of(u))), certificate.energy_norm};
  }
} // namespace

TEST(RoundOff, the_certificate_is_never_below_the_error_down_to_the_last_digit)
{
  std::mt19937 random(2026);
  unsigned     n_known = 0;
  double       largest_floor = 0;
  for (unsigned n = 0; n < 300; ++n)
  {
    const std::string text = n % 3 == 0 ? random_membrane(random, 1) : n % 3 == 1 ? random_membrane(random, 2) : random_block(random);
    const double      epsilon = std::vector<double>{0, 1e-15, 1e-12, 1e-9, 1e-6}[random() % 5];
    SCOPED_TRACE(text + fmt::format("epsilon by compliance {}", epsilon));
    const Outcome outcome = n % 3 == 0 ? compare<1>(text, epsilon, 1e-12) : compare<2>(text, epsilon, 1e-12);
    if (!outcome.known)
      continue;
    ++n_known;
    EXPECT_GE(outcome.bound, outcome.error) << "of an energy norm " << outcome.norm;
    if (epsilon == 0)
      largest_floor = std::max(largest_floor, outcome.bound / outcome.norm);
  }
  EXPECT_GT(n_known, 150u);
  std::cout << n_known << " of 300 known, largest relative bound of a mixed solution " << largest_floor << "\n";
}

/// The penalty moves a block under a uniform pressure as a whole, which takes no energy but what rounding makes of it.
TEST(RoundOff, a_shift_of_the_whole_body)
{
  for (const double gap : {0., -3.58e-5, 1e-3, 1.})
    for (const double epsilon : {1e-6, 1e-4, 1e-2})
    {
      const std::string text = fmt::format("[mesh]\nbox = [[0, 0], [2, 1]]\ncells = [6, 7]\n[model]\nkind = \"elasticity\"\nyoung = 46.98\n"
                                           "poisson = 0.1196\nassumption = \"axisymmetric\"\n[boundary]\ntop = {{ pressure = 0.00507 }}\n"
                                           "right = \"symmetry\"\n[constraint]\non = \"bottom\"\n"
                                           "gap = {{ plane = {{ point = [0, {}], normal = [0, 1] }} }}\n",
                                           -gap);
      SCOPED_TRACE(fmt::format("gap {}, epsilon {}", gap, epsilon));
      const Outcome outcome = compare<2>(text, epsilon, 1e-10);
      ASSERT_TRUE(outcome.known);
      EXPECT_GE(outcome.bound, outcome.error) << "of an energy norm " << outcome.norm;
      EXPECT_LE(outcome.bound, 1e-6 * outcome.norm);
    }
}
