#include "unilateral/functions/expression_slopes.h"

#include "unilateral/functions/expression_intervals.h"

#include <cmath>
#include <map>
#include <numbers>
#include <vector>

namespace unilateral
{
  namespace
  {
    using Argument = const IntervalWithSlopes *;

    Interval number(const double value)
    {
      return Interval::of(value);
    }

    /// Where a function may have no value or jump, its slopes may be anything.
    IntervalWithSlopes checked(IntervalWithSlopes a)
    {
      for (Interval &slope : a.slopes)
        if (a.value.undefined || slope.empty() || std::isnan(slope.least) || std::isnan(slope.most))
          slope = Interval::all();
        else
          slope.undefined = false;
      return a;
    }

    Interval value_of(const std::string &name, const Interval &a)
    {
      return find_interval_function(name)(&a, 1);
    }

    Interval value_of(const std::string &name, const Argument a, const unsigned n)
    {
      std::vector<Interval> values;
      for (unsigned k = 0; k < n; ++k)
        values.push_back(a[k].value);
      return find_interval_function(name)(values.data(), n);
    }

    /// @p derivative on the values of @p a.
    IntervalWithSlopes chain(const Interval &value, const Interval &derivative, const IntervalWithSlopes &a)
    {
      IntervalWithSlopes result{value, {}};
      for (unsigned d = 0; d < 3; ++d)
        result.slopes[d] = derivative * a.slopes[d];
      return checked(result);
    }

    /// With partial derivatives for both arguments.
    IntervalWithSlopes
    chain(const Interval &value, const Interval &first, const IntervalWithSlopes &a, const Interval &second, const IntervalWithSlopes &b)
    {
      IntervalWithSlopes result{value, {}};
      for (unsigned d = 0; d < 3; ++d)
        result.slopes[d] = first * a.slopes[d] + second * b.slopes[d];
      return checked(result);
    }

    /// Constant between jumps.
    IntervalWithSlopes piecewise_constant(const Interval &value)
    {
      IntervalWithSlopes result{value, {}};
      if (!value.is_number())
        result.slopes.fill(Interval::all());
      return checked(result);
    }

    /// One or another of continuous functions.
    IntervalWithSlopes one_of(const Interval &value, const std::vector<Argument> &arguments)
    {
      IntervalWithSlopes result{value, arguments.front()->slopes};
      for (const Argument argument : arguments)
        for (unsigned d = 0; d < 3; ++d)
          result.slopes[d] = hull(result.slopes[d], argument->slopes[d]);
      return checked(result);
    }

    /// @p sign 1: the largest, -1: the smallest of the arguments.
    IntervalWithSlopes extreme(const Interval &value, const Argument a, const unsigned n, const int sign)
    {
      const auto lower = [&](const unsigned k) { return sign > 0 ? a[k].value.least : -a[k].value.most; };
      const auto upper = [&](const unsigned k) { return sign > 0 ? a[k].value.most : -a[k].value.least; };
      double     largest = lower(0);
      for (unsigned k = 1; k < n; ++k)
        largest = std::max(largest, lower(k));
      std::vector<Argument> candidates;
      for (unsigned k = 0; k < n; ++k)
        if (upper(k) >= largest)
          candidates.push_back(a + k);
      if (candidates.empty())
        candidates.push_back(a);
      return one_of(value, candidates);
    }

    IntervalWithSlopes slopes_of_clamp(const Argument a, const unsigned n)
    {
      const Interval &x = a[0].value, &low = a[1].value, &high = a[2].value;
      if (low.most > high.least) // it jumps where the limits are the wrong way round
      {
        IntervalWithSlopes result{value_of("clamp", a, n), {}};
        result.slopes.fill(Interval::all());
        return result;
      }
      std::vector<Argument> candidates;
      if (!(x.most < low.least || x.least > high.most))
        candidates.push_back(a);
      if (!(x.least > low.most))
        candidates.push_back(a + 1);
      if (!(x.most < high.least))
        candidates.push_back(a + 2);
      return one_of(value_of("clamp", a, n), candidates);
    }

    IntervalWithSlopes slopes_of_if(const Argument a, const unsigned n)
    {
      const Interval value = value_of("if", a, n), &condition = a[0].value;
      if (condition.is_number() && !condition.undefined)
        return checked({value, a[condition.least == 0 ? 2 : 1].slopes});
      IntervalWithSlopes result{value, {}}; // the two need not meet
      result.slopes.fill(Interval::all());
      return result;
    }

    IntervalWithSlopes slopes_of_pow(const Argument a, const unsigned n)
    {
      const Interval value = value_of("pow", a, n), &base = a[0].value, &exponent = a[1].value;
      if (exponent.is_number() && exponent.least == std::round(exponent.least) && std::fabs(exponent.least) < 1e6)
        return power(a[0], int(exponent.least));
      if (exponent.is_number())
      {
        const std::array<Interval, 2> lower = {base, number(exponent.least - 1)};
        return chain(value, exponent * find_interval_function("pow")(lower.data(), 2), a[0]);
      }
      return chain(value, value * exponent / base, a[0], value * value_of("ln", base), a[1]);
    }

    IntervalWithSlopes slopes_of_atan2(const Argument a, const unsigned n)
    {
      const Interval     value = value_of("atan2", a, n), &y = a[0].value, &x = a[1].value;
      const Interval     square = power(x, 2) + power(y, 2);
      IntervalWithSlopes result = chain(value, x / square, a[0], -y / square, a[1]);
      if (!(x.least > 0) && y.contains(0)) // it may jump
        result.slopes.fill(Interval::all());
      return result;
    }

    IntervalWithSlopes slopes_of_hypot(const Argument a, const unsigned n)
    {
      const Interval value = value_of("hypot", a, n), unit = {-1, 1};
      const auto     ratio = [&](const Interval &x) { return value.least > 0 ? intersection(x / value, unit) : unit; };
      return chain(value, ratio(a[0].value), a[0], ratio(a[1].value), a[1]);
    }

    IntervalWithSlopes slopes_of_mod(const Argument a, const unsigned n)
    {
      const Interval value = value_of("mod", a, n);
      const bool     whole = value.most - value.least < a[1].value.least * (1 - 1e-12) || a[0].value.is_number();
      if (a[1].value.is_number() && whole)
        return checked({value, a[0].slopes});
      IntervalWithSlopes result{value, {}};
      result.slopes.fill(Interval::all());
      return result;
    }

    IntervalWithSlopes slopes_of_sum(const Argument a, const unsigned n)
    {
      IntervalWithSlopes result;
      for (unsigned k = 0; k < n; ++k)
        result = result + a[k];
      return result;
    }

    Interval sign_of(const Interval &a)
    {
      return a.least >= 0 ? number(1) : a.most <= 0 ? number(-1) : Interval{-1, 1};
    }

    Interval inverse_of_root(const Interval &square)
    {
      return number(1) / value_of("sqrt", square);
    }

    /// f' on a, of functions of one argument; @p value: f on a.
    using Derivative = Interval (*)(const Interval &a, const Interval &value);

    const std::map<std::string, Derivative> &derivatives()
    {
      using I = const Interval &;
      static const std::map<std::string, Derivative> functions = {
        {"abs", [](I a, I) { return sign_of(a); }},
        {"acos", [](I a, I) { return -inverse_of_root(number(1) - power(a, 2)); }},
        {"acosh", [](I a, I) { return inverse_of_root(power(a, 2) - number(1)); }},
        {"asin", [](I a, I) { return inverse_of_root(number(1) - power(a, 2)); }},
        {"asinh", [](I a, I) { return inverse_of_root(number(1) + power(a, 2)); }},
        {"atan", [](I a, I) { return number(1) / (number(1) + power(a, 2)); }},
        {"atanh", [](I a, I) { return number(1) / (number(1) - power(a, 2)); }},
        {"cbrt", [](I, I value) { return number(1) / (number(3) * power(value, 2)); }},
        {"cos", [](I a, I) { return -value_of("sin", a); }},
        {"cosh", [](I a, I) { return value_of("sinh", a); }},
        {"cot", [](I, I value) { return number(-1) - power(value, 2); }},
        {"erf", [](I a, I) { return number(2 / std::sqrt(std::numbers::pi)) * value_of("exp", -power(a, 2)); }},
        {"erfc", [](I a, I) { return number(-2 / std::sqrt(std::numbers::pi)) * value_of("exp", -power(a, 2)); }},
        {"exp", [](I, I value) { return value; }},
        {"j0", [](I a, I) { return -value_of("j1", a); }},
        {"j1",
         [](I, I) {
           return Interval{-0.5, 0.5};
         }},
        {"ln", [](I a, I) { return number(1) / a; }},
        {"log", [](I a, I) { return number(1) / a; }},
        {"log10", [](I a, I) { return number(1 / std::numbers::ln10) / a; }},
        {"log2", [](I a, I) { return number(1 / std::numbers::ln2) / a; }},
        {"sin", [](I a, I) { return value_of("cos", a); }},
        {"sinh", [](I a, I) { return value_of("cosh", a); }},
        {"sqrt", [](I, I value) { return number(0.5) / value; }},
        {"tan", [](I, I value) { return number(1) + power(value, 2); }},
        {"tanh", [](I, I value) { return number(1) - power(value, 2); }},
      };
      return functions;
    }
  } // namespace

  SlopeFunction find_slope_function(const std::string &name)
  {
    using A = Argument;
    if (const auto derivative = derivatives().find(name); derivative != derivatives().end())
      return [f = find_interval_function(name), slope = derivative->second](const A a, const unsigned n)
      {
        const Interval value = f(&a->value, n);
        return chain(value, value.empty() ? Interval::all() : slope(a->value, value), *a);
      };
    static const std::map<std::string, SlopeFunction> others = {
      {"atan2", slopes_of_atan2},
      {"avg",
       [](const A a, const unsigned n) {
         return slopes_of_sum(a, n) / IntervalWithSlopes{number(n), {}};
       }},
      {"clamp", slopes_of_clamp},
      {"hypot", slopes_of_hypot},
      {"if", slopes_of_if},
      {"max", [](const A a, const unsigned n) { return extreme(value_of("max", a, n), a, n, 1); }},
      {"min", [](const A a, const unsigned n) { return extreme(value_of("min", a, n), a, n, -1); }},
      {"mod", slopes_of_mod},
      {"pow", slopes_of_pow},
      {"sum", slopes_of_sum},
    };
    if (const auto found = others.find(name); found != others.end())
      return found->second;
    // Comparisons, and what rounds.
    if (find_interval_function(name))
      return [name](const A a, const unsigned n) { return piecewise_constant(value_of(name, a, n)); };
    return nullptr;
  }

  IntervalWithSlopes operator-(const IntervalWithSlopes &a)
  {
    return chain(-a.value, number(-1), a);
  }

  IntervalWithSlopes operator+(const IntervalWithSlopes &a, const IntervalWithSlopes &b)
  {
    return chain(a.value + b.value, number(1), a, number(1), b);
  }

  IntervalWithSlopes operator-(const IntervalWithSlopes &a, const IntervalWithSlopes &b)
  {
    return chain(a.value - b.value, number(1), a, number(-1), b);
  }

  IntervalWithSlopes operator*(const IntervalWithSlopes &a, const IntervalWithSlopes &b)
  {
    return chain(a.value * b.value, b.value, a, a.value, b);
  }

  IntervalWithSlopes operator/(const IntervalWithSlopes &a, const IntervalWithSlopes &b)
  {
    const Interval value = a.value / b.value;
    return chain(value, number(1) / b.value, a, -value / b.value, b);
  }

  IntervalWithSlopes power(const IntervalWithSlopes &a, const int n)
  {
    const Interval value = power(a.value, n);
    return n == 0 ? IntervalWithSlopes{value, {}} : chain(value, number(n) * power(a.value, n - 1), a);
  }
} // namespace unilateral
