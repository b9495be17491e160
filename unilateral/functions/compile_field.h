// Text -> function: expressions, rasters (GDAL), profiles (CSV).
#pragma once

#include "unilateral/functions/expression.h"
#include "unilateral/functions/field_function.h"
#include "unilateral/functions/field_spec.h"

#include <memory>
#include <vector>

namespace unilateral
{
  /// Reads the file or compiles the expression, in which the first @p dim of x, y, z are known.
  /// Throws InputError at the true position of the fault: unknown name, syntax, file missing, not a raster, too few rows.
  FieldFunction compile_field(const FieldSpec &spec, const std::vector<Parameter> &parameters, unsigned dim = 3);

  /// The same for one of many functions with the same parameters.
  FieldFunction compile_field_sharing(const std::shared_ptr<CompiledParameters> &parameters, const FieldSpec &spec);
} // namespace unilateral
