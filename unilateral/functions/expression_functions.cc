#include "unilateral/functions/expression_functions.h"

#include <algorithm>
#include <cmath>

namespace unilateral
{
  namespace
  {
    using Unary = double (*)(double);
    using Binary = double (*)(double, double);

    double sign(const double a)
    {
      return a > 0 ? 1. : a < 0 ? -1. : 0. * a;
    }
    double cot(const double a)
    {
      return 1 / std::tan(a);
    }
    double modulo(const double a, const double b)
    {
      return a - b * std::floor(a / b);
    }
    double choose(const double condition, const double yes, const double no)
    {
      return condition != 0 ? yes : no;
    }
    double clamp(const double a, const double low, const double high)
    {
      return a < low ? low : a > high ? high : a;
    }

    double smallest(const double *a, const int n)
    {
      return *std::min_element(a, a + n);
    }
    double largest(const double *a, const int n)
    {
      return *std::max_element(a, a + n);
    }
    double sum(const double *a, const int n)
    {
      double s = 0;
      for (int i = 0; i < n; ++i)
        s += a[i];
      return s;
    }
    double average(const double *a, const int n)
    {
      return sum(a, n) / n;
    }

    ExpressionFunction unary(const char *name, Unary f)
    {
      return {name, f, nullptr, nullptr, nullptr};
    }
    ExpressionFunction binary(const char *name, Binary f)
    {
      return {name, nullptr, f, nullptr, nullptr};
    }
  } // namespace

  std::string ExpressionFunction::arity() const
  {
    return unary ? "1 argument" : binary ? "2 arguments" : ternary ? "3 arguments" : "at least 1 argument";
  }

  bool ExpressionFunction::takes(const unsigned n_arguments) const
  {
    return unary ? n_arguments == 1 : binary ? n_arguments == 2 : ternary ? n_arguments == 3 : n_arguments >= 1;
  }

  const std::vector<ExpressionFunction> &expression_functions()
  {
    static const std::vector<ExpressionFunction> functions = {
      unary("abs", std::fabs),
      unary("acos", std::acos),
      unary("acosh", std::acosh),
      unary("asin", std::asin),
      unary("asinh", std::asinh),
      unary("atan", std::atan),
      binary("atan2", std::atan2),
      unary("atanh", std::atanh),
      {"avg", nullptr, nullptr, nullptr, average},
      unary("cbrt", std::cbrt),
      unary("ceil", std::ceil),
      {"clamp", nullptr, nullptr, clamp, nullptr},
      unary("cos", std::cos),
      unary("cosh", std::cosh),
      unary("cot", cot),
      unary("erf", std::erf),
      unary("erfc", std::erfc),
      unary("exp", std::exp),
      unary("floor", std::floor),
      binary("hypot", std::hypot),
      {"if", nullptr, nullptr, choose, nullptr},
      unary("ln", std::log),
      unary("log", std::log),
      unary("log10", std::log10),
      unary("log2", std::log2),
      {"max", nullptr, nullptr, nullptr, largest},
      {"min", nullptr, nullptr, nullptr, smallest},
      binary("mod", modulo),
      binary("pow", std::pow),
      unary("round", std::round),
      unary("sign", sign),
      unary("sin", std::sin),
      unary("sinh", std::sinh),
      unary("sqrt", std::sqrt),
      {"sum", nullptr, nullptr, nullptr, sum},
      unary("tan", std::tan),
      unary("tanh", std::tanh),
    };
    return functions;
  }

  const ExpressionFunction *find_function(const std::string &name)
  {
    for (const ExpressionFunction &function : expression_functions())
      if (function.name == name)
        return &function;
    return nullptr;
  }

  const std::vector<std::pair<std::string, double>> &expression_constants()
  {
    static const std::vector<std::pair<std::string, double>> constants = {{"pi", std::numbers::pi}, {"e", std::numbers::e}};
    return constants;
  }
} // namespace unilateral
