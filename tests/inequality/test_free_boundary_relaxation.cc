// Rows of A and B around a free boundary, and what relaxation makes of a wrong contact there.
#include "both_ways.h"

#include "unilateral/inequality/free_boundary_relaxation.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace
{
  using namespace unilateral;

  struct Text
  {
    std::string name, text;
    unsigned    dim = 2;
    unsigned    coordinate = 0;  ///< in which contact ends
    double      end = 0;         ///< and about where
    bool        at_nodes = true; ///< a diagonal penalty: contact is found exactly
  };

  std::vector<Text> texts()
  {
    const std::string box = "[mesh]\nbox = [[-1, -1], [1, 1]]\ncells = [4, 4]\nrefine = 3\n";
    const std::string membrane = "[model]\nkind = \"membrane\"\nload = -1\n", fixed = "[boundary]\nall = 0\n";
    const std::string obstacle = "[constraint]\nlower = \"-0.06 - 0.05*x\"\n";
    const std::string body = "[model]\nkind = \"elasticity\"\nyoung = 10\npoisson = 0.3\n";
    return {
      {"Q1", box + membrane + fixed + obstacle, 2, 0, 0.2},
      {"Q2", box + membrane + "element = \"Q2\"\n" + fixed + obstacle, 2, 0, 0.2},
      {"gauss", box + membrane + fixed + obstacle + "quadrature = \"gauss(2)\"\n", 2, 0, 0.2, false},
      {"plane", box + body + "[boundary]\ntop = [0, -0.1]\n[constraint]\non = \"bottom\"\ngap = \"0.1*(x + 0.3)^2\"\n", 2, 0, 0.2},
      // Normals that are parallel to no axis couple the components at a node.
      {"disc",
       "[mesh]\nball = { center = [0, 0], radius = 1 }\nrefine = 4\n" + body +
         "load = [0, -0.3]\n[boundary]\nall = { spring = 0.1 }\n[constraint]\non = \"surface\"\ngap = \"0.05*(1 + y)\"\n",
       2, 1, -0.5},
      {"cube",
       "[mesh]\nbox = [[0, 0, 0], [1, 1, 1]]\ncells = 2\nrefine = 2\n" + body +
         "[boundary]\ntop = [0, -0.1, 0]\n[constraint]\non = \"bottom\"\ngap = \"0.2*x^2 + 0.05*z\"\n",
       3, 0, 0.5},
    };
  }

  void PrintTo(const Text &text, std::ostream *out)
  {
    *out << text.name;
  }

  class LocalRelaxation : public testing::TestWithParam<Text>
  {
  protected:
    template <typename Check>
    static void both_ways(const Check &check)
    {
      if (GetParam().dim == 2)
        check(BothWays<2>(GetParam().text));
      else
        check(BothWays<3>(GetParam().text));
    }
  };

  template <int dim>
  std::vector<bool> contact_below(const ConstraintSet<dim> &constraint_set, const Text &text)
  {
    std::vector<bool> contact;
    for (const auto &point : constraint_set.points)
      contact.push_back(point.x[text.coordinate] < text.end);
    return contact;
  }

  template <int dim>
  void expect_rows(const DiscreteProblem &discrete, const BothWays<dim> &both, const Text &text)
  {
    const auto contact = contact_below(both.assembled.constraint_set, text);
    const auto rows = discrete.rows_near_free_boundary(contact);
    ASSERT_FALSE(rows.unknowns.empty());
    EXPECT_LT(rows.unknowns.size(), discrete.load().size());
    const Vector u = both.random_function(1);
    Vector       Au = u, Bu, inside = u;
    inside = 0.;
    discrete.initialize_point_vector(Bu);
    discrete.apply_stiffness(Au, u);
    for (std::size_t k = 0; k < rows.unknowns.size(); ++k)
    {
      double sum = 0;
      for (std::size_t e = rows.A.start[k]; e < rows.A.start[k + 1]; ++e)
        sum += rows.A.values[e] * u(rows.A.columns[e]);
      EXPECT_NEAR(sum, Au(rows.unknowns[k]), 1e-12 * Au.linfty_norm());
      if (!both.assembled.problem->space.dirichlet.is_constrained(rows.unknowns[k]))
        inside(rows.unknowns[k]) = 1 + 0.1 * std::sin(k);
    }
    discrete.apply_trace(Bu, u);
    for (std::size_t q = 0; q < rows.points.size(); ++q)
    {
      double sum = 0;
      for (std::size_t e = rows.B.start[q]; e < rows.B.start[q + 1]; ++e)
        sum += rows.B.values[e] * u(rows.B.columns[e]);
      EXPECT_NEAR(sum, Bu(rows.points[q]), 1e-13);
    }
    // All points that see one of the unknowns are there, and whoever is next to the free boundary is seen.
    discrete.apply_trace(Bu, inside);
    for (std::size_t i = 0; i < Bu.size(); ++i)
    {
      const bool is_there = std::binary_search(rows.points.begin(), rows.points.end(), i);
      const bool is_at_end = std::abs(both.assembled.constraint_set.points[i].x[text.coordinate] - text.end) < 0.02;
      EXPECT_TRUE(is_there || Bu(i) == 0);
      EXPECT_TRUE(Bu(i) != 0 || !is_at_end);
    }
  }

  double energy(const AugmentedProblem &augmented, const Vector &u)
  {
    Vector gap(augmented.shift);
    augmented.shifted_gap(gap, u);
    double energy = energy_of(augmented.problem, u);
    for (std::size_t i = 0; i < gap.size(); ++i)
      if (gap(i) > 0)
        energy += 0.5 * augmented.problem.weights()(i) * gap(i) * gap(i) / (augmented.epsilon + augmented.shift(i));
    return energy;
  }

  template <int dim>
  void expect_relaxation(DiscreteProblem &discrete, const BothWays<dim> &both, const Text &text)
  {
    Vector   u = both.assembled.zero_dofs(), lambda = both.assembled.zero_points();
    Progress progress;
    ASSERT_TRUE(
      method_of_multipliers(discrete, {.tolerance = 1e-11, .shift = suitable_shift(text.at_nodes)}, {}, u, lambda, progress).converged);
    AugmentedProblem augmented{discrete, 0., discrete.compliance(), lambda};
    augmented.shift *= suitable_shift(text.at_nodes);
    const auto   contact = positive(lambda);
    const double size = u.linfty_norm(), least = energy(augmented, u);

    // The solution stays what it is.
    auto   found = contact;
    Vector v = u;
    relax_near_free_boundary(augmented, found, v);
    EXPECT_EQ(found, contact);
    v -= u;
    EXPECT_LT(v.linfty_norm(), 1e-8 * size);

    // A wrong contact and the function that belongs to it: the neighbours of each point of the contact are in contact too.
    const auto rows = discrete.rows_near_free_boundary(contact);
    ASSERT_FALSE(rows.unknowns.empty());
    auto wrong = contact;
    for (std::size_t k = 0; k < contact.size(); ++k)
      for (std::size_t i = 0; i < contact.size(); ++i)
        if (contact[k] && both.assembled.constraint_set.points[i].x.distance(both.assembled.constraint_set.points[k].x) < 0.13)
          wrong[i] = true;
    ASSERT_NE(wrong, contact);
    v = u;
    for (unsigned repetition = 0; repetition < 20; ++repetition)
      for (std::size_t i = 0; i < wrong.size(); ++i)
      {
        const auto row = both.assembled.constraint_set.trace[i];
        if (!wrong[i] || contact[i])
          continue;
        Vector trace = lambda;
        discrete.apply_trace(trace, v);
        double squares = 0;
        for (std::size_t k = 0; k < row.dofs.size(); ++k)
          squares += row.values[k] * row.values[k];
        for (std::size_t k = 0; k < row.dofs.size(); ++k)
          v(row.dofs[k]) -= both.assembled.constraint_set.points[i].sign * row.values[k] * (trace(i) - discrete.obstacle()(i)) / squares;
      }
    both.assembled.problem->space.dirichlet.set_zero(v);
    const double before = energy(augmented, v);
    ASSERT_GT(before, least);
    found = wrong;
    relax_near_free_boundary(augmented, found, v);
    EXPECT_LT(energy(augmented, v) - least, 0.5 * (before - least));
    const auto n_wrong = [&](const std::vector<bool> &set)
    {
      std::size_t n = 0;
      for (std::size_t i = 0; i < set.size(); ++i)
        n += set[i] != contact[i];
      return n;
    };
    EXPECT_LT(n_wrong(found), (text.at_nodes ? 0.3 : 0.5) * n_wrong(wrong));
  }
} // namespace

TEST_P(LocalRelaxation, has_the_rows_of_the_matrix)
{
  both_ways(
    [](const auto &both)
    {
      expect_rows(*both.assembled.discrete, both, GetParam());
      expect_rows(*both.matrix_free, both, GetParam());
    });
}

TEST_P(LocalRelaxation, finds_the_contact_near_a_wrong_one)
{
  both_ways(
    [](const auto &both)
    {
      expect_relaxation(*both.assembled.discrete, both, GetParam());
      expect_relaxation(*both.matrix_free, both, GetParam());
    });
}

INSTANTIATE_TEST_SUITE_P(All, LocalRelaxation, testing::ValuesIn(texts()), [](const auto &info) { return info.param.name; });
