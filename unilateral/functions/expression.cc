#include "unilateral/functions/expression.h"

#include "unilateral/functions/expression_functions.h"

#include <fmt/format.h>
#include <muParser.h>

#include <algorithm>
#include <array>
#include <cctype>

namespace unilateral
{
  namespace
  {
    /// A parser that knows our functions and constants and no others.
    mu::Parser make_parser()
    {
      mu::Parser parser;
      parser.ClearFun();
      parser.ClearConst();
      for (const ExpressionFunction &function : expression_functions())
        if (function.unary)
          parser.DefineFun(function.name, function.unary);
        else if (function.binary)
          parser.DefineFun(function.name, function.binary);
        else if (function.ternary)
          parser.DefineFun(function.name, function.ternary);
        else
          parser.DefineFun(function.name, function.variadic);
      for (const auto &[name, value] : expression_constants())
        parser.DefineConst(name, value);
      return parser;
    }

    /// Whether an expression could refer to it.
    bool is_name(const std::string &text)
    {
      constexpr std::size_t max_length = 100; // muParser's
      const auto            letter = [](const char c) { return std::isalpha(static_cast<unsigned char>(c)) || c == '_'; };
      const auto            digit = [](const char c) { return std::isdigit(static_cast<unsigned char>(c)) != 0; };
      return !text.empty() && text.size() <= max_length && letter(text[0]) &&
             std::all_of(text.begin(), text.end(), [&](const char c) { return letter(c) || digit(c); });
    }
  } // namespace

  /// Parameters that vary are evaluated before what uses them, once a point.
  struct Expression::Program
  {
    struct Step
    {
      std::string name; ///< of the parameter
      double      value = 0;
      mu::Parser  parser;
    };

    std::array<double, 3>              point = {0, 0, 0};
    std::vector<std::unique_ptr<Step>> steps; ///< muParser keeps the addresses of `value`
    mu::Parser                         parser;
    bool                               constant = true;

    /// Lets @p user know the names and compiles it.
    void compile(mu::Parser                                  &user,
                 const FieldSpec                             &spec,
                 const std::vector<Parameter>                &parameters,
                 const unsigned                               dim,
                 std::vector<std::pair<std::string, double>> &constants,
                 bool                                        &is_constant)
    {
      Diagnostics                    diagnostics;
      const std::vector<std::string> used = check_expression(spec, parameters, dim, diagnostics);
      diagnostics.throw_if_errors();
      user = make_parser();
      is_constant = true;
      for (const std::string &name : used)
      {
        const auto parameter = std::find_if(parameters.begin(), parameters.end(), [&](const Parameter &p) { return p.name == name; });
        if (parameter == parameters.end()) // x, y or z
        {
          user.DefineVar(name, &point[name[0] - 'x']);
          is_constant = false;
          continue;
        }
        if (parameter->value.kind == FieldSpec::Kind::constant)
        {
          user.DefineConst(name, parameter->value.value);
          continue;
        }
        add_parameter(*parameter, parameters, dim, constants);
        const auto known = std::find_if(constants.begin(), constants.end(), [&](const auto &c) { return c.first == name; });
        if (known != constants.end())
          user.DefineConst(name, known->second);
        else
        {
          const auto step = std::find_if(steps.begin(), steps.end(), [&](const auto &s) { return s->name == name; });
          user.DefineVar(name, &(*step)->value);
          is_constant = false;
        }
      }
      try
      {
        user.SetExpr(spec.text);
        user.Eval();
      }
      catch (const mu::ParserError &e)
      {
        throw InputError(spec.where, fmt::format("the expression '{}' cannot be read: {}", spec.text, e.GetMsg()));
      }
    }

    void add_parameter(const Parameter                             &parameter,
                       const std::vector<Parameter>                &parameters,
                       const unsigned                               dim,
                       std::vector<std::pair<std::string, double>> &constants)
    {
      if (std::any_of(steps.begin(), steps.end(), [&](const auto &s) { return s->name == parameter.name; }) ||
          std::any_of(constants.begin(), constants.end(), [&](const auto &c) { return c.first == parameter.name; }))
        return;
      auto step = std::make_unique<Step>();
      bool step_is_constant = true;
      step->name = parameter.name;
      compile(step->parser, parameter.value, parameters, dim, constants, step_is_constant);
      if (step_is_constant)
        constants.emplace_back(parameter.name, step->parser.Eval());
      else
        steps.push_back(std::move(step));
    }
  };

  Expression::Expression(const FieldSpec &spec, const std::vector<Parameter> &parameters, const unsigned dim)
    : program(std::make_unique<Program>())
  {
    // A cycle would make the compilation run in circles.
    Diagnostics in_parameters;
    check_parameters(parameters, dim, in_parameters);
    in_parameters.throw_if_errors();

    std::vector<std::pair<std::string, double>> constants;
    program->compile(program->parser, spec, parameters, dim, constants, program->constant);
  }

  Expression::~Expression() = default;

  double Expression::value(const double x, const double y, const double z) const
  {
    program->point = {x, y, z};
    for (const auto &step : program->steps)
      step->value = step->parser.Eval();
    return program->parser.Eval();
  }

  bool Expression::is_constant() const
  {
    return program->constant;
  }

  std::string Expression::parameter_values() const
  {
    std::string text;
    for (const auto &step : program->steps)
      text += fmt::format("{}{} = {}", text.empty() ? "" : ", ", step->name, step->value);
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
        for (const std::string &name : check_expression(parameters[i].value, parameters, dim, diagnostics))
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
