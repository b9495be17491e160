#include "unilateral/functions/expression_code.h"

#include <algorithm>

namespace unilateral
{
  namespace
  {
    using Column = ExpressionColumn;
    using Range = ExpressionRange;

    void fill(Column &a, const double value, const Range range)
    {
      std::fill_n(a.row[0], range.n_points, value);
      for (unsigned r = 1; r < range.n_rows; ++r)
        std::fill_n(a.row[r], range.n_points, 0.);
    }

    void change_sign(Column &a, const Range range)
    {
      for (unsigned r = 0; r < range.n_rows; ++r)
        for (unsigned i = 0; i < range.n_points; ++i)
          a.row[r][i] = -a.row[r][i];
    }

    void add(Column &a, const Column &b, const Range range)
    {
      for (unsigned r = 0; r < range.n_rows; ++r)
        for (unsigned i = 0; i < range.n_points; ++i)
          a.row[r][i] += b.row[r][i];
    }

    void subtract(Column &a, const Column &b, const Range range)
    {
      for (unsigned r = 0; r < range.n_rows; ++r)
        for (unsigned i = 0; i < range.n_points; ++i)
          a.row[r][i] -= b.row[r][i];
    }

    void multiply(Column &a, const Column &b, const Range range)
    {
      for (unsigned r = 1; r < range.n_rows; ++r)
        for (unsigned i = 0; i < range.n_points; ++i)
          a.row[r][i] = a.row[r][i] * b.row[0][i] + a.row[0][i] * b.row[r][i];
      for (unsigned i = 0; i < range.n_points; ++i)
        a.row[0][i] *= b.row[0][i];
    }

    void divide(Column &a, const Column &b, const Range range)
    {
      for (unsigned i = 0; i < range.n_points; ++i)
        a.row[0][i] /= b.row[0][i];
      for (unsigned r = 1; r < range.n_rows; ++r)
        for (unsigned i = 0; i < range.n_points; ++i)
          a.row[r][i] = (a.row[r][i] - a.row[0][i] * b.row[r][i]) / b.row[0][i];
    }

    /// f of the columns from @p a on, by the chain rule; the result takes the place of the first.
    void call_function(const ExpressionFunction &f, Column *a, const unsigned n, const Range range)
    {
      constexpr unsigned  few = 4;
      double              few_arguments[few], few_partials[few];
      std::vector<double> many(n > few ? 2 * n : 0);
      double *const       arguments = n > few ? many.data() : few_arguments;
      double *const       partials = n > few ? many.data() + n : few_partials;
      for (unsigned i = 0; i < range.n_points; ++i)
      {
        for (unsigned k = 0; k < n; ++k)
          arguments[k] = a[k].row[0][i];
        const double value = f.value(arguments, n);
        a[0].row[0][i] = value;
        if (range.n_rows == 1)
          continue;
        bool varies = false;
        for (unsigned k = 0; k < n; ++k)
          for (unsigned r = 1; r < range.n_rows; ++r)
            varies = varies || a[k].row[r][i] != 0;
        if (!varies)
        {
          for (unsigned r = 1; r < range.n_rows; ++r)
            a[0].row[r][i] = 0;
          continue;
        }
        f.derivatives(arguments, n, value, partials);
        for (unsigned r = 1; r < range.n_rows; ++r)
        {
          // What does not vary, or is not looked at, adds nothing, be its other factor finite or not.
          double sum = 0;
          for (unsigned k = 0; k < n; ++k)
            if (a[k].row[r][i] != 0 && partials[k] != 0)
              sum += partials[k] * a[k].row[r][i];
          a[0].row[r][i] = sum;
        }
      }
    }
  } // namespace

  void copy(const ExpressionColumn &from, ExpressionColumn &to, const ExpressionRange range)
  {
    for (unsigned r = 0; r < range.n_rows; ++r)
      std::copy_n(from.row[r], range.n_points, to.row[r]);
  }

  unsigned ExpressionCode::Instruction::n_operands() const
  {
    switch (operation)
    {
    case Operation::constant:
    case Operation::variable:
      return 0;
    case Operation::negative:
      return 1;
    case Operation::call:
      return number;
    default:
      return 2;
    }
  }

  void ExpressionCode::constant(const double value)
  {
    append({Operation::constant, value, 0, nullptr});
  }

  void ExpressionCode::variable(const unsigned number)
  {
    append({Operation::variable, 0, number, nullptr});
  }

  void ExpressionCode::apply(const Operation operation)
  {
    append({operation, 0, 0, nullptr});
  }

  void ExpressionCode::call(const ExpressionFunction &function, const unsigned n_arguments)
  {
    append({Operation::call, 0, n_arguments, &function});
  }

  void ExpressionCode::append(const Instruction &instruction)
  {
    const unsigned n = instruction.n_operands();
    const auto     operands = instructions.end() - std::min<std::size_t>(n, instructions.size());
    const bool     known =
      n > 0 && std::all_of(operands, instructions.end(), [](const Instruction &i) { return i.operation == Operation::constant; });
    height = height + 1 - n;
    max_height = std::max(max_height, height);
    if (!known)
    {
      instructions.push_back(instruction);
      return;
    }
    ExpressionCode alone;
    alone.instructions.assign(operands, instructions.end());
    alone.instructions.push_back(instruction);
    alone.max_height = n;
    std::vector<ExpressionColumn> stack;
    alone.evaluate({}, {}, stack);
    instructions.erase(operands, instructions.end());
    instructions.push_back({Operation::constant, stack[0].row[0][0], 0, nullptr});
  }

  ExpressionCode ExpressionCode::with(const std::vector<std::optional<double>> &values) const
  {
    ExpressionCode result;
    for (const Instruction &instruction : instructions)
      if (instruction.operation == Operation::variable && values[instruction.number])
        result.constant(*values[instruction.number]);
      else
        result.append(instruction);
    return result;
  }

  std::optional<double> ExpressionCode::constant_value() const
  {
    if (instructions.size() == 1 && instructions[0].operation == Operation::constant)
      return instructions[0].value;
    return {};
  }

  void ExpressionCode::evaluate(const std::vector<ExpressionColumn> &variables,
                                const ExpressionRange                range,
                                std::vector<ExpressionColumn>       &stack) const
  {
    if (stack.size() < max_height)
      stack.resize(max_height);
    ExpressionColumn *free = stack.data(); // the first column above the operands
    for (const Instruction &instruction : instructions)
    {
      ExpressionColumn *const operands = free - instruction.n_operands();
      switch (instruction.operation)
      {
      case Operation::constant:
        fill(*operands, instruction.value, range);
        break;
      case Operation::variable:
        copy(variables[instruction.number], *operands, range);
        break;
      case Operation::negative:
        change_sign(*operands, range);
        break;
      case Operation::plus:
        add(operands[0], operands[1], range);
        break;
      case Operation::minus:
        subtract(operands[0], operands[1], range);
        break;
      case Operation::times:
        multiply(operands[0], operands[1], range);
        break;
      case Operation::divided_by:
        divide(operands[0], operands[1], range);
        break;
      case Operation::call:
        call_function(*instruction.function, operands, instruction.number, range);
        break;
      }
      free = operands + 1;
    }
  }
} // namespace unilateral
