#include "unilateral/functions/expression.h"

#include "unilateral/functions/expression_code.h"
#include "unilateral/functions/expression_functions.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <optional>

namespace unilateral
{
  namespace
  {
    /// Whether an expression could refer to it.
    bool is_name(const std::string &text)
    {
      constexpr std::size_t max_length = 100;
      const auto            letter = [](const char c) { return std::isalpha(static_cast<unsigned char>(c)) || c == '_'; };
      const auto            digit = [](const char c) { return std::isdigit(static_cast<unsigned char>(c)) != 0; };
      return !text.empty() && text.size() <= max_length && letter(text[0]) &&
             std::all_of(text.begin(), text.end(), [&](const char c) { return letter(c) || digit(c); });
    }
  } // namespace

  /// Parameters that vary are evaluated before what uses them, once a point; the others are numbers in the code.
  struct Expression::Program
  {
    struct Step
    {
      std::string    name; ///< of the parameter
      unsigned       variable = 0;
      ExpressionCode code;
    };

    std::vector<Step>                     steps;
    ExpressionCode                        code;
    unsigned                              dim = 3;
    mutable unsigned                      last_point = 0; ///< the one of the last evaluation, in the columns
    std::vector<std::optional<double>>    constants;      ///< by variable
    mutable std::vector<ExpressionColumn> variables, stack;

    /// The code of an expression, after that of the parameters that it uses.
    ExpressionCode compile(const FieldSpec &spec, const std::vector<Parameter> &parameters, const unsigned dim)
    {
      Diagnostics            diagnostics;
      const ParsedExpression parsed = parse_expression(spec, parameters, dim, diagnostics);
      diagnostics.throw_if_errors();
      for (std::size_t j = 0; j < parameters.size(); ++j)
        if (std::find(parsed.used.begin(), parsed.used.end(), parameters[j].name) != parsed.used.end())
          add_parameter(j, parameters, dim);
      return parsed.code.with(constants);
    }

    void add_parameter(const std::size_t j, const std::vector<Parameter> &parameters, const unsigned dim)
    {
      const unsigned variable = 3 + j;
      if (constants[variable] || std::any_of(steps.begin(), steps.end(), [&](const Step &step) { return step.variable == variable; }))
        return;
      const FieldSpec &spec = parameters[j].value;
      if (spec.kind == FieldSpec::Kind::constant)
      {
        constants[variable] = spec.value;
        return;
      }
      ExpressionCode compiled = compile(spec, parameters, dim);
      constants[variable] = compiled.constant_value();
      if (!constants[variable])
        steps.push_back({parameters[j].name, variable, std::move(compiled)});
    }

    /// Evaluates at the points whose coordinates are in the columns of x, y and z; the result is in stack[0].
    void evaluate(const ExpressionRange range) const
    {
      for (const Step &step : steps)
      {
        step.code.evaluate(variables, range, stack);
        copy(stack[0], variables[step.variable], range);
      }
      code.evaluate(variables, range, stack);
    }
  };

  Expression::Expression(const FieldSpec &spec, const std::vector<Parameter> &parameters, const unsigned dim)
    : program(std::make_unique<Program>())
  {
    // A cycle would make the compilation run in circles.
    Diagnostics in_parameters;
    check_parameters(parameters, dim, in_parameters);
    in_parameters.throw_if_errors();

    program->dim = dim;
    program->constants.resize(3 + parameters.size());
    program->variables.resize(3 + parameters.size());
    program->code = program->compile(spec, parameters, dim);
    for (unsigned d = 0; d < 3; ++d)
      for (unsigned r = 1; r <= 3; ++r)
        std::fill_n(program->variables[d].row[r], ExpressionColumn::n_points, r == d + 1 ? 1. : 0.);
  }

  Expression::~Expression() = default;

  double Expression::value(const double x, const double y, const double z) const
  {
    program->variables[0].row[0][0] = x;
    program->variables[1].row[0][0] = y;
    program->variables[2].row[0][0] = z;
    program->evaluate({});
    program->last_point = 0;
    return program->stack[0].row[0][0];
  }

  void Expression::values(const std::span<const std::array<double, 3>> points,
                          const std::span<double>                      values,
                          const std::span<std::array<double, 3>>       gradients) const
  {
    for (std::size_t begin = 0; begin < points.size(); begin += ExpressionColumn::n_points)
    {
      const unsigned n = std::min<std::size_t>(ExpressionColumn::n_points, points.size() - begin);
      for (unsigned i = 0; i < n; ++i)
        for (unsigned d = 0; d < 3; ++d)
          program->variables[d].row[0][i] = points[begin + i][d];
      program->evaluate({n, gradients.empty() ? 1 : 1 + program->dim});
      program->last_point = n - 1;
      const ExpressionColumn &result = program->stack[0];
      std::copy_n(result.row[0], n, values.begin() + begin);
      for (unsigned i = 0; i < n && !gradients.empty(); ++i)
        for (unsigned d = 0; d < 3; ++d)
          gradients[begin + i][d] = d < program->dim ? result.row[1 + d][i] : 0.;
    }
  }

  bool Expression::is_constant() const
  {
    return program->code.constant_value().has_value();
  }

  std::string Expression::parameter_values() const
  {
    std::string text;
    for (const auto &step : program->steps)
      text += fmt::format("{}{} = {}", text.empty() ? "" : ", ", step.name, program->variables[step.variable].row[0][program->last_point]);
    return text;
  }

  void check_parameters(const std::vector<Parameter> &parameters, const unsigned dim, Diagnostics &diagnostics)
  {
    for (const Parameter &parameter : parameters)
    {
      const std::string &name = parameter.name;
      const auto        &constants = expression_constants();
      if (!is_name(name))
        diagnostics.error(parameter.where, fmt::format("'{}' cannot name a parameter: letters, digits and _ only, no digit first", name));
      else if (name == "x" || name == "y" || name == "z")
        diagnostics.error(parameter.where, fmt::format("parameter '{}' would hide the coordinate; choose another name", name));
      else if (std::any_of(constants.begin(), constants.end(), [&](const auto &constant) { return constant.first == name; }))
        diagnostics.error(parameter.where, fmt::format("parameter '{}' would hide the constant; choose another name", name));
      else if (find_function(name))
        diagnostics.error(parameter.where, fmt::format("parameter '{}' would hide the function; choose another name", name));
    }

    // Depth first through "uses": a parameter met again on its own path closes a cycle.
    std::vector<std::vector<std::size_t>> uses(parameters.size());
    for (std::size_t i = 0; i < parameters.size(); ++i)
      if (parameters[i].value.kind == FieldSpec::Kind::expression)
        for (const std::string &name : parse_expression(parameters[i].value, parameters, dim, diagnostics).used)
          for (std::size_t j = 0; j < parameters.size(); ++j)
            if (parameters[j].name == name)
              uses[i].push_back(j);

    enum class State
    {
      fresh,
      on_path,
      done
    };
    std::vector<State> state(parameters.size(), State::fresh);
    for (std::size_t start = 0; start < parameters.size(); ++start)
    {
      if (state[start] != State::fresh)
        continue;
      std::vector<std::pair<std::size_t, std::size_t>> path = {{start, 0}}; // parameter, next of its uses
      state[start] = State::on_path;
      while (!path.empty())
      {
        const std::size_t current = path.back().first;
        if (path.back().second == uses[current].size())
        {
          state[current] = State::done;
          path.pop_back();
          continue;
        }
        const std::size_t next = uses[current][path.back().second++];
        if (state[next] == State::fresh)
        {
          state[next] = State::on_path;
          path.push_back({next, 0});
        }
        else if (state[next] == State::on_path)
        {
          std::string chain;
          bool        inside = false;
          for (const auto &[on_path, unused] : path)
          {
            inside = inside || on_path == next;
            if (inside)
              chain += parameters[on_path].name + " -> ";
          }
          diagnostics.error(parameters[next].where, fmt::format("parameter '{0}' depends on itself: {1}{0}", parameters[next].name, chain));
        }
      }
    }
  }
} // namespace unilateral
