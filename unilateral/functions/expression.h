// Expressions in x, y, z and the [parameters].
#pragma once

#include "unilateral/base/diagnostics.h"
#include "unilateral/functions/expression_parser.h"
#include "unilateral/functions/field_spec.h"

#include <array>
#include <memory>
#include <span>
#include <string>
#include <vector>

namespace unilateral
{
  /// A compiled expression together with the parameters that it uses. Not copyable, not thread-safe.
  class Expression
  {
  public:
    /// Compiles @p spec.text, in which the first @p dim of x, y, z are known.
    /// Throws InputError with everything that is wrong with it and with the parameters that it uses, each at its place.
    Expression(const FieldSpec &spec, const std::vector<Parameter> &parameters, unsigned dim = 3);
    ~Expression();

    double value(double x, double y, double z) const;

    /// The values at @p points, and unless @p gradients is empty the derivatives by x, y, z there: exact up to rounding, not finite or that
    /// of one side where there is none. The spans are of the same size.
    void
    values(std::span<const std::array<double, 3>> points, std::span<double> values, std::span<std::array<double, 3>> gradients = {}) const;

    bool is_constant() const; ///< uses none of x, y, z, directly or through parameters

    /// "r = 0, s = nan": the parameters at the last point of evaluation, to explain a value that is not finite; empty without parameters.
    std::string parameter_values() const;

  private:
    struct Program;
    std::unique_ptr<Program> program;
  };

  /// Checks all parameters: names that hide a coordinate, constant or function, their texts, and cycles among them.
  void check_parameters(const std::vector<Parameter> &parameters, unsigned dim, Diagnostics &diagnostics);
} // namespace unilateral
