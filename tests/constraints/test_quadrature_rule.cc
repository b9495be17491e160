// I_G by name: weights, refusals, defaults and the exactness test (14).
#include "unilateral/constraints/quadrature_rule.h"

#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>
#include <string>
#include <vector>

namespace
{
  using namespace unilateral;
  using Family = RuleName::Family;

  ElementName element(const std::string &name)
  {
    return parse_element(name).value();
  }

  RuleName rule(const std::string &name)
  {
    return parse_rule(name).value();
  }

  template <int dim>
  double sum_of_weights(const std::string &rule_name, const std::string &element_name)
  {
    const auto quadrature = quadrature_rule<dim>(rule(rule_name), element(element_name));
    double     sum = 0;
    for (const double w : quadrature.get_weights())
      sum += w;
    return sum;
  }

  template <int dim>
  bool refused(const std::string &rule_name, const std::string &element_name, const std::string &reason)
  {
    try
    {
      quadrature_rule<dim>(rule(rule_name), element(element_name));
    }
    catch (const std::invalid_argument &refusal)
    {
      EXPECT_NE(std::string(refusal.what()).find(reason), std::string::npos) << refusal.what();
      return true;
    }
    return false;
  }

  template <int dim>
  void expect_default_is_positive(const std::string &element_name, const double volume)
  {
    const ElementName e = element(element_name);
    const auto        quadrature = quadrature_rule<dim>(default_rule(e, dim), e);
    double            sum = 0;
    for (const double w : quadrature.get_weights())
    {
      EXPECT_GT(w, 0) << element_name << " in dimension " << dim;
      sum += w;
    }
    EXPECT_NEAR(sum, volume, 1e-14) << element_name << " in dimension " << dim;
  }

  /// All rules, on elements of all degrees; a name need not know weights to tell their sign.
  template <int dim>
  void expect_fitting_rules_are_positive()
  {
    std::vector<RuleName> rules;
    for (const Family family : {Family::nodal, Family::midpoint, Family::trapezoid, Family::simpson, Family::edges})
      rules.push_back({family, 0});
    for (unsigned n = 1; n <= 20; ++n)
      rules.push_back({Family::gauss, n});
    for (unsigned n = 2; n <= 20; ++n)
      rules.push_back({Family::lobatto, n});
    for (const ElementName::Family family : {ElementName::Family::Q, ElementName::Family::P})
      for (unsigned degree = 1; degree <= 8; ++degree)
        for (const RuleName &rule : rules)
        {
          const ElementName element{family, degree};
          if (!why_rule_does_not_fit(rule, element, dim).empty())
            continue;
          const auto quadrature = quadrature_rule<dim>(rule, element);
          for (const double w : quadrature.get_weights())
            ASSERT_GT(w, 1e-12) << rule.name() << " on " << element.name() << " in dimension " << dim;
        }
  }

  /// The degree to which a rule integrates the monomials x^a y^b z^c of total degree a + b + c on the reference simplex.
  template <int dim>
  unsigned degree_on_simplex(const dealii::Quadrature<dim> &quadrature)
  {
    for (unsigned degree = 0;; ++degree)
      for (unsigned a = 0; a <= degree; ++a)
        for (unsigned b = 0; b <= degree - a; ++b)
        {
          const unsigned c = degree - a - b;
          if (dim == 2 && c > 0)
            continue;
          double sum = 0;
          for (unsigned q = 0; q < quadrature.size(); ++q)
            sum += quadrature.weight(q) * std::pow(quadrature.point(q)[0], a) * std::pow(quadrature.point(q)[1], b) *
                   (dim == 3 ? std::pow(quadrature.point(q)[dim - 1], c) : 1);
          const double exact = std::tgamma(a + 1.) * std::tgamma(b + 1.) * std::tgamma(c + 1.) / std::tgamma(degree + dim + 1.);
          if (std::abs(sum - exact) > 1e-13)
            return degree - 1;
        }
  }
} // namespace

TEST(QuadratureRule, every_name_is_read_back)
{
  for (const std::string name :
       {"nodal", "midpoint", "trapezoid", "simpson", "edges", "gauss(1)", "gauss(2)", "gauss(20)", "lobatto(2)", "lobatto(20)"})
  {
    ASSERT_TRUE(parse_rule(name)) << name;
    EXPECT_EQ(parse_rule(name)->name(), name);
  }
  EXPECT_EQ(parse_rule(" gauss( 3 ) ")->name(), "gauss(3)");
  EXPECT_EQ(parse_rule("lobatto(4)")->family, Family::lobatto);
  EXPECT_EQ(parse_rule("lobatto(4)")->n, 4u);
}

TEST(QuadratureRule, other_names_are_not_rules)
{
  for (const std::string name : {"", "gauss", "gauss()", "gauss(0)", "gauss(21)", "gauss(-1)", "gauss(2.5)", "gauss(100)", "lobatto(1)",
                                 "lobatto(21)", "Nodal", "nodal()", "midpoint(1)", "gauss(2)x"})
    EXPECT_FALSE(parse_rule(name)) << name;
  for (const std::string name : {"gauss(0)", "gauss(21)", "gauss(-1)", "gauss(1000000000000)"})
    EXPECT_NE(why_no_rule(name).find("between 1 and 20"), std::string::npos) << why_no_rule(name);
  EXPECT_NE(why_no_rule("lobatto(1)").find("between 2 and 20"), std::string::npos);
  EXPECT_NE(why_no_rule("gaus(3)").find("unknown"), std::string::npos);
}

TEST(QuadratureRule, weights_sum_to_the_volume)
{
  for (const std::string name : {"nodal", "gauss(1)", "gauss(3)", "lobatto(2)", "lobatto(5)", "midpoint", "trapezoid", "simpson"})
    for (const std::string e : {"Q1", "Q2", "Q5"})
    {
      EXPECT_NEAR(sum_of_weights<1>(name, e), 1., 1e-14) << name << " " << e;
      EXPECT_NEAR(sum_of_weights<2>(name, e), 1., 1e-14) << name << " " << e;
      EXPECT_NEAR(sum_of_weights<3>(name, e), 1., 1e-14) << name << " " << e;
    }
  for (const std::string name : {"gauss(1)", "gauss(2)", "gauss(3)", "gauss(4)", "midpoint", "trapezoid", "edges"})
    EXPECT_NEAR(sum_of_weights<2>(name, "P2"), 1. / 2, 1e-12) << name;
  for (const std::string name : {"gauss(1)", "gauss(2)", "gauss(3)", "midpoint", "trapezoid", "edges"})
    EXPECT_NEAR(sum_of_weights<3>(name, "P2"), 1. / 6, 1e-12) << name;
  for (const std::string name : {"nodal", "gauss(2)", "lobatto(3)", "midpoint", "trapezoid", "simpson", "edges"})
    EXPECT_NEAR(sum_of_weights<1>(name, "P1"), 1., 1e-14) << name;
  EXPECT_EQ(sum_of_weights<0>("nodal", "Q1"), 1.);
}

TEST(QuadratureRule, degrees_of_the_rules_on_simplices)
{
  for (const unsigned n : {1u, 2u, 3u, 4u})
    EXPECT_GE(degree_on_simplex(quadrature_rule<2>({Family::gauss, n}, element("P1"))), 2 * n - 1) << n;
  for (const unsigned n : {1u, 2u, 3u})
    EXPECT_GE(degree_on_simplex(quadrature_rule<3>({Family::gauss, n}, element("P1"))), 2 * n - 1) << n;
  EXPECT_EQ(degree_on_simplex(quadrature_rule<2>(rule("nodal"), element("P1"))), 1u);
  EXPECT_EQ(degree_on_simplex(quadrature_rule<2>(rule("edges"), element("P2"))), 2u);
  EXPECT_EQ(degree_on_simplex(quadrature_rule<2>(rule("nodal"), element("P3"))), 3u);
  EXPECT_EQ(degree_on_simplex(quadrature_rule<3>(rule("midpoint"), element("P1"))), 1u);
  EXPECT_EQ(degree_on_simplex(quadrature_rule<3>(rule("edges"), element("P2"))), 1u);
}

TEST(QuadratureRule, rules_whose_weights_are_not_positive_are_refused)
{
  EXPECT_TRUE(refused<2>("nodal", "P2", "zero weights"));
  EXPECT_TRUE(refused<3>("nodal", "P2", "negative weights"));
  EXPECT_TRUE(refused<3>("nodal", "P3", "zero weights"));
}

TEST(QuadratureRule, rules_that_fit_have_positive_weights)
{
  expect_fitting_rules_are_positive<1>();
  expect_fitting_rules_are_positive<2>();
  expect_fitting_rules_are_positive<3>();
}

TEST(QuadratureRule, rules_that_do_not_fit_the_cell_are_refused)
{
  EXPECT_TRUE(refused<2>("lobatto(3)", "P1", "not defined on triangles"));
  EXPECT_TRUE(refused<3>("lobatto(3)", "P1", "not defined on triangles and tetrahedra"));
  EXPECT_TRUE(refused<2>("simpson", "P2", "not defined on triangles"));
  EXPECT_TRUE(refused<2>("gauss(5)", "P2", "not available on triangles"));
  EXPECT_TRUE(refused<3>("gauss(5)", "P2", "not available on triangles and tetrahedra"));
  EXPECT_TRUE(refused<2>("edges", "Q2", "triangles and tetrahedra only"));
}

TEST(QuadratureRule, the_refusal_names_a_rule_that_works)
{
  EXPECT_TRUE(refused<2>("nodal", "P2", "'edges'"));
  EXPECT_TRUE(refused<3>("nodal", "P2", "'edges'"));
}

TEST(QuadratureRule, default_is_positive_for_every_element)
{
  for (unsigned p = 1; p <= 8; ++p)
  {
    const std::string Q = "Q" + std::to_string(p);
    expect_default_is_positive<1>(Q, 1);
    expect_default_is_positive<2>(Q, 1);
    expect_default_is_positive<3>(Q, 1);
  }
  for (unsigned p = 1; p <= 3; ++p)
  {
    const std::string P = "P" + std::to_string(p);
    expect_default_is_positive<1>(P, 1);
    expect_default_is_positive<2>(P, 1. / 2);
    expect_default_is_positive<3>(P, 1. / 6);
  }
}

// Equation (14): Gauss with G points a direction iff G >= p, Lobatto iff G >= p + 2; in Q_p direction by direction.
TEST(ExactPairing, gauss_iff_as_many_points_as_the_degree)
{
  for (unsigned p = 1; p <= 5; ++p)
    for (unsigned G = 1; G <= 6; ++G)
    {
      const ElementName Q = element("Q" + std::to_string(p));
      const RuleName    gauss{Family::gauss, G};
      EXPECT_EQ(exact_pairing<1>(gauss, Q), G >= p) << "Q" << p << ", G = " << G;
      EXPECT_EQ(exact_pairing<2>(gauss, Q), G >= p) << "Q" << p << ", G = " << G;
      if (p <= 3 && G <= 4)
      {
        EXPECT_EQ(exact_pairing<3>(gauss, Q), G >= p) << "Q" << p << ", G = " << G;
      }
    }
}

TEST(ExactPairing, lobatto_iff_two_points_more_than_the_degree)
{
  for (unsigned p = 1; p <= 4; ++p)
    for (unsigned G = 2; G <= 6; ++G)
    {
      const ElementName Q = element("Q" + std::to_string(p));
      const RuleName    lobatto{Family::lobatto, G};
      EXPECT_EQ(exact_pairing<1>(lobatto, Q), G >= p + 2) << "Q" << p << ", G = " << G;
      EXPECT_EQ(exact_pairing<2>(lobatto, Q), G >= p + 2) << "Q" << p << ", G = " << G;
      if (p <= 2 && G <= 4)
      {
        EXPECT_EQ(exact_pairing<3>(lobatto, Q), G >= p + 2) << "Q" << p << ", G = " << G;
      }
    }
}

TEST(ExactPairing, rules_with_a_name_of_their_own)
{
  for (unsigned p = 1; p <= 4; ++p)
  {
    const ElementName Q = element("Q" + std::to_string(p));
    EXPECT_FALSE(exact_pairing<1>(rule("nodal"), Q)) << p; // p + 1 Lobatto points
    EXPECT_FALSE(exact_pairing<2>(rule("nodal"), Q)) << p;
    EXPECT_EQ(exact_pairing<1>(rule("midpoint"), Q), p == 1);
    EXPECT_EQ(exact_pairing<2>(rule("midpoint"), Q), p == 1);
    EXPECT_FALSE(exact_pairing<1>(rule("trapezoid"), Q)) << p;
    EXPECT_EQ(exact_pairing<1>(rule("simpson"), Q), p == 1);
    EXPECT_EQ(exact_pairing<2>(rule("simpson"), Q), p == 1);
  }
}

TEST(ExactPairing, on_triangles_and_tetrahedra)
{
  // One point: P_0 against P_1 needs degree 1. Three edge midpoints: P_1 against P_p needs degree p + 1, the rule has 2 (in 2-D).
  EXPECT_TRUE(exact_pairing<2>(rule("midpoint"), element("P1")));
  EXPECT_TRUE(exact_pairing<3>(rule("midpoint"), element("P1")));
  EXPECT_FALSE(exact_pairing<2>(rule("midpoint"), element("P2")));
  EXPECT_TRUE(exact_pairing<2>(rule("edges"), element("P1")));
  EXPECT_FALSE(exact_pairing<2>(rule("edges"), element("P2")));
  EXPECT_FALSE(exact_pairing<3>(rule("edges"), element("P1"))); // six points belong to no P_k
  EXPECT_FALSE(exact_pairing<2>(rule("nodal"), element("P1")));
  EXPECT_FALSE(exact_pairing<3>(rule("nodal"), element("P1")));
  EXPECT_FALSE(exact_pairing<2>(rule("nodal"), element("P3")));
  // The rule of degree 3 on tetrahedra has no P_k of its size or one that it cannot pair with P_3.
  EXPECT_FALSE(exact_pairing<3>(rule("gauss(2)"), element("P3")));
}

TEST(ExactPairing, on_segments_triangular_elements_are_the_same)
{
  for (unsigned p = 1; p <= 3; ++p)
    for (unsigned G = 1; G <= 4; ++G)
      EXPECT_EQ(exact_pairing<1>({Family::gauss, G}, element("P" + std::to_string(p))), G >= p) << p << " " << G;
  EXPECT_TRUE(exact_pairing<0>(rule("nodal"), element("Q1")));
}
