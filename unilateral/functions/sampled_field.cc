#include "unilateral/functions/sampled_field.h"

#include "unilateral/functions/profile.h"

#include <filesystem>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>

namespace unilateral
{
  namespace
  {
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
  } // namespace

  std::shared_ptr<const FieldFunction::Source>
  raster_source(Raster raster, const double scale, const double offset, const std::optional<double> nodata)
  {
    return std::make_shared<RasterSource>(std::move(raster), scale, offset, nodata);
  }

  FieldFunction read_sampled_field(const FieldSpec &spec)
  {
    try
    {
      if (spec.kind == FieldSpec::Kind::raster)
        return {raster_source(Raster(spec.file, spec.extent), spec.scale, spec.offset, spec.nodata), spec.where};
      if (spec.kind == FieldSpec::Kind::profile)
        return {std::make_shared<ProfileSource>(spec), spec.where};
    }
    catch (const std::runtime_error &e)
    {
      std::error_code missing;
      throw InputError(spec.where, e.what(),
                       std::filesystem::is_regular_file(spec.file, missing) ? MessageName("file-damaged") : MessageName("file-not-found"));
    }
    throw InputError(spec.where, "a solution has no meaning here; write a number or an expression", MessageName("kind-does-not-fit"));
  }
} // namespace unilateral
