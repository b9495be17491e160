// The functions and constants that expressions know.
#pragma once

#include "unilateral/functions/expression_intervals.h"
#include "unilateral/functions/expression_slopes.h"

#include <string>
#include <utility>
#include <vector>

namespace unilateral
{
  /// A function that an expression may call, with its derivatives, at many points at a time.
  struct ExpressionFunction
  {
    /// The arguments: a[k][i] is argument k at point i.
    using Arguments = const double *const *;

    std::string name;
    unsigned    n_arguments = 0; ///< 0: one or more
    /// f[i], the values at points i = 0, .., n_points - 1 of the n arguments there.
    void (*values)(Arguments a, unsigned n, unsigned n_points, double *f) = nullptr;
    /// partial[k][i], the derivatives by argument k, where the function has the values f[i]; at a kink or a jump those of one side.
    void (*derivatives)(Arguments a, unsigned n, unsigned n_points, const double *f, double *const *partial) = nullptr;
    /// A derivative of 0 means that the argument is not looked at: it may be anything there, and have any derivative.
    bool selects = false;
    /// What it makes of sets of numbers.
    IntervalFunction range = nullptr;
    SlopeFunction    slopes = nullptr;
    bool             branches = false; ///< it is "if": on a set where one argument is not taken, that may be without a value

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
