#include "unilateral/functions/expression.h"

#include "unilateral/functions/expression_code.h"
#include "unilateral/functions/expression_functions.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <cstring>
#include <optional>
#include <utility>

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
  struct CompiledParameters::State
  {
    State(std::vector<Parameter> given, const unsigned dim, SampleReader read_samples)
      : parameters(std::move(given)), dim(dim), read_samples(std::move(read_samples)), compiled(parameters.size()),
        sampled(parameters.size()), constants(3 + parameters.size()), columns(3 + parameters.size()), is_known(parameters.size(), false)
    {
      for (unsigned d = 0; d < 3; ++d)
        for (unsigned r = 1; r <= 3; ++r)
          std::fill_n(columns[d].row[r], ExpressionColumn::n_points, r == d + 1 ? 1. : 0.);
    }

    /// The code of an expression; adds the parameters that it needs to @p used, those before what uses them.
    ExpressionCode compile(const FieldSpec &spec, std::vector<unsigned> &used)
    {
      std::vector<std::string> none;
      return compile(spec, none, used);
    }

    /// The text may use @p quantities, of which those that it does use are left.
    ExpressionCode compile(const FieldSpec &spec, std::vector<std::string> &quantities, std::vector<unsigned> &used)
    {
      Diagnostics      diagnostics;
      ParsedExpression parsed = parse_expression(spec, parameters, dim, diagnostics, quantities);
      diagnostics.throw_if_errors();
      if (!quantities.empty())
      {
        // Numbered anew, without those that do not occur.
        std::erase_if(quantities, [&](const std::string &name)
                      { return std::find(parsed.used.begin(), parsed.used.end(), name) == parsed.used.end(); });
        parsed = parse_expression(spec, parameters, dim, diagnostics, quantities);
        const std::size_t n = 3 + parameters.size() + quantities.size();
        constants.resize(std::max(constants.size(), n));
        columns.resize(std::max(columns.size(), n));
      }
      for (unsigned j = 0; j < parameters.size(); ++j)
        if (std::find(parsed.used.begin(), parsed.used.end(), parameters[j].name) != parsed.used.end())
          compile_parameter(j, used);
      return parsed.code.with(constants);
    }

    void compile_parameter(const unsigned j, std::vector<unsigned> &used)
    {
      const FieldSpec &spec = parameters[j].value;
      if (constants[3 + j] || std::find(used.begin(), used.end(), j) != used.end())
        return;
      if (spec.kind == FieldSpec::Kind::constant)
      {
        constants[3 + j] = spec.value;
        return;
      }
      if (is_sampled(spec))
      {
        if (!sampled[j])
          sampled[j] = read_samples(spec);
        if (sampled[j]->is_constant())
          constants[3 + j] = sampled[j]->value(dealii::Point<1>());
      }
      else
      {
        compiled[j] = compile(spec, used);
        constants[3 + j] = compiled[j].constant_value();
      }
      if (!constants[3 + j])
        used.push_back(j);
    }

    /// Forgets what is known of parameters, unless these are the points at hand, bit for bit: -0 is not 0.
    void set_points(const std::span<const std::array<double, 3>> given, const unsigned n_rows)
    {
      if (!given.empty() && given.size() == range.n_points && n_rows <= range.n_rows &&
          std::memcmp(given.data(), points.data(), given.size_bytes()) == 0)
        return;
      points.assign(given.begin(), given.end());
      for (std::size_t i = 0; i < points.size(); ++i)
        for (unsigned d = 0; d < 3; ++d)
          columns[d].row[0][i] = points[i][d];
      range = {static_cast<unsigned>(points.size()), n_rows};
      is_known.assign(is_known.size(), false);
    }

    void evaluate(const unsigned j)
    {
      if (is_known[j])
        return;
      if (sampled[j])
        dim == 1 ? evaluate_sampled<1>(j) : dim == 2 ? evaluate_sampled<2>(j) : evaluate_sampled<3>(j);
      else
      {
        compiled[j].evaluate(columns, range, stack);
        copy(stack[0], columns[3 + j], range);
      }
      is_known[j] = true;
    }

    template <int d>
    void evaluate_sampled(const unsigned j)
    {
      std::vector<dealii::Point<d>> points(range.n_points);
      for (unsigned i = 0; i < range.n_points; ++i)
        for (unsigned k = 0; k < d; ++k)
          points[i][k] = columns[k].row[0][i];
      std::vector<double>               values;
      std::vector<dealii::Tensor<1, d>> gradients;
      if (range.n_rows > 1)
        sampled[j]->values_and_gradients(points, values, gradients);
      else
        sampled[j]->values(points, values);
      for (unsigned i = 0; i < range.n_points; ++i)
      {
        columns[3 + j].row[0][i] = values[i];
        for (unsigned r = 1; r < range.n_rows; ++r)
          columns[3 + j].row[r][i] = r <= d ? gradients[i][r - 1] : 0.;
      }
    }

    const std::vector<Parameter>              parameters;
    const unsigned                            dim;
    const SampleReader                        read_samples;
    std::vector<ExpressionCode>               compiled;  ///< by parameter
    std::vector<std::optional<FieldFunction>> sampled;   ///< by parameter
    std::vector<std::optional<double>>        constants; ///< by variable of the code: x, y, z, parameters; none of quantities
    std::vector<ExpressionColumn>             columns;   ///< the same
    std::vector<bool>                         is_known;  ///< by parameter: the column is that for the points at hand
    std::vector<std::array<double, 3>>        points;    ///< at hand
    ExpressionRange                           range = {0, 1};
    std::vector<ExpressionColumn>             stack;
    std::vector<Interval>                     intervals, interval_stack; ///< by variable
    std::vector<IntervalWithSlopes>           sets, set_stack;           ///< likewise
  };

  CompiledParameters::CompiledParameters(std::vector<Parameter> parameters, const unsigned dim, SampleReader read_samples)
  {
    // A cycle would make the compilation run in circles.
    Diagnostics diagnostics;
    check_parameters(parameters, dim, diagnostics);
    diagnostics.throw_if_errors();
    state = std::make_unique<State>(std::move(parameters), dim, std::move(read_samples));
  }

  CompiledParameters::~CompiledParameters() = default;

  Expression::Expression(const FieldSpec                    &spec,
                         std::shared_ptr<CompiledParameters> shared_parameters,
                         const std::vector<std::string>     &known_quantities)
    : parameters(std::move(shared_parameters)), quantities(known_quantities), code(parameters->state->compile(spec, quantities, used))
  {
  }

  Expression::Expression(const FieldSpec &spec, const std::vector<Parameter> &parameters, const unsigned dim)
    : Expression(spec, std::make_shared<CompiledParameters>(parameters, dim))
  {
  }

  const ExpressionColumn &Expression::evaluate(const std::span<const std::array<double, 3>> points, const bool with_gradient) const
  {
    CompiledParameters::State &state = *parameters->state;
    const unsigned             n_rows = with_gradient ? 1 + state.dim : 1;
    state.set_points(points, n_rows);
    for (const unsigned j : used)
      state.evaluate(j);
    code.evaluate(state.columns, {static_cast<unsigned>(points.size()), n_rows}, state.stack);
    last_point = points.size() - 1;
    return state.stack[0];
  }

  double Expression::value(const double x, const double y, const double z) const
  {
    const std::array<double, 3> point = {x, y, z};
    return evaluate({&point, 1}, false).row[0][0];
  }

  void Expression::values(const std::span<const std::array<double, 3>> points,
                          const std::span<double>                      values,
                          const std::span<std::array<double, 3>>       gradients) const
  {
    for (std::size_t begin = 0; begin < points.size(); begin += ExpressionColumn::n_points)
    {
      const std::size_t       n = std::min<std::size_t>(ExpressionColumn::n_points, points.size() - begin);
      const ExpressionColumn &result = evaluate(points.subspan(begin, n), !gradients.empty());
      std::copy_n(result.row[0], n, values.begin() + begin);
      for (std::size_t i = 0; i < n && !gradients.empty(); ++i)
        for (unsigned d = 0; d < 3; ++d)
          gradients[begin + i][d] = d < parameters->state->dim ? result.row[1 + d][i] : 0.;
    }
  }

  void Expression::values(const std::span<const std::array<double, 3>> points,
                          const std::vector<std::vector<double>>      &at_points,
                          const std::span<double>                      values) const
  {
    CompiledParameters::State &state = *parameters->state;
    const std::size_t          first = 3 + state.parameters.size();
    for (std::size_t begin = 0; begin < points.size(); begin += ExpressionColumn::n_points)
    {
      const std::size_t n = std::min<std::size_t>(ExpressionColumn::n_points, points.size() - begin);
      for (std::size_t k = 0; k < quantities.size(); ++k)
        std::copy_n(at_points[k].begin() + begin, n, state.columns[first + k].row[0]);
      std::copy_n(evaluate(points.subspan(begin, n), false).row[0], n, values.begin() + begin);
    }
  }

  std::optional<Interval> Expression::range(const std::array<Interval, 3> &box) const
  {
    CompiledParameters::State &state = *parameters->state;
    if (!quantities.empty())
      return {};
    state.intervals.resize(state.columns.size());
    std::copy(box.begin(), box.end(), state.intervals.begin());
    for (const unsigned j : used)
      if (state.sampled[j])
        return {};
      else
        state.intervals[3 + j] = state.compiled[j].range(state.intervals, state.interval_stack);
    return code.range(state.intervals, state.interval_stack);
  }

  std::optional<IntervalWithSlopes> Expression::range_and_slopes(const std::array<Interval, 3> &box) const
  {
    CompiledParameters::State &state = *parameters->state;
    if (!quantities.empty())
      return {};
    state.sets.resize(state.columns.size());
    for (unsigned d = 0; d < 3; ++d)
    {
      state.sets[d] = {box[d], {}};
      state.sets[d].slopes[d] = Interval::of(1);
    }
    for (const unsigned j : used)
      if (state.sampled[j])
        return {};
      else
        state.sets[3 + j] = state.compiled[j].range_and_slopes(state.sets, state.set_stack);
    return code.range_and_slopes(state.sets, state.set_stack);
  }

  bool Expression::is_constant() const
  {
    return code.constant_value().has_value();
  }

  double Expression::sample_spacing() const
  {
    double least = 0;
    for (const unsigned j : used)
      if (const auto &samples = parameters->state->sampled[j]; samples && samples->sample_spacing() > 0)
        least = least > 0 ? std::min(least, samples->sample_spacing()) : samples->sample_spacing();
    return least;
  }

  std::string Expression::parameter_values() const
  {
    const CompiledParameters::State &state = *parameters->state;
    std::string                      text;
    for (const unsigned j : used)
      text += fmt::format("{}{} = {}", text.empty() ? "" : ", ", state.parameters[j].name, state.columns[3 + j].row[0][last_point]);
    return text;
  }

  void check_parameters(const std::vector<Parameter> &parameters, const unsigned dim, Diagnostics &diagnostics)
  {
    for (const Parameter &parameter : parameters)
    {
      const std::string &name = parameter.name;
      const auto        &constants = expression_constants();
      if (!is_name(name))
        diagnostics.error(parameter.where, fmt::format("'{}' cannot name a parameter: letters, digits and _ only, no digit first", name),
                          MessageName("parameter-name"));
      else if (name == "x" || name == "y" || name == "z")
        diagnostics.error(parameter.where, fmt::format("parameter '{}' would hide the coordinate; choose another name", name),
                          MessageName("parameter-name"));
      else if (std::any_of(constants.begin(), constants.end(), [&](const auto &constant) { return constant.first == name; }))
        diagnostics.error(parameter.where, fmt::format("parameter '{}' would hide the constant; choose another name", name),
                          MessageName("parameter-name"));
      else if (find_function(name))
        diagnostics.error(parameter.where, fmt::format("parameter '{}' would hide the function; choose another name", name),
                          MessageName("parameter-name"));
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
          diagnostics.error(parameters[next].where, fmt::format("parameter '{0}' depends on itself: {1}{0}", parameters[next].name, chain),
                            MessageName("parameter-cycle"));
        }
      }
    }
  }
} // namespace unilateral
