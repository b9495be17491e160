#include "unilateral/functions/expression_intervals.h"

#include <cmath>
#include <map>
#include <numbers>

namespace unilateral
{
  namespace
  {
    using std::numbers::pi;

    constexpr Interval yes = {1, 1}, no = {0, 0}, either = {0, 1};

    /// F grows, and has values from @p domain on.
    template <typename F>
    Interval growing(const Interval &a, const F &f, const Interval &domain = Interval::all())
    {
      const Interval inside = intersection(a, domain);
      return inside.empty() ? Interval::none() : Interval{f(inside.least), f(inside.most)}.checked().where_defined(a.inside(domain));
    }

    template <typename F>
    Interval falling(const Interval &a, const F &f, const Interval &domain = Interval::all())
    {
      const Interval inside = intersection(a, domain);
      return inside.empty() ? Interval::none() : Interval{f(inside.most), f(inside.least)}.checked().where_defined(a.inside(domain));
    }

    Interval absolute(const Interval &a)
    {
      if (a.empty())
        return a;
      const double least = std::fabs(a.least), most = std::fabs(a.most);
      return {a.contains(0) ? 0. : std::min(least, most), std::max(least, most)};
    }

    /// Some a = first + k period, k whole.
    bool contains_one_of(const Interval &a, const double first, const double period)
    {
      return std::ceil((a.least - first) / period) <= std::floor((a.most - first) / period);
    }

    Interval cosine(const Interval &a)
    {
      if (a.empty() || !(a.most - a.least < 2 * pi))
        return a.empty() ? a : Interval{-1, 1};
      const double left = std::cos(a.least), right = std::cos(a.most);
      return {contains_one_of(a, pi, 2 * pi) ? -1. : std::min(left, right), contains_one_of(a, 0, 2 * pi) ? 1. : std::max(left, right)};
    }

    Interval tangent(const Interval &a)
    {
      if (a.empty() || !(a.most - a.least < pi) || contains_one_of(a, pi / 2, pi))
        return a.empty() ? a : Interval::all();
      return {std::tan(a.least), std::tan(a.most)};
    }

    /// From the value in the middle and the largest slope.
    template <typename F>
    Interval around_middle(const Interval &a, const F &f, const double largest_slope, const Interval &range)
    {
      if (a.empty() || !std::isfinite(a.most - a.least))
        return a.empty() ? a : range;
      const double middle = f((a.least + a.most) / 2), reach = largest_slope * (a.most - a.least) / 2;
      return intersection({middle - reach, middle + reach}, range);
    }

    template <typename F>
    Interval corners(const Interval &a, const Interval &b, const F &f)
    {
      const auto [least, most] = std::minmax({f(a.least, b.least), f(a.least, b.most), f(a.most, b.least), f(a.most, b.most)});
      return Interval{least, most}.checked();
    }

    Interval angle(const Interval &y, const Interval &x)
    {
      if (y.empty() || x.empty())
        return Interval::none();
      if (x.least > 0 || !y.contains(0)) // it does not jump there
        return corners(y, x, [](const double b, const double a) { return std::atan2(b, a); });
      return {-pi, pi};
    }

    Interval remainder(const Interval &a, const Interval &b)
    {
      if (a.empty() || !b.is_number() || !(b.least > 0))
        return a.empty() ? a : Interval::all();
      const double first = std::floor(a.least / b.least), last = std::floor(a.most / b.least);
      return first == last ? Interval{a.least - b.least * first, a.most - b.least * first} : Interval{0, b.least};
    }

    Interval general_power(const Interval &a, const Interval &b)
    {
      if (a.empty() || b.empty())
        return Interval::none();
      if (b.is_number() && b.least == std::round(b.least) && std::fabs(b.least) < 1e6)
        return power(a, int(b.least));
      // Of a negative number there is no other power than those.
      const Interval base = intersection(a, {0, Interval::infinity});
      if (base.empty())
        return b.is_number() ? Interval::none() : Interval::all();
      if (!b.is_number() && a.least < 0)
        return Interval::all();
      return corners(base, b, [](const double x, const double y) { return std::pow(x, y); }).where_defined(a.least >= 0);
    }

    /// Where a condition may hold, and where it may fail. One without a value may do either.
    bool may_hold(const Interval &a)
    {
      return a.undefined || !(a.least == 0 && a.most == 0);
    }
    bool may_fail(const Interval &a)
    {
      return a.undefined || a.contains(0);
    }

    bool same_number(const Interval &a, const Interval &b)
    {
      return a.is_number() && b.is_number() && a.least == b.least;
    }

    Interval hull_of_all(const Interval *const a, const unsigned n)
    {
      Interval result = a[0];
      for (unsigned k = 1; k < n; ++k)
        result = hull(result, a[k]);
      return result;
    }

    bool any_undefined(const Interval *const a, const unsigned n)
    {
      return hull_of_all(a, n).undefined;
    }

    /// Comparisons with what has no value are false or, of `!=`, true.
    template <typename F>
    Interval compare(const Interval *const a, const F &f)
    {
      return any_undefined(a, 2) ? Interval{0, 1} : f(a[0], a[1]);
    }

    Interval truth(const bool may_be_true, const bool may_be_false)
    {
      return may_be_true && may_be_false ? either : may_be_true ? yes : may_be_false ? no : Interval::none();
    }

    const std::map<std::string, IntervalFunction> &interval_functions()
    {
      using A = const Interval *;
      constexpr double                                     inf = Interval::infinity;
      static const std::map<std::string, IntervalFunction> functions = {
        {"abs", [](A a, unsigned) { return absolute(a[0]); }},
        {"acos",
         [](A a, unsigned) {
           return falling(a[0], [](const double x) { return std::acos(x); }, {-1, 1});
         }},
        {"acosh",
         [](A a, unsigned) {
           return growing(a[0], [](const double x) { return std::acosh(x); }, {1, inf});
         }},
        {"asin",
         [](A a, unsigned) {
           return growing(a[0], [](const double x) { return std::asin(x); }, {-1, 1});
         }},
        {"asinh", [](A a, unsigned) { return growing(a[0], [](const double x) { return std::asinh(x); }); }},
        {"atan", [](A a, unsigned) { return growing(a[0], [](const double x) { return std::atan(x); }); }},
        {"atan2", [](A a, unsigned) { return angle(a[0], a[1]); }},
        {"atanh",
         [](A a, unsigned) {
           return growing(a[0], [](const double x) { return std::atanh(x); }, {-1, 1});
         }},
        {"avg",
         [](A a, unsigned n)
         {
           Interval sum;
           for (unsigned k = 0; k < n; ++k)
             sum = sum + a[k];
           return sum / Interval::of(n);
         }},
        {"cbrt", [](A a, unsigned) { return growing(a[0], [](const double x) { return std::cbrt(x); }); }},
        {"ceil", [](A a, unsigned) { return growing(a[0], [](const double x) { return std::ceil(x); }); }},
        {"clamp",
         [](A a, unsigned n)
         {
           if (any_undefined(a, n))
             return hull_of_all(a, n);
           return hull({std::max(std::min(a[0].least, a[2].least), a[1].least), std::max(std::min(a[0].most, a[2].most), a[1].most)},
                       // where the limits are the wrong way round
                       {std::min(std::max(a[0].least, a[1].least), a[2].least), std::min(std::max(a[0].most, a[1].most), a[2].most)});
         }},
        {"cos", [](A a, unsigned) { return cosine(a[0]); }},
        {"cosh", [](A a, unsigned) { return growing(absolute(a[0]), [](const double x) { return std::cosh(x); }); }},
        {"cot", [](A a, unsigned) { return Interval::of(1) / tangent(a[0]); }},
        {"erf", [](A a, unsigned) { return growing(a[0], [](const double x) { return std::erf(x); }); }},
        {"erfc", [](A a, unsigned) { return falling(a[0], [](const double x) { return std::erfc(x); }); }},
        {"exp", [](A a, unsigned) { return growing(a[0], [](const double x) { return std::exp(x); }); }},
        {"floor", [](A a, unsigned) { return growing(a[0], [](const double x) { return std::floor(x); }); }},
        {"hypot",
         [](A a, unsigned)
         {
           const Interval x = absolute(a[0]), y = absolute(a[1]);
           return x.empty() || y.empty() ? Interval::none() : Interval{std::hypot(x.least, y.least), std::hypot(x.most, y.most)};
         }},
        {"if",
         [](A a, unsigned)
         {
           const bool first = may_hold(a[0]), second = may_fail(a[0]);
           Interval   result = first && second ? hull(a[1], a[2]) : first ? a[1] : second ? a[2] : Interval::none();
           result.undefined = result.undefined || a[0].undefined;
           return result;
         }},
        {"j0",
         [](A a, unsigned) {
           return around_middle(a[0], [](const double x) { return ::j0(x); }, 0.582, {-0.403, 1});
         }},
        {"j1",
         [](A a, unsigned) {
           return around_middle(a[0], [](const double x) { return ::j1(x); }, 0.5, {-0.582, 0.582});
         }},
        {"ln",
         [](A a, unsigned) {
           return growing(a[0], [](const double x) { return std::log(x); }, {0, inf});
         }},
        {"log",
         [](A a, unsigned) {
           return growing(a[0], [](const double x) { return std::log(x); }, {0, inf});
         }},
        {"log10",
         [](A a, unsigned) {
           return growing(a[0], [](const double x) { return std::log10(x); }, {0, inf});
         }},
        {"log2",
         [](A a, unsigned) {
           return growing(a[0], [](const double x) { return std::log2(x); }, {0, inf});
         }},
        // Which of the arguments is chosen where one has no value depends on their order.
        {"max",
         [](A a, unsigned n)
         {
           Interval result = a[0];
           for (unsigned k = 1; k < n; ++k)
             result = {std::max(result.least, a[k].least), std::max(result.most, a[k].most)};
           return any_undefined(a, n) ? hull_of_all(a, n) : result;
         }},
        {"min",
         [](A a, unsigned n)
         {
           Interval result = a[0];
           for (unsigned k = 1; k < n; ++k)
             result = {std::min(result.least, a[k].least), std::min(result.most, a[k].most)};
           return any_undefined(a, n) ? hull_of_all(a, n) : result;
         }},
        {"mod", [](A a, unsigned) { return remainder(a[0], a[1]); }},
        {"pow", [](A a, unsigned) { return general_power(a[0], a[1]); }},
        {"round", [](A a, unsigned) { return growing(a[0], [](const double x) { return std::round(x); }); }},
        {"sign", [](A a, unsigned) { return growing(a[0], [](const double x) { return x > 0   ? 1.
                                                                                      : x < 0 ? -1.
                                                                                              : 0.; }); }},
        {"sin", [](A a, unsigned) { return cosine(a[0] - Interval::of(pi / 2)); }},
        {"sinh", [](A a, unsigned) { return growing(a[0], [](const double x) { return std::sinh(x); }); }},
        {"sqrt",
         [](A a, unsigned) {
           return growing(a[0], [](const double x) { return std::sqrt(x); }, {0, inf});
         }},
        {"sum",
         [](A a, unsigned n)
         {
           Interval sum;
           for (unsigned k = 0; k < n; ++k)
             sum = sum + a[k];
           return sum;
         }},
        {"tan", [](A a, unsigned) { return tangent(a[0]); }},
        {"tanh", [](A a, unsigned) { return growing(a[0], [](const double x) { return std::tanh(x); }); }},
        {"<", [](A a, unsigned)
         { return compare(a, [](const Interval &x, const Interval &y) { return truth(x.least < y.most, x.most >= y.least); }); }},
        {"<=", [](A a, unsigned)
         { return compare(a, [](const Interval &x, const Interval &y) { return truth(x.least <= y.most, x.most > y.least); }); }},
        {">", [](A a, unsigned)
         { return compare(a, [](const Interval &x, const Interval &y) { return truth(x.most > y.least, x.least <= y.most); }); }},
        {">=", [](A a, unsigned)
         { return compare(a, [](const Interval &x, const Interval &y) { return truth(x.most >= y.least, x.least < y.most); }); }},
        {"==",
         [](A a, unsigned) {
           return compare(a, [](const Interval &x, const Interval &y) { return truth(!intersection(x, y).empty(), !same_number(x, y)); });
         }},
        {"!=",
         [](A a, unsigned) {
           return compare(a, [](const Interval &x, const Interval &y) { return truth(!same_number(x, y), !intersection(x, y).empty()); });
         }},
        {"&&", [](A a, unsigned) { return truth(may_hold(a[0]) && may_hold(a[1]), may_fail(a[0]) || may_fail(a[1])); }},
        {"||", [](A a, unsigned) { return truth(may_hold(a[0]) || may_hold(a[1]), may_fail(a[0]) && may_fail(a[1])); }},
      };
      return functions;
    }
  } // namespace

  IntervalFunction find_interval_function(const std::string &name)
  {
    const auto found = interval_functions().find(name);
    return found == interval_functions().end() ? nullptr : found->second;
  }

  Interval power(const Interval &a, const int n)
  {
    if (a.empty())
      return a;
    if (n < 0)
      return Interval::of(1) / power(a, -n);
    if (n == 0)
      return Interval::of(1);
    const auto     raised = [n](const double x) { return std::pow(x, n); };
    const Interval base = n % 2 == 0 ? absolute(a) : a;
    return {raised(base.least), raised(base.most)};
  }
} // namespace unilateral
