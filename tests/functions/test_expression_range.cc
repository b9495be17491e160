// Interval arithmetic of expressions: every value in a box lies in the range, and the range shrinks with the box.
#include "unilateral/functions/expression.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <random>
#include <string>
#include <vector>

namespace
{
  using namespace unilateral;

  Expression compile(const std::string &text, const std::vector<Parameter> &parameters = {})
  {
    return Expression(FieldSpec::expression(text), parameters);
  }

  const std::string smooth[] = {"x",
                                "-x*y + z",
                                "x^2 - 2*x*y",
                                "x^3",
                                "1/(2 + x)",
                                "sqrt(1 + x^2)",
                                "exp(-x^2)",
                                "log(2 + x)",
                                "sin(3*x + y)",
                                "cos(7*x)",
                                "tan(x/2)",
                                "atan(x)",
                                "atan2(y, 2 + x)",
                                "hypot(x, y)",
                                "tanh(9*x)",
                                "cosh(x)*sinh(y)",
                                "pow(2 + x, y)",
                                "x^(-2) + 1",
                                "j0(20*x)*j1(5*y)",
                                "erf(x) + erfc(y)",
                                "cbrt(x)",
                                "min(x, y, z)",
                                "max(x, 0.2)",
                                "clamp(x, -0.3, y)",
                                "avg(x, y) + sum(x, y, z)",
                                "abs(x)",
                                "asin(x/2)",
                                "acos(y/2)",
                                "acosh(2 + x)",
                                "asinh(x)",
                                "atanh(x/2)",
                                "log2(3 + x) + log10(2 + y)",
                                "2^x",
                                "x/(y + 3)"};

  const std::string jumping[] = {"if(x > 0.1, 1, 2*y)",
                                 "if(x > 0.1 && y <= 0, 1, x)",
                                 "if(x > 0.1 || y < z, 3, x)",
                                 "floor(3*x) + ceil(y)",
                                 "mod(x, 0.3)",
                                 "sign(x)*round(2*y)",
                                 "if(x == y, 1, 0)",
                                 "if(x != y, 1, 0)",
                                 "cot(x)",
                                 "x >= y"};

  /// Every third one is small.
  std::array<Interval, 3> random_box(std::mt19937 &generator, const unsigned n)
  {
    std::uniform_real_distribution<double> place(-1, 1), size(0, 0.5);
    std::array<Interval, 3>                box;
    for (Interval &side : box)
    {
      const double begin = place(generator);
      side = {begin, std::min(1., begin + (n % 3 == 0 ? 0.01 : 1) * size(generator))};
    }
    return box;
  }

  /// Whether all of @p n values in random boxes lie in the range.
  void expect_enclosure(const std::string &text)
  {
    const Expression                       f = compile(text);
    std::mt19937                           generator(3);
    std::uniform_real_distribution<double> part(0, 1);
    for (unsigned n = 0; n < 200; ++n)
    {
      const auto box = random_box(generator, n);
      const auto range = f.range(box);
      ASSERT_TRUE(range) << text;
      for (unsigned k = 0; k < 20; ++k)
      {
        std::array<double, 3> x;
        for (unsigned d = 0; d < 3; ++d)
          x[d] = box[d].least + (k < 2 ? k : part(generator)) * (box[d].most - box[d].least);
        const double value = f.value(x[0], x[1], x[2]);
        if (std::isnan(value))
          continue;
        const double rounding = 1e-12 * std::max(1., std::abs(value));
        EXPECT_LE(range->least, value + rounding) << text << " at " << x[0] << ' ' << x[1] << ' ' << x[2];
        EXPECT_GE(range->most, value - rounding) << text << " at " << x[0] << ' ' << x[1] << ' ' << x[2];
      }
    }
  }
} // namespace

TEST(ExpressionRange, contains_every_value)
{
  for (const std::string &text : smooth)
    expect_enclosure(text);
  for (const std::string &text : jumping)
    expect_enclosure(text);
}

TEST(ExpressionRange, slopes_lead_from_any_point_to_any_other)
{
  std::vector<std::string> all(std::begin(smooth), std::end(smooth));
  all.insert(all.end(), std::begin(jumping), std::end(jumping));
  for (const std::string &text : all)
  {
    const Expression                       f = compile(text);
    std::mt19937                           generator(4);
    std::uniform_real_distribution<double> part(0, 1);
    for (unsigned n = 0; n < 200; ++n)
    {
      const auto box = random_box(generator, n);
      const auto set = f.range_and_slopes(box);
      const auto range = f.range(box);
      ASSERT_TRUE(set && range) << text;
      EXPECT_EQ(set->value.least, range->least) << text;
      EXPECT_EQ(set->value.most, range->most) << text;
      for (unsigned k = 0; k < 20; ++k)
      {
        std::array<double, 3> a, b;
        Interval              change;
        for (unsigned d = 0; d < 3; ++d)
        {
          a[d] = box[d].least + (k < 2 ? k : part(generator)) * (box[d].most - box[d].least);
          b[d] = box[d].least + (k < 2 ? 1 - k : part(generator)) * (box[d].most - box[d].least);
          change = change + set->slopes[d] * Interval::of(b[d] - a[d]);
        }
        const double difference = f.value(b[0], b[1], b[2]) - f.value(a[0], a[1], a[2]);
        if (std::isnan(difference))
          continue;
        const double rounding = 1e-11 * std::max(1., std::abs(difference));
        EXPECT_LE(change.least, difference + rounding) << text << " from " << a[0] << ' ' << a[1] << " to " << b[0] << ' ' << b[1];
        EXPECT_GE(change.most, difference - rounding) << text << " from " << a[0] << ' ' << a[1] << " to " << b[0] << ' ' << b[1];
      }
    }
  }
}

TEST(ExpressionRange, slopes_are_the_derivatives_where_the_box_is_small)
{
  const std::array<Interval, 3> box = {Interval{0.4, 0.4 + 1e-7}, {-0.3, -0.3 + 1e-7}, {0.2, 0.2 + 1e-7}};
  for (const std::string &text : smooth)
  {
    if (text.find("j1") != std::string::npos) // whose slope is bounded by its largest one
      continue;
    const Expression                     f = compile(text);
    const std::array<double, 3>          x = {0.4, -0.3, 0.2};
    double                               value = 0;
    std::array<std::array<double, 3>, 1> gradient;
    f.values({&x, 1}, {&value, 1}, gradient);
    const auto set = f.range_and_slopes(box);
    for (unsigned d = 0; d < 3; ++d)
    {
      EXPECT_NEAR(set->slopes[d].least, gradient[0][d], 1e-4) << text;
      EXPECT_NEAR(set->slopes[d].most, gradient[0][d], 1e-4) << text;
    }
  }
}

TEST(ExpressionRange, has_slopes_in_a_branch_of_if)
{
  const std::array<Interval, 3> box = {Interval{0.4, 0.4 + 1e-7}, {-0.3, -0.3 + 1e-7}, {0, 0}};
  for (const std::string text :
       {"if(x < 0.9, sqrt(1 - x^2), 7)", "if(x > 0.9, sqrt(x - 0.9), sqrt(1 - x^2))", "if(x > 0, if(y > 0, 1/y, sqrt(1 - x^2)), y)"})
  {
    const auto set = compile(text).range_and_slopes(box);
    EXPECT_FALSE(set->value.undefined) << text;
    EXPECT_NEAR(set->slopes[0].least, -0.4 / std::sqrt(0.84), 1e-5) << text;
    EXPECT_NEAR(set->slopes[0].most, -0.4 / std::sqrt(0.84), 1e-5) << text;
  }
  EXPECT_TRUE(compile("if(sqrt(-x) > 1, 1, 2)").range(box)->undefined);
  EXPECT_TRUE(compile("if(x > 0.4 + 5e-8, sqrt(-x), 2)").range(box)->undefined);
  EXPECT_TRUE(compile("max(x, sqrt(-x))").range(box)->undefined);
}

TEST(ExpressionRange, shrinks_with_the_box)
{
  for (const std::string &text : smooth)
  {
    const Expression        f = compile(text);
    std::array<Interval, 3> box = {Interval{0.4, 0.4 + 1e-6}, {-0.3, -0.3 + 1e-6}, {0.2, 0.2 + 1e-6}};
    const auto              range = f.range(box);
    ASSERT_TRUE(range) << text;
    EXPECT_LT(range->most - range->least, 1e-4) << text;
  }
}

TEST(ExpressionRange, is_a_number_beside_jumps)
{
  std::array<Interval, 3> box = {Interval{0.4, 0.4 + 1e-6}, {-0.3, -0.3 + 1e-6}, {0.2, 0.2 + 1e-6}};
  for (const std::string &text : jumping)
  {
    const auto range = compile(text).range(box);
    ASSERT_TRUE(range) << text;
    EXPECT_LT(range->most - range->least, 1e-4) << text;
  }
}

TEST(ExpressionRange, of_every_function)
{
  for (const ExpressionFunction &function : expression_functions())
  {
    EXPECT_NE(function.range, nullptr) << function.name;
    EXPECT_TRUE(function.slopes) << function.name;
  }
  for (const std::string &comparison : {"<", "<=", ">", ">=", "==", "!=", "&&", "||"})
  {
    EXPECT_NE(find_comparison(comparison)->range, nullptr) << comparison;
    EXPECT_TRUE(find_comparison(comparison)->slopes) << comparison;
  }
}

TEST(ExpressionRange, where_an_argument_has_no_value)
{
  for (const std::string &text : {"min(2, sqrt(x))", "max(sqrt(x), -5)", "if(sqrt(x) < 0.1, 1, 5)", "clamp(log(x), -1, y)", "sqrt(x) != 3",
                                  "if(asin(3*x) > 0 || y > 0, 7, x)"})
    expect_enclosure(text);
}

TEST(ExpressionRange, of_numbers_is_the_value)
{
  for (const std::string &text : smooth)
  {
    const Expression f = compile(text);
    const double     value = f.value(0.4, -0.3, 0.2);
    const auto       range = f.range({Interval::of(0.4), Interval::of(-0.3), Interval::of(0.2)});
    EXPECT_NEAR(range->least, value, 1e-12) << text;
    EXPECT_NEAR(range->most, value, 1e-12) << text;
  }
}

TEST(ExpressionRange, goes_through_parameters)
{
  Parameter r;
  r.name = "r";
  r.value = FieldSpec::expression("hypot(x, y)");
  const auto range = compile("if(r < 1, 5, 1/r)", {r}).range({Interval{1.5, 2}, {0, 0}, {0, 0}});
  ASSERT_TRUE(range);
  EXPECT_NEAR(range->least, 0.5, 1e-12);
  EXPECT_NEAR(range->most, 1 / 1.5, 1e-12);
}

TEST(ExpressionRange, where_there_is_no_value)
{
  EXPECT_TRUE(compile("sqrt(x)").range({Interval{-2, -1}, {}, {}})->empty());
  EXPECT_EQ(compile("sqrt(x)").range({Interval{-2, 4}, {}, {}})->most, 2);
  EXPECT_EQ(compile("1/x").range({Interval{-1, 1}, {}, {}})->most, Interval::infinity);
  EXPECT_EQ(compile("log(x)").range({Interval{0, 1}, {}, {}})->least, -Interval::infinity);
}
