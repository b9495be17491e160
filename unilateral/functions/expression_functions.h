// The functions and constants that expressions know.
#pragma once

#include <numbers>
#include <string>
#include <utility>
#include <vector>

namespace unilateral
{
  /// A function that an expression may call; exactly one of the pointers is set.
  struct ExpressionFunction
  {
    std::string name;
    double (*unary)(double) = nullptr;
    double (*binary)(double, double) = nullptr;
    double (*ternary)(double, double, double) = nullptr;
    double (*variadic)(const double *, int) = nullptr; ///< one argument or more

    /// "1 argument", "2 arguments", "at least 1 argument".
    std::string arity() const;
    bool        takes(unsigned n_arguments) const;
  };

  /// All of them, sorted by name.
  const std::vector<ExpressionFunction> &expression_functions();

  /// The function called @p name, or nullptr.
  const ExpressionFunction *find_function(const std::string &name);

  const std::vector<std::pair<std::string, double>> &expression_constants(); ///< pi, e
} // namespace unilateral
