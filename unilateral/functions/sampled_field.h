// Functions from files: rasters (GDAL) and profiles (CSV).
#pragma once

#include "unilateral/functions/field_function.h"
#include "unilateral/functions/field_spec.h"
#include "unilateral/functions/raster.h"

#include <functional>
#include <memory>
#include <optional>

namespace unilateral
{
  /// Is it neither a number nor an expression?
  inline bool is_sampled(const FieldSpec &spec)
  {
    return spec.kind != FieldSpec::Kind::constant && spec.kind != FieldSpec::Kind::expression;
  }

  /// Makes functions of what is_sampled(). Throws InputError.
  using SampleReader = std::function<FieldFunction(const FieldSpec &)>;

  /// @p scale times the samples of a raster plus @p offset; @p nodata where it has none, else an error there.
  std::shared_ptr<const FieldFunction::Source> raster_source(Raster raster, double scale, double offset, std::optional<double> nodata);

  /// Reads the file of a raster or profile. Throws InputError: file missing, not a raster, too few rows, or a solution, which takes another
  /// reader.
  FieldFunction read_sampled_field(const FieldSpec &spec);
} // namespace unilateral
