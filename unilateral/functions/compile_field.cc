#include "unilateral/functions/compile_field.h"

#include "unilateral/functions/expression.h"
#include "unilateral/functions/sampled_field.h"

#include <fmt/format.h>

#include <cmath>
#include <stdexcept>

namespace unilateral
{
  namespace
  {
    class ExpressionSource : public FieldFunction::Source
    {
    public:
      ExpressionSource(const FieldSpec &spec, std::unique_ptr<Expression> compiled) : text(spec.text), expression(std::move(compiled)) {}
      double value(const double x, const double y, const double z) const override { return expression->value(x, y, z); }
      bool   values(const std::span<const std::array<double, 3>> points,
                    const std::span<double>                      values,
                    const std::span<std::array<double, 3>>       gradients) const override
      {
        expression->values(points, values, gradients);
        return true;
      }
      std::optional<Interval>           range(const std::array<Interval, 3> &box) const override { return expression->range(box); }
      std::optional<IntervalWithSlopes> range_and_slopes(const std::array<Interval, 3> &box) const override
      {
        return expression->range_and_slopes(box);
      }
      double      sample_spacing() const override { return expression->sample_spacing(); }
      std::string explanation() const override
      {
        const std::string parameters = expression->parameter_values();
        return fmt::format("the expression '{}'{}", text, parameters.empty() ? "" : " with " + parameters);
      }

    private:
      const std::string                 text;
      const std::unique_ptr<Expression> expression;
    };

    FieldFunction compile(const FieldSpec &spec, const std::shared_ptr<CompiledParameters> &parameters)
    {
      switch (spec.kind)
      {
      case FieldSpec::Kind::constant:
        return {spec.value, spec.where};
      case FieldSpec::Kind::expression:
      {
        auto expression = std::make_unique<Expression>(spec, parameters);
        if (!expression->is_constant())
          return {std::make_shared<ExpressionSource>(spec, std::move(expression)), spec.where};
        const double value = expression->value(0, 0, 0);
        if (!std::isfinite(value))
          throw InputError(spec.where, fmt::format("the expression '{}' is not finite, it is {}", spec.text, value),
                           MessageName("no-value"));
        return {value, spec.where};
      }
      case FieldSpec::Kind::given:
        throw std::logic_error("a given function depends on the dimension of the mesh, see compile_field()");
      default:
        return read_sampled_field(spec);
      }
    }
  } // namespace

  FieldFunction compile_field(const FieldSpec &spec, const std::vector<Parameter> &parameters, const unsigned dim)
  {
    if (spec.kind == FieldSpec::Kind::given)
      return {spec.given->in_dimension(dim), spec.where};
    return compile_field_sharing(spec.kind == FieldSpec::Kind::expression ? std::make_shared<CompiledParameters>(parameters, dim) : nullptr,
                                 spec);
  }

  FieldFunction compile_field_sharing(const std::shared_ptr<CompiledParameters> &parameters, const FieldSpec &spec)
  {
    return compile(spec, parameters);
  }
} // namespace unilateral
