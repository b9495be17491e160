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

    using Arguments = ExpressionFunction::Arguments;

    // F and D are lambdas without captures: a table entry is a pair of plain function pointers with their code inside, as loops over
    // points of which the compiler makes SIMD instructions where it can.

    /// f(a), and f'(a) from a and f(a).
    template <typename F, typename D>
    ExpressionFunction unary(const char *name, F, D)
    {
      return {name, 1,
              [](const Arguments a, unsigned, const unsigned n_points, double *const f)
              {
                for (unsigned i = 0; i < n_points; ++i)
                  f[i] = F{}(a[0][i]);
              },
              [](const Arguments a, unsigned, const unsigned n_points, const double *const f, double *const *const partial)
              {
                for (unsigned i = 0; i < n_points; ++i)
                  partial[0][i] = D{}(a[0][i], f[i]);
              }};
    }

    /// f(a, b), and both derivatives from a, b and f(a, b).
    template <typename F, typename D>
    ExpressionFunction binary(const char *name, F, D)
    {
      return {name, 2,
              [](const Arguments a, unsigned, const unsigned n_points, double *const f)
              {
                for (unsigned i = 0; i < n_points; ++i)
                  f[i] = F{}(a[0][i], a[1][i]);
              },
              [](const Arguments a, unsigned, const unsigned n_points, const double *const f, double *const *const partial)
              {
                for (unsigned i = 0; i < n_points; ++i)
                {
                  const std::array<double, 2> both = D{}(a[0][i], a[1][i], f[i]);
                  partial[0][i] = both[0];
                  partial[1][i] = both[1];
                }
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

    void fill(double *const row, const unsigned n_points, const double value)
    {
      std::fill(row, row + n_points, value);
    }

    void clamp(const Arguments a, unsigned, const unsigned n_points, double *const f)
    {
      for (unsigned i = 0; i < n_points; ++i)
        f[i] = a[0][i] < a[1][i] ? a[1][i] : a[0][i] > a[2][i] ? a[2][i] : a[0][i];
    }
    void clamp_derivatives(const Arguments a, unsigned, const unsigned n_points, const double *, double *const *const partial)
    {
      for (unsigned i = 0; i < n_points; ++i)
      {
        const unsigned chosen = a[0][i] < a[1][i] ? 1 : a[0][i] > a[2][i] ? 2 : 0;
        for (unsigned k = 0; k < 3; ++k)
          partial[k][i] = k == chosen;
      }
    }

    void choose(const Arguments a, unsigned, const unsigned n_points, double *const f)
    {
      for (unsigned i = 0; i < n_points; ++i)
        f[i] = a[0][i] != 0 ? a[1][i] : a[2][i];
    }
    void choose_derivatives(const Arguments a, unsigned, const unsigned n_points, const double *, double *const *const partial)
    {
      fill(partial[0], n_points, 0);
      for (unsigned i = 0; i < n_points; ++i)
      {
        partial[1][i] = a[0][i] != 0;
        partial[2][i] = 1 - partial[1][i];
      }
    }

    void smallest(const Arguments a, const unsigned n, const unsigned n_points, double *const f)
    {
      std::copy(a[0], a[0] + n_points, f);
      for (unsigned k = 1; k < n; ++k)
        for (unsigned i = 0; i < n_points; ++i)
          f[i] = a[k][i] < f[i] ? a[k][i] : f[i];
    }
    void largest(const Arguments a, const unsigned n, const unsigned n_points, double *const f)
    {
      std::copy(a[0], a[0] + n_points, f);
      for (unsigned k = 1; k < n; ++k)
        for (unsigned i = 0; i < n_points; ++i)
          f[i] = f[i] < a[k][i] ? a[k][i] : f[i];
    }
    /// 1 for the first argument that is the value, 0 for the others.
    void
    derivatives_of_chosen(const Arguments a, const unsigned n, const unsigned n_points, const double *const f, double *const *const partial)
    {
      // The last row holds 1 where none has been found yet, until its own turn.
      double *const not_found = partial[n - 1];
      fill(not_found, n_points, 1);
      for (unsigned k = 0; k + 1 < n; ++k)
        for (unsigned i = 0; i < n_points; ++i)
        {
          partial[k][i] = a[k][i] == f[i] ? not_found[i] : 0.;
          not_found[i] -= partial[k][i];
        }
      for (unsigned i = 0; i < n_points; ++i)
        not_found[i] = a[n - 1][i] == f[i] ? not_found[i] : 0.;
    }

    void sum(const Arguments a, const unsigned n, const unsigned n_points, double *const f)
    {
      fill(f, n_points, 0);
      for (unsigned k = 0; k < n; ++k)
        for (unsigned i = 0; i < n_points; ++i)
          f[i] += a[k][i];
    }
    void sum_derivatives(const Arguments, const unsigned n, const unsigned n_points, const double *, double *const *const partial)
    {
      for (unsigned k = 0; k < n; ++k)
        fill(partial[k], n_points, 1);
    }
    void average(const Arguments a, const unsigned n, const unsigned n_points, double *const f)
    {
      sum(a, n, n_points, f);
      for (unsigned i = 0; i < n_points; ++i)
        f[i] /= n;
    }
    void average_derivatives(const Arguments, const unsigned n, const unsigned n_points, const double *, double *const *const partial)
    {
      for (unsigned k = 0; k < n; ++k)
        fill(partial[k], n_points, 1. / n);
    }

    /// (a^2 + b^2)^1/2, as it stands where no square can overflow or lose digits, which it seldom does.
    void hypotenuse(const Arguments a, unsigned, const unsigned n_points, double *const f)
    {
      const auto safe = [&](const unsigned i)
      {
        constexpr double least = 1e-140, most = 1e140;
        const double     largest = std::max(std::fabs(a[0][i]), std::fabs(a[1][i]));
        return static_cast<unsigned>(largest > least) & static_cast<unsigned>(largest < most);
      };
      unsigned n_safe = 0;
      for (unsigned i = 0; i < n_points; ++i)
      {
        n_safe += safe(i);
        f[i] = std::sqrt(a[0][i] * a[0][i] + a[1][i] * a[1][i]);
      }
      // Point by point: a value must not depend on those beside it.
      for (unsigned i = 0; i < n_points && n_safe < n_points; ++i)
        if (safe(i) == 0)
          f[i] = std::hypot(a[0][i], a[1][i]);
    }
    void hypotenuse_derivatives(const Arguments a, unsigned, const unsigned n_points, const double *const f, double *const *const partial)
    {
      for (unsigned k = 0; k < 2; ++k)
        for (unsigned i = 0; i < n_points; ++i)
          partial[k][i] = a[k][i] / f[i];
    }

    std::vector<ExpressionFunction> with_ranges(std::vector<ExpressionFunction> functions)
    {
      for (ExpressionFunction &function : functions)
      {
        function.range = find_interval_function(function.name);
        function.slopes = find_slope_function(function.name);
        function.branches = function.name == "if";
      }
      return functions;
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
    static const std::vector<ExpressionFunction> functions = with_ranges({
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
      {"hypot", 2, hypotenuse, hypotenuse_derivatives},
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
    });
    return functions;
  }

  const ExpressionFunction *find_function(const std::string &name)
  {
    return find(expression_functions(), name);
  }

  const ExpressionFunction *find_comparison(const std::string &operation)
  {
    static const std::vector<ExpressionFunction> comparisons = with_ranges({
      comparison("<", [](const double a, const double b) { return a < b; }),
      comparison("<=", [](const double a, const double b) { return a <= b; }),
      comparison(">", [](const double a, const double b) { return a > b; }),
      comparison(">=", [](const double a, const double b) { return a >= b; }),
      comparison("==", [](const double a, const double b) { return a == b; }),
      comparison("!=", [](const double a, const double b) { return a != b; }),
      comparison("&&", [](const double a, const double b) { return a != 0 && b != 0; }),
      comparison("||", [](const double a, const double b) { return a != 0 || b != 0; }),
    });
    return find(comparisons, operation);
  }

  const std::vector<std::pair<std::string, double>> &expression_constants()
  {
    static const std::vector<std::pair<std::string, double>> constants = {{"pi", std::numbers::pi}, {"e", std::numbers::e}};
    return constants;
  }
} // namespace unilateral
