// The functions and constants that expressions know.
#pragma once

#include <string>
#include <utility>
#include <vector>

namespace unilateral
{
  /// A function that an expression may call, with its derivatives.
  struct ExpressionFunction
  {
    std::string name;
    unsigned    n_arguments = 0; ///< 0: one or more
    double (*value)(const double *arguments, unsigned n) = nullptr;
    /// partial[k] = derivative with respect to argument k, where the function has the given value; at a kink or a jump that of one side.
    void (*derivatives)(const double *arguments, unsigned n, double value, double *partial) = nullptr;
    /// A derivative of 0 means that the argument is not looked at: it may be anything there, and have any derivative.
    bool selects = false;

    /// "1 argument", "2 arguments", "at least 1 argument".
    std::string arity() const;
    bool        takes(unsigned n) const { return n_arguments == 0 ? n >= 1 : n == n_arguments; }
  };

  /// All of them, sorted by name.
  const std::vector<ExpressionFunction> &expression_functions();

  /// The function called @p name, or nullptr.
  const ExpressionFunction *find_function(const std::string &name);

  /// The function behind a comparison or logical operator, `<` to `||`: 1 where it holds, 0 elsewhere; nullptr for other texts.
  const ExpressionFunction *find_comparison(const std::string &operation);

  const std::vector<std::pair<std::string, double>> &expression_constants(); ///< pi, e
} // namespace unilateral
