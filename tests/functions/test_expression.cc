// Expressions at many points at a time, and their derivatives.
#include "unilateral/functions/compile_field.h"
#include "unilateral/functions/expression.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

using namespace unilateral;
using dealii::Point;
using dealii::Tensor;

namespace
{
  FieldFunction function(const std::string &text, const std::vector<Parameter> &parameters = {})
  {
    return compile_field(FieldSpec::expression(text), parameters);
  }

  /// More than a block of the evaluator, and no multiple of one.
  std::vector<Point<3>> random_points(const double low, const double high)
  {
    std::mt19937                           generator(7);
    std::uniform_real_distribution<double> coordinate(low, high);
    std::vector<Point<3>>                  points(2 * ExpressionColumn::n_points + 3);
    for (auto &p : points)
      for (unsigned d = 0; d < 3; ++d)
        p[d] = coordinate(generator);
    return points;
  }
} // namespace

TEST(ExpressionsInBulk, equal_the_values_at_single_points)
{
  const std::vector<Parameter> parameters = {{"r", FieldSpec::expression("sqrt(x^2 + y^2 + z^2)"), {}},
                                             {"a", FieldSpec::constant(0.5), {}},
                                             {"b", FieldSpec::expression("2*a"), {}},
                                             {"s", FieldSpec::expression("r > b ? r/b : sin(r)"), {}}};
  const auto                   points = random_points(-2, 2);
  for (const char *const text : {"1", "x", "s^2 - 3*exp(-y)", "if(r < a, 1/2, 1/2 - (r^2 + 2*a^3/max(r, a, z) - 3*a^2))",
                                 "min(x, y, z, r, s, b)", "x < 0 && y < 0 || z < 0 ? x : y < 0 ? y : z", "-x^2 + 2^-y^2"})
  {
    const FieldFunction       f = function(text, parameters);
    std::vector<double>       values, again;
    std::vector<Tensor<1, 3>> gradients;
    f.values(points, values);
    f.values_and_gradients(points, again, gradients);
    for (std::size_t i = 0; i < points.size(); ++i)
    {
      EXPECT_EQ(values[i], f.value(points[i])) << text;
      EXPECT_EQ(again[i], values[i]) << text;
      EXPECT_EQ(gradients[i], f.gradient(points[i])) << text;
    }
  }
}

// Every function of one argument and of two, by differences of fourth order in its domain.
TEST(ExpressionDerivatives, agree_with_differences)
{
  for (const ExpressionFunction &known : expression_functions())
  {
    const bool        above_one = known.name == "acosh";
    const std::string a = above_one ? "1.5 + x*y" : "0.1 + 0.8*x*y", b = "0.3 + y + z/2";
    std::string       arguments = a;
    if (known.n_arguments == 2 || known.n_arguments == 0)
      arguments = a + ", " + b;
    else if (known.n_arguments == 3)
      arguments = known.name == "if" ? "x > y, " + a + ", " + b : a + ", 0.2*z, 0.9 + z";
    const FieldFunction f = function(known.name + "(" + arguments + ")");
    for (const Point<3> &p : random_points(0.1, 0.9))
    {
      const Tensor<1, 3> gradient = f.gradient(p);
      for (unsigned d = 0; d < 3; ++d)
      {
        const double h = 1e-4;
        const auto   at = [&](const double steps)
        {
          Point<3> q = p;
          q[d] += steps * h;
          return f.value(q);
        };
        const double near = (at(1) - at(-1)) / (2 * h), far = (at(2) - at(-2)) / (4 * h);
        if (std::abs(near - far) > 1e-4 * (1 + std::abs(near)))
          continue; // a jump or a kink in between
        EXPECT_NEAR(gradient[d], (4 * near - far) / 3, 1e-9 * (1 + std::abs(near))) << known.name << " at " << p;
      }
    }
  }
}

TEST(ExpressionDerivatives, are_exact)
{
  const Point<3> p(0.7, -1.3, 2.1);
  const auto     expect = [&](const std::string &text, const double by_x, const double by_y, const double by_z)
  {
    const Tensor<1, 3> gradient = function(text).gradient(p);
    EXPECT_DOUBLE_EQ(gradient[0], by_x) << text;
    EXPECT_DOUBLE_EQ(gradient[1], by_y) << text;
    EXPECT_DOUBLE_EQ(gradient[2], by_z) << text;
  };
  const double x = p[0], y = p[1], z = p[2];
  expect("3", 0, 0, 0);
  expect("x*y*z", y * z, x * z, x * y);
  expect("x/z - y", 1 / z, -1, -x / (z * z));
  expect("-x^2 + z^3", -2 * x, 0, 3 * z * z);
  expect("exp(x)*cos(y)", std::exp(x) * std::cos(y), -std::exp(x) * std::sin(y), 0);
  expect("z > 2 ? x^2 : sqrt(-1)", 2 * x, 0, 0);
  expect("2^z", 0, 0, std::exp2(z) * std::log(2.));
}

TEST(Expression, FunctionsOfManyArguments)
{
  const auto f = function("max(x, 2 - x, 0.5, 3*x - 1, 0, -x, x^2)");
  EXPECT_EQ(f.value(Point<1>(0.25)), 1.75);
  EXPECT_EQ(f.gradient(Point<1>(0.25))[0], -1);
  EXPECT_EQ(f.value(Point<1>(1)), 2);
  EXPECT_EQ(f.value(Point<1>(2)), 5);
  EXPECT_EQ(f.gradient(Point<1>(2))[0], 3);
}

// a - b floor(a/b) is rounded twice: in one rounding it would be negative here.
TEST(Expression, RemaindersAreNotNegative)
{
  EXPECT_EQ(function("mod(x, 0.1)").value(Point<1>(1)), 0);
  for (unsigned k = 0; k < 256; ++k)
    EXPECT_GE(function("mod(x, 0.1)").value(Point<1>(0.1 * k)), 0) << k;
}

// A value does not depend on the points beside it.
TEST(Expression, ManyPointsAreWorthWhatEachIs)
{
  const auto            f = function("hypot(x, y)");
  std::vector<Point<2>> points = {{0, 0}, {1e-200, 1e-200}, {1e200, 1}};
  for (unsigned k = 1; k < 200; ++k)
    points.emplace_back(0.1 * k, 0.37 + 0.01 * k * k);
  std::vector<double> values;
  f.values(points, values);
  for (std::size_t i = 0; i < points.size(); ++i)
  {
    EXPECT_EQ(values[i], f.value(points[i])) << i;
    EXPECT_NEAR(values[i], std::hypot(points[i][0], points[i][1]), 1e-15 * values[i]) << i;
  }
}

// The derivative of what is not taken may be anything; and r has a gradient of 0 at its tip, as central differences have.
TEST(ExpressionDerivatives, at_singular_points)
{
  EXPECT_DOUBLE_EQ(function("if(x < 1, sqrt(1 - x^2), -10*x)").gradient(Point<1>(2))[0], -10);
  EXPECT_EQ(function("sqrt(x^2 + y^2)").gradient(Point<2>(0, 0)).norm(), 0);
  EXPECT_EQ(function("sqrt(max(0, 1 - x^2))").gradient(Point<1>(2))[0], 0);
  // Where the value ends, or the slope is infinite, the difference to one side serves.
  const double slope = function("sqrt(x)").gradient(Point<1>(0))[0];
  EXPECT_TRUE(std::isfinite(slope));
  EXPECT_GT(slope, 100);
}

TEST(ExpressionDerivatives, second_ones_have_ten_digits)
{
  const FieldFunction f = function("sin(2*x)*exp(y)");
  const Point<2>      p(0.3, 0.4);
  const auto          second = f.hessian(p);
  EXPECT_NEAR(second[0][0], -4 * std::sin(0.6) * std::exp(0.4), 1e-9);
  EXPECT_NEAR(second[0][1], 2 * std::cos(0.6) * std::exp(0.4), 1e-9);
  EXPECT_EQ(second[0][1], second[1][0]);
  EXPECT_NEAR(second[1][1], std::sin(0.6) * std::exp(0.4), 1e-9);
}

TEST(Expressions, bessel_functions_of_the_first_kind)
{
  const auto value = [](const std::string &text) { return function(text).value(Point<1>()); };
  // Abramowitz and Stegun, tables 9.1 and 9.5.
  EXPECT_NEAR(value("j0(1)"), 0.7651976865579666, 1e-15);
  EXPECT_NEAR(value("j1(1)"), 0.4400505857449335, 1e-15);
  EXPECT_NEAR(value("j0(2.404825557695773)"), 0, 1e-15);
  EXPECT_NEAR(value("j1(-3.831705970207512)"), 0, 1e-15);
}

TEST(Expressions, a_blank_before_the_parenthesis_and_constant_conditions)
{
  EXPECT_DOUBLE_EQ(function("sin (x)").value(Point<1>(0.5)), std::sin(0.5));
  EXPECT_EQ(function("1.75 && 0.25").value(Point<1>(0)), 1);
  EXPECT_EQ(function("0.5 || 0").value(Point<1>(0)), 1);
  EXPECT_EQ(function("0.5 && 0").value(Point<1>(0)), 0);
}

TEST(Expressions, constant_parts_are_computed_once)
{
  const std::vector<Parameter> parameters = {{"a", FieldSpec::constant(3), {}}, {"b", FieldSpec::expression("a^2 + 1"), {}}};
  EXPECT_TRUE(Expression(FieldSpec::expression("sqrt(b - 1) + pi*0"), parameters).is_constant());
  EXPECT_DOUBLE_EQ(Expression(FieldSpec::expression("sqrt(b - 1)"), parameters).value(0, 0, 0), 3);
  EXPECT_FALSE(Expression(FieldSpec::expression("b*x"), parameters).is_constant());
}

// As deep as a text can be.
TEST(Expressions, nest_as_deep_as_the_text_is_long)
{
  std::string nested, sum, powers = "1";
  for (unsigned i = 0; i < 4000; ++i)
    nested += "(";
  nested += "x" + std::string(4000, ')');
  EXPECT_EQ(function(nested).value(Point<1>(2)), 2);
  for (unsigned i = 0; i < 2400; ++i)
    sum += "x+(";
  sum += "1" + std::string(2400, ')');
  EXPECT_EQ(function(sum).value(Point<1>(2)), 4801);
  for (unsigned i = 0; i < 4000; ++i)
    powers += "^x";
  EXPECT_EQ(function(powers).value(Point<1>(2)), 1);
}
