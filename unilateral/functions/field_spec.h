// A function of position as text: a number, an expression, a raster file, a profile file, a solution.
#pragma once

#include "unilateral/base/diagnostics.h"
#include "unilateral/functions/given_function.h"

#include <array>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace unilateral
{
  /// A scalar function of position as the user wrote it; compile_field.h makes a FieldFunction of it.
  struct FieldSpec
  {
    enum class Kind
    {
      constant,   ///< `value`
      expression, ///< `text`, in x y z and the [parameters]
      raster,     ///< GDAL raster `file`, bilinear between pixel centres (2-D, 3-D: function of x, y)
      profile,    ///< CSV `file` of two columns x, value; linear between rows (1-D: function of x)
      given,      ///< `given`, by the program that states the case
      run,        ///< `quantity` of the solution that another run has written to the folder `file`
      previous    ///< `quantity` of the solution of the step before, `initial` in the first step
    };
    Kind        kind = Kind::constant;
    double      value = 0;
    std::string text;

    std::string                                         file;      ///< path, relative to the case file until it is read, then absolute
    std::string                                         quantity;  ///< of run and previous: u, ux, ...
    std::shared_ptr<const FieldSpec>                    initial;   ///< of previous; none: 0
    double                                              scale = 1; ///< function = scale * sample + offset
    double                                              offset = 0;
    std::optional<std::array<std::array<double, 2>, 2>> extent; ///< [[x0,y0],[x1,y1]]: place the raster here; default: its own geotransform
    std::optional<double> nodata; ///< value of the function where the raster has no data; default: an error there

    std::shared_ptr<const GivenFunction> given;
    std::size_t                          given_number = 0; ///< its place in GivenData::functions

    SourceLocation where; ///< of the value in the case file (for an expression: of its first character inside the quotes)
    /// Line and column of each byte of `text` where escapes make them differ from those counted from `where`; else empty.
    std::vector<std::pair<unsigned, unsigned>> places;

    static FieldSpec constant(double value);
    static FieldSpec expression(std::string text);
  };

  /// [parameters]: a number, or an expression in x y z and other parameters.
  struct Parameter
  {
    std::string    name;
    FieldSpec      value;
    SourceLocation where; ///< of the name
  };
} // namespace unilateral
