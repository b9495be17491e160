// Expressions in x, y, z and the [parameters].
#pragma once

#include "unilateral/base/diagnostics.h"
#include "unilateral/functions/expression_parser.h"
#include "unilateral/functions/field_spec.h"
#include "unilateral/functions/sampled_field.h"

#include <array>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace unilateral
{
  /// The [parameters] as expressions use them. Expressions that share them compute each parameter once where they are evaluated at the
  /// same points one after the other. Not thread-safe, and neither are those expressions together.
  class CompiledParameters
  {
  public:
    /// The first @p dim of x, y, z are known. Throws InputError with everything that is wrong with the parameters, each at its place.
    /// Parameters that are rasters, profiles or solutions are read by @p read_samples when an expression first needs them.
    CompiledParameters(std::vector<Parameter> parameters, unsigned dim, SampleReader read_samples = read_sampled_field);
    ~CompiledParameters();

  private:
    friend class Expression;
    struct State;
    std::unique_ptr<State> state;
  };

  /// A compiled expression together with the parameters that it uses. Not thread-safe.
  class Expression
  {
  public:
    /// Compiles @p spec.text. Throws InputError with everything that is wrong with it, each at its place.
    /// The text may use @p quantities, whose values come with the points.
    Expression(const FieldSpec &spec, std::shared_ptr<CompiledParameters> parameters, const std::vector<std::string> &quantities = {});
    Expression(const FieldSpec &spec, const std::vector<Parameter> &parameters, unsigned dim = 3);

    double value(double x, double y, double z) const;

    /// The values at @p points, and unless @p gradients is empty the derivatives by x, y, z there: exact up to rounding, not finite or that
    /// of one side where there is none. The spans are of the same size.
    void
    values(std::span<const std::array<double, 3>> points, std::span<double> values, std::span<std::array<double, 3>> gradients = {}) const;

    /// Those of the quantities that the text uses.
    const std::vector<std::string> &used_quantities() const { return quantities; }

    /// The values at @p points, where the used quantities have @p at_points (a number per point for each).
    void values(std::span<const std::array<double, 3>>  points,
                const std::vector<std::vector<double>> &at_points,
                std::span<double>                       values) const;

    /// Contains every value in a box; none where parameters are known at samples.
    std::optional<Interval> range(const std::array<Interval, 3> &box) const;
    /// The same with slopes, see IntervalWithSlopes.
    std::optional<IntervalWithSlopes> range_and_slopes(const std::array<Interval, 3> &box) const;

    bool is_constant() const; ///< uses none of x, y, z and no quantity, directly or through parameters

    /// "r = 0, s = nan": the parameters at the last point of evaluation, to explain a value that is not finite; empty without parameters.
    std::string parameter_values() const;

    /// The least distance between samples of the parameters in it that are known at samples; 0: of none.
    double sample_spacing() const;

  private:
    const ExpressionColumn &evaluate(std::span<const std::array<double, 3>> points, bool with_gradient) const;

    std::shared_ptr<CompiledParameters> parameters;
    std::vector<unsigned>               used; ///< parameters that vary, those before what uses them
    std::vector<std::string>            quantities;
    ExpressionCode                      code;
    mutable unsigned                    last_point = 0; ///< the one of the last evaluation, in the columns
  };

  /// Checks all parameters: names that hide a coordinate, constant or function, their texts, and cycles among them.
  void check_parameters(const std::vector<Parameter> &parameters, unsigned dim, Diagnostics &diagnostics);
} // namespace unilateral
