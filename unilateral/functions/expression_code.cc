#include "unilateral/functions/expression_code.h"

#include <algorithm>
#include <cmath>
#include <limits>

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

    void apply_binary(const ExpressionCode::Operation operation, Column &a, const Column &b, const Range range)
    {
      switch (operation)
      {
      case ExpressionCode::Operation::plus:
        add(a, b, range);
        break;
      case ExpressionCode::Operation::minus:
        subtract(a, b, range);
        break;
      case ExpressionCode::Operation::times:
        multiply(a, b, range);
        break;
      default:
        divide(a, b, range);
      }
    }

    /// The same with a number: derivatives are only scaled.
    void apply_number(const ExpressionCode::Operation operation, Column &a, const double b, const Range range)
    {
      switch (operation)
      {
      case ExpressionCode::Operation::plus:
        for (unsigned i = 0; i < range.n_points; ++i)
          a.row[0][i] += b;
        break;
      case ExpressionCode::Operation::minus:
        for (unsigned i = 0; i < range.n_points; ++i)
          a.row[0][i] -= b;
        break;
      case ExpressionCode::Operation::times:
        for (unsigned r = 0; r < range.n_rows; ++r)
          for (unsigned i = 0; i < range.n_points; ++i)
            a.row[r][i] *= b;
        break;
      default:
        for (unsigned r = 0; r < range.n_rows; ++r)
          for (unsigned i = 0; i < range.n_points; ++i)
            a.row[r][i] /= b;
      }
    }

    bool is_binary(const ExpressionCode::Operation operation)
    {
      return operation == ExpressionCode::Operation::plus || operation == ExpressionCode::Operation::minus ||
             operation == ExpressionCode::Operation::times || operation == ExpressionCode::Operation::divided_by;
    }

    /// a^exponent by multiplication.
    void raise(Column &a, const unsigned exponent, const Range range)
    {
      double slope[Column::n_points]; // a^(exponent - 1), in the end times the exponent
      std::copy_n(a.row[0], range.n_points, slope);
      for (unsigned factor = 2; factor < exponent; ++factor)
        for (unsigned i = 0; i < range.n_points; ++i)
          slope[i] *= a.row[0][i];
      for (unsigned i = 0; i < range.n_points; ++i)
      {
        a.row[0][i] *= slope[i];
        slope[i] *= exponent;
      }
      for (unsigned r = 1; r < range.n_rows; ++r)
        for (unsigned i = 0; i < range.n_points; ++i)
          a.row[r][i] *= slope[i];
    }

    /// slope times the derivative of the argument. What does not vary adds nothing, unless the slope is infinite: the product is not
    /// defined then, and not finite. Nor does an argument of slope 0 that is @p not_looked_at.
    double product(const double slope, const double of_argument, const bool not_looked_at)
    {
      const bool   infinite = std::fabs(slope) == std::numeric_limits<double>::infinity();
      const bool   nothing = (of_argument == 0) & !infinite;
      const double result = slope * of_argument;
      return nothing | (not_looked_at & (slope == 0)) ? 0. : result;
    }

    /// f of the columns from @p a on, by the chain rule; the result takes the place of the first.
    void call_function(const ExpressionFunction &f, Column *a, const unsigned n, const Range range)
    {
      constexpr unsigned          few = 4;
      const bool                  with_slopes = range.n_rows > 1;
      double                      values[Column::n_points], few_slopes[few * Column::n_points];
      const double               *few_arguments[few];
      double                     *few_partials[few];
      std::vector<double>         many_slopes(n > few && with_slopes ? n * Column::n_points : 0);
      std::vector<const double *> many_arguments(n > few ? n : 0);
      std::vector<double *>       many_partials(n > few ? n : 0);
      double *const               slopes = n > few ? many_slopes.data() : few_slopes;
      const double **const        arguments = n > few ? many_arguments.data() : few_arguments;
      double **const              partial = n > few ? many_partials.data() : few_partials;
      for (unsigned k = 0; k < n; ++k)
      {
        arguments[k] = a[k].row[0];
        partial[k] = with_slopes ? slopes + k * Column::n_points : nullptr;
      }
      f.values(arguments, n, range.n_points, values);
      if (with_slopes)
        f.derivatives(arguments, n, range.n_points, values, partial);
      const bool selects = f.selects;
      for (unsigned r = 1; r < range.n_rows; ++r)
      {
        for (unsigned i = 0; i < range.n_points; ++i)
          a[0].row[r][i] = product(partial[0][i], a[0].row[r][i], selects);
        for (unsigned k = 1; k < n; ++k)
          for (unsigned i = 0; i < range.n_points; ++i)
            a[0].row[r][i] += product(partial[k][i], a[k].row[r][i], selects);
      }
      std::copy_n(values, range.n_points, a[0].row[0]);
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
    case Operation::power:
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
    static const ExpressionFunction *const pow = find_function("pow");
    if (&function == pow && !instructions.empty() && instructions.back().operation == Operation::constant)
      if (const double exponent = instructions.back().value; exponent == 2 || exponent == 3 || exponent == 4)
      {
        instructions.pop_back();
        --height;
        append({Operation::power, 0, static_cast<unsigned>(exponent), nullptr});
        return;
      }
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
      else if (instruction.operation == Operation::call)
        result.call(*instruction.function, instruction.number);
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
    for (auto instruction = instructions.begin(); instruction != instructions.end(); ++instruction)
    {
      // A number or a variable that the next operation takes need not be copied to the stack.
      const auto next = instruction + 1;
      const bool is_operand = free != stack.data() && next != instructions.end() && is_binary(next->operation);
      if (is_operand && instruction->operation == Operation::constant)
        apply_number(next->operation, free[-1], instruction->value, range);
      else if (is_operand && instruction->operation == Operation::variable)
        apply_binary(next->operation, free[-1], variables[instruction->number], range);
      else
      {
        free = carry_out(*instruction, variables, range, free);
        continue;
      }
      instruction = next;
    }
  }

  namespace
  {
    Interval set_of(const double value, const Interval &)
    {
      return Interval::of(value);
    }

    IntervalWithSlopes set_of(const double value, const IntervalWithSlopes &)
    {
      return {Interval::of(value), {}};
    }
  } // namespace

  template <typename Set, typename Call>
  Set ExpressionCode::on_sets(const std::vector<Set> &variables, std::vector<Set> &stack, const Call &call) const
  {
    if (stack.size() < max_height)
      stack.resize(max_height);
    Set *free = stack.data();
    for (const Instruction &instruction : instructions)
    {
      Set *const a = free - instruction.n_operands();
      switch (instruction.operation)
      {
      case Operation::constant:
        *a = set_of(instruction.value, Set());
        break;
      case Operation::variable:
        *a = variables[instruction.number];
        break;
      case Operation::negative:
        *a = -*a;
        break;
      case Operation::plus:
        *a = a[0] + a[1];
        break;
      case Operation::minus:
        *a = a[0] - a[1];
        break;
      case Operation::times:
        *a = a[0] * a[1];
        break;
      case Operation::divided_by:
        *a = a[0] / a[1];
        break;
      case Operation::power:
        *a = unilateral::power(*a, int(instruction.number));
        break;
      case Operation::call:
        *a = call(*instruction.function, a, instruction.number);
      }
      free = a + 1;
    }
    return stack[0];
  }

  Interval ExpressionCode::range(const std::vector<Interval> &variables, std::vector<Interval> &stack) const
  {
    return on_sets(variables, stack,
                   [](const ExpressionFunction &function, const Interval *const a, const unsigned n)
                   {
                     const bool undefined =
                       !function.branches && std::any_of(a, a + n, [](const Interval &argument) { return argument.undefined; });
                     Interval result = function.range ? function.range(a, n) : Interval::all();
                     result.undefined = result.undefined || undefined;
                     return result;
                   });
  }

  IntervalWithSlopes ExpressionCode::range_and_slopes(const std::vector<IntervalWithSlopes> &variables,
                                                      std::vector<IntervalWithSlopes>       &stack) const
  {
    return on_sets(variables, stack,
                   [](const ExpressionFunction &function, const IntervalWithSlopes *const a, const unsigned n)
                   {
                     const bool undefined =
                       !function.branches && std::any_of(a, a + n, [](const auto &argument) { return argument.value.undefined; });
                     IntervalWithSlopes result{Interval::all(), {}};
                     if (function.slopes)
                       result = function.slopes(a, n);
                     result.value.undefined = result.value.undefined || undefined;
                     if (!function.slopes || result.value.undefined)
                       result.slopes.fill(Interval::all());
                     return result;
                   });
  }

  ExpressionColumn *ExpressionCode::carry_out(const Instruction                   &instruction,
                                              const std::vector<ExpressionColumn> &variables,
                                              const ExpressionRange                range,
                                              ExpressionColumn *const              free)
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
    case Operation::power:
      raise(*operands, instruction.number, range);
      break;
    case Operation::call:
      call_function(*instruction.function, operands, instruction.number, range);
      break;
    default:
      apply_binary(instruction.operation, operands[0], operands[1], range);
    }
    return operands + 1;
  }
} // namespace unilateral
