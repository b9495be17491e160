// An expression as instructions of a stack machine, evaluated at many points at a time, with its gradient where that is wanted.
#pragma once

#include "unilateral/functions/expression_functions.h"

#include <optional>
#include <vector>

namespace unilateral
{
  /// Numbers at up to `n_points` points: row 0 the values, rows 1 to 3 the derivatives by x, y and z.
  struct ExpressionColumn
  {
    static constexpr unsigned n_points = 256;
    double                    row[4][n_points];
  };

  /// How much of a column is worked on.
  struct ExpressionRange
  {
    unsigned n_points = 1;
    unsigned n_rows = 1; ///< 1: values alone; 1 + dim: with the gradient
  };

  /// Copies the part of a column that is worked on.
  void copy(const ExpressionColumn &from, ExpressionColumn &to, ExpressionRange range);

  /// Operands before operators, as a calculator takes them: x 2 ^ 1 +. Operations on constants are carried out when they are appended.
  class ExpressionCode
  {
  public:
    enum class Operation
    {
      constant,
      variable,
      negative,
      plus,
      minus,
      times,
      divided_by,
      power, ///< of a small whole number
      call
    };

    void constant(double value);
    void variable(unsigned number);
    void apply(Operation operation); ///< negative to divided_by
    void call(const ExpressionFunction &function, unsigned n_arguments);

    /// The same with numbers in the place of some variables (by their numbers).
    ExpressionCode with(const std::vector<std::optional<double>> &values) const;

    /// The value of an expression without variables.
    std::optional<double> constant_value() const;

    /// The values, and by forward differentiation the derivatives, at the points of @p range; @p variables by their numbers. Where a
    /// function has no derivative there may be one that is not finite. @p stack is memory that is reused; the result lies in its first
    /// column.
    void evaluate(const std::vector<ExpressionColumn> &variables, ExpressionRange range, std::vector<ExpressionColumn> &stack) const;

    /// Contains every value that the expression takes where @p variables, by their numbers, lie in these sets. @p stack is memory that is
    /// reused.
    Interval range(const std::vector<Interval> &variables, std::vector<Interval> &stack) const;

    /// The same with slopes by x, y and z, see IntervalWithSlopes.
    IntervalWithSlopes range_and_slopes(const std::vector<IntervalWithSlopes> &variables, std::vector<IntervalWithSlopes> &stack) const;

  private:
    struct Instruction
    {
      Operation                 operation = Operation::constant;
      double                    value = 0;          ///< constant
      unsigned                  number = 0;         ///< of the variable, of the arguments of a call, or the exponent of a power
      const ExpressionFunction *function = nullptr; ///< call

      unsigned n_operands() const;
    };

    void append(const Instruction &instruction);

    /// @p call: what a function makes of its arguments.
    template <typename Set, typename Call>
    Set on_sets(const std::vector<Set> &variables, std::vector<Set> &stack, const Call &call) const;

    /// With operands below @p free; returns the first column above the result.
    static ExpressionColumn *carry_out(const Instruction                   &instruction,
                                       const std::vector<ExpressionColumn> &variables,
                                       ExpressionRange                      range,
                                       ExpressionColumn                    *free);

    std::vector<Instruction> instructions;
    unsigned                 height = 0, max_height = 0; ///< of the stack
  };
} // namespace unilateral
