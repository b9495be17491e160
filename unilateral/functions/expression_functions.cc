#include "unilateral/functions/expression_functions.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace unilateral
{
  namespace
  {
    using std::numbers::ln10, std::numbers::ln2, std::numbers::pi;

    // F and D are lambdas without captures: a table entry is a pair of plain function pointers with their code inside.

    /// f(a), and f'(a) from a and f(a).
    template <typename F, typename D>
    ExpressionFunction unary(const char *name, F, D)
    {
      return {name, 1, [](const double *a, unsigned) { return F{}(a[0]); },
              [](const double *a, unsigned, const double f, double *partial) { partial[0] = D{}(a[0], f); }};
    }

    /// f(a, b), and both derivatives from a, b and f(a, b).
    template <typename F, typename D>
    ExpressionFunction binary(const char *name, F, D)
    {
      return {name, 2, [](const double *a, unsigned) { return F{}(a[0], a[1]); },
              [](const double *a, unsigned, const double f, double *partial)
              {
                const std::array<double, 2> both = D{}(a[0], a[1], f);
                partial[0] = both[0];
                partial[1] = both[1];
              }};
    }

    template <typename F>
    ExpressionFunction comparison(const char *name, F)
    {
      return binary(
        name, [](const double a, const double b) { return F{}(a, b) ? 1. : 0.; },
        [](double, double, double) {
          return std::array{0., 0.};
        });
    }

    /// A piecewise constant function.
    template <typename F>
    ExpressionFunction steps(const char *name, F f)
    {
      ExpressionFunction function = unary(name, f, [](double, double) { return 0.; });
      function.selects = true;
      return function;
    }

    double clamp(const double *a, unsigned)
    {
      return a[0] < a[1] ? a[1] : a[0] > a[2] ? a[2] : a[0];
    }
    void clamp_derivatives(const double *a, unsigned, double, double *partial)
    {
      std::fill(partial, partial + 3, 0.);
      partial[a[0] < a[1] ? 1 : a[0] > a[2] ? 2 : 0] = 1;
    }

    double choose(const double *a, unsigned)
    {
      return a[0] != 0 ? a[1] : a[2];
    }
    void choose_derivatives(const double *a, unsigned, double, double *partial)
    {
      std::fill(partial, partial + 3, 0.);
      partial[a[0] != 0 ? 1 : 2] = 1;
    }

    double smallest(const double *a, const unsigned n)
    {
      return *std::min_element(a, a + n);
    }
    double largest(const double *a, const unsigned n)
    {
      return *std::max_element(a, a + n);
    }
    void derivatives_of_chosen(const double *a, const unsigned n, const double value, double *partial)
    {
      std::fill(partial, partial + n, 0.);
      const auto chosen = std::find(a, a + n, value);
      if (chosen != a + n)
        partial[chosen - a] = 1;
    }

    double sum(const double *a, const unsigned n)
    {
      double s = 0;
      for (unsigned i = 0; i < n; ++i)
        s += a[i];
      return s;
    }
    void sum_derivatives(const double *, const unsigned n, double, double *partial)
    {
      std::fill(partial, partial + n, 1.);
    }
    double average(const double *a, const unsigned n)
    {
      return sum(a, n) / n;
    }
    void average_derivatives(const double *, const unsigned n, double, double *partial)
    {
      std::fill(partial, partial + n, 1. / n);
    }

    const ExpressionFunction *find(const std::vector<ExpressionFunction> &functions, const std::string &name)
    {
      const auto found = std::find_if(functions.begin(), functions.end(), [&](const ExpressionFunction &f) { return f.name == name; });
      return found == functions.end() ? nullptr : &*found;
    }
  } // namespace

  std::string ExpressionFunction::arity() const
  {
    return n_arguments == 0 ? "at least 1 argument" : std::to_string(n_arguments) + (n_arguments == 1 ? " argument" : " arguments");
  }

  const std::vector<ExpressionFunction> &expression_functions()
  {
    static const std::vector<ExpressionFunction> functions = {
      unary(
        "abs", [](const double a) { return std::fabs(a); }, [](const double a, double) { return a > 0   ? 1.
                                                                                                : a < 0 ? -1.
                                                                                                        : 0.; }),
      unary(
        "acos", [](const double a) { return std::acos(a); }, [](const double a, double) { return -1 / std::sqrt(1 - a * a); }),
      unary(
        "acosh", [](const double a) { return std::acosh(a); }, [](const double a, double) { return 1 / std::sqrt(a * a - 1); }),
      unary(
        "asin", [](const double a) { return std::asin(a); }, [](const double a, double) { return 1 / std::sqrt(1 - a * a); }),
      unary(
        "asinh", [](const double a) { return std::asinh(a); }, [](const double a, double) { return 1 / std::sqrt(a * a + 1); }),
      unary(
        "atan", [](const double a) { return std::atan(a); }, [](const double a, double) { return 1 / (1 + a * a); }),
      binary(
        "atan2", [](const double a, const double b) { return std::atan2(a, b); },
        [](const double a, const double b, double) {
          return std::array{b / (a * a + b * b), -a / (a * a + b * b)};
        }),
      unary(
        "atanh", [](const double a) { return std::atanh(a); }, [](const double a, double) { return 1 / (1 - a * a); }),
      {"avg", 0, average, average_derivatives},
      unary(
        "cbrt", [](const double a) { return std::cbrt(a); }, [](double, const double f) { return 1 / (3 * f * f); }),
      steps("ceil", [](const double a) { return std::ceil(a); }),
      {"clamp", 3, clamp, clamp_derivatives, true},
      unary(
        "cos", [](const double a) { return std::cos(a); }, [](const double a, double) { return -std::sin(a); }),
      unary(
        "cosh", [](const double a) { return std::cosh(a); }, [](const double a, double) { return std::sinh(a); }),
      unary(
        "cot", [](const double a) { return 1 / std::tan(a); }, [](double, const double f) { return -1 - f * f; }),
      unary(
        "erf", [](const double a) { return std::erf(a); }, [](const double a, double) { return 2 / std::sqrt(pi) * std::exp(-a * a); }),
      unary(
        "erfc", [](const double a) { return std::erfc(a); }, [](const double a, double) { return -2 / std::sqrt(pi) * std::exp(-a * a); }),
      unary(
        "exp", [](const double a) { return std::exp(a); }, [](double, const double f) { return f; }),
      steps("floor", [](const double a) { return std::floor(a); }),
      binary(
        "hypot", [](const double a, const double b) { return std::hypot(a, b); },
        [](const double a, const double b, const double f) {
          return std::array{a / f, b / f};
        }),
      {"if", 3, choose, choose_derivatives, true},
      // Bessel functions of the first kind.
      unary(
        "j0", [](const double a) { return ::j0(a); }, [](const double a, double) { return -::j1(a); }),
      unary(
        "j1", [](const double a) { return ::j1(a); }, [](const double a, const double f) { return a == 0 ? 0.5 : ::j0(a) - f / a; }),
      unary(
        "ln", [](const double a) { return std::log(a); }, [](const double a, double) { return 1 / a; }),
      unary(
        "log", [](const double a) { return std::log(a); }, [](const double a, double) { return 1 / a; }),
      unary(
        "log10", [](const double a) { return std::log10(a); }, [](const double a, double) { return 1 / (a * ln10); }),
      unary(
        "log2", [](const double a) { return std::log2(a); }, [](const double a, double) { return 1 / (a * ln2); }),
      {"max", 0, largest, derivatives_of_chosen, true},
      {"min", 0, smallest, derivatives_of_chosen, true},
      binary(
        "mod", [](const double a, const double b) { return a - b * std::floor(a / b); },
        [](const double a, const double b, double) {
          return std::array{1., -std::floor(a / b)};
        }),
      binary(
        "pow", [](const double a, const double b) { return b == 2 ? a * a : std::pow(a, b); },
        [](const double a, const double b, const double f) {
          return std::array{b == 2 ? 2 * a : b * std::pow(a, b - 1), f == 0 ? 0. : f * std::log(a)};
        }),
      steps("round", [](const double a) { return std::round(a); }),
      steps("sign", [](const double a) { return a > 0   ? 1.
                                                : a < 0 ? -1.
                                                        : 0. * a; }),
      unary(
        "sin", [](const double a) { return std::sin(a); }, [](const double a, double) { return std::cos(a); }),
      unary(
        "sinh", [](const double a) { return std::sinh(a); }, [](const double a, double) { return std::cosh(a); }),
      unary(
        "sqrt", [](const double a) { return std::sqrt(a); }, [](double, const double f) { return 0.5 / f; }),
      {"sum", 0, sum, sum_derivatives},
      unary(
        "tan", [](const double a) { return std::tan(a); }, [](double, const double f) { return 1 + f * f; }),
      unary(
        "tanh", [](const double a) { return std::tanh(a); }, [](double, const double f) { return 1 - f * f; }),
    };
    return functions;
  }

  const ExpressionFunction *find_function(const std::string &name)
  {
    return find(expression_functions(), name);
  }

  const ExpressionFunction *find_comparison(const std::string &operation)
  {
    static const std::vector<ExpressionFunction> comparisons = {
      comparison("<", [](const double a, const double b) { return a < b; }),
      comparison("<=", [](const double a, const double b) { return a <= b; }),
      comparison(">", [](const double a, const double b) { return a > b; }),
      comparison(">=", [](const double a, const double b) { return a >= b; }),
      comparison("==", [](const double a, const double b) { return a == b; }),
      comparison("!=", [](const double a, const double b) { return a != b; }),
      comparison("&&", [](const double a, const double b) { return a != 0 && b != 0; }),
      comparison("||", [](const double a, const double b) { return a != 0 || b != 0; }),
    };
    return find(comparisons, operation);
  }

  const std::vector<std::pair<std::string, double>> &expression_constants()
  {
    static const std::vector<std::pair<std::string, double>> constants = {{"pi", std::numbers::pi}, {"e", std::numbers::e}};
    return constants;
  }
} // namespace unilateral
