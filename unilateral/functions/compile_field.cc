#include "unilateral/functions/compile_field.h"

#include "unilateral/functions/expression.h"
#include "unilateral/functions/profile.h"
#include "unilateral/functions/raster.h"

#include <fmt/format.h>

#include <cmath>
#include <filesystem>
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
      std::string explanation() const override
      {
        const std::string parameters = expression->parameter_values();
        return fmt::format("the expression '{}'{}", text, parameters.empty() ? "" : " with " + parameters);
      }

    private:
      const std::string                 text;
      const std::unique_ptr<Expression> expression;
    };

    class RasterSource : public FieldFunction::Source
    {
    public:
      RasterSource(Raster raster, const double scale, const double offset, const std::optional<double> nodata)
        : raster(std::move(raster)), scale(scale), offset(offset), nodata(nodata)
      {
      }
      double value(const double x, const double y, double) const override
      {
        if (const auto sample = raster.sample(x, y))
          return scale * *sample + offset;
        if (nodata)
          return *nodata;
        throw std::domain_error("the raster has no data there; give nodata = the value to take");
      }
      double      sample_spacing() const override { return raster.pixel_size(); }
      std::string explanation() const override { return "scale * raster + offset"; }

    private:
      const Raster                raster;
      const double                scale, offset;
      const std::optional<double> nodata;
    };

    class ProfileSource : public FieldFunction::Source
    {
    public:
      explicit ProfileSource(const FieldSpec &spec) : profile(spec.file), scale(spec.scale), offset(spec.offset) {}
      double      value(const double x, double, double) const override { return scale * profile.sample(x) + offset; }
      double      sample_spacing() const override { return profile.spacing(); }
      std::string explanation() const override { return "scale * profile + offset"; }

    private:
      const Profile profile;
      const double  scale, offset;
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
      case FieldSpec::Kind::raster:
        return {raster_source(Raster(spec.file, spec.extent), spec.scale, spec.offset, spec.nodata), spec.where};
      case FieldSpec::Kind::profile:
        return {std::make_shared<ProfileSource>(spec), spec.where};
      case FieldSpec::Kind::given:
        break;
      }
      throw std::logic_error("a given function depends on the dimension of the mesh, see compile_field()");
    }
  } // namespace

  std::shared_ptr<const FieldFunction::Source>
  raster_source(Raster raster, const double scale, const double offset, const std::optional<double> nodata)
  {
    return std::make_shared<RasterSource>(std::move(raster), scale, offset, nodata);
  }

  FieldFunction compile_field(const FieldSpec &spec, const std::vector<Parameter> &parameters, const unsigned dim)
  {
    if (spec.kind == FieldSpec::Kind::given)
      return {spec.given->in_dimension(dim), spec.where};
    return compile_field_sharing(spec.kind == FieldSpec::Kind::expression ? std::make_shared<CompiledParameters>(parameters, dim) : nullptr,
                                 spec);
  }

  FieldFunction compile_field_sharing(const std::shared_ptr<CompiledParameters> &parameters, const FieldSpec &spec)
  {
    try
    {
      return compile(spec, parameters);
    }
    catch (const std::runtime_error &e)
    {
      std::error_code missing;
      throw InputError(spec.where, e.what(),
                       std::filesystem::is_regular_file(spec.file, missing) ? MessageName("file-damaged") : MessageName("file-not-found"));
    }
  }
} // namespace unilateral
