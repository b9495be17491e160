// Expressions in x, y, z and the [parameters]: checked with our own words, evaluated by muParser.
#pragma once

#include "unilateral/base/diagnostics.h"
#include "unilateral/functions/field_spec.h"

#include <memory>
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
    bool   is_constant() const; ///< uses none of x, y, z, directly or through parameters

    /// "r = 0, s = nan": the parameters at the last point of evaluation, to explain a value that is not finite; empty without parameters.
    std::string parameter_values() const;

  private:
    struct Program;
    std::unique_ptr<Program> program;
  };

  /// Checks one text: names, arguments, parentheses, operators. Adds errors at their places in the file.
  /// Parameters count as known names; what is wrong inside them is check_parameters' concern.
  /// Returns the names of the parameters and coordinates that occur.
  std::vector<std::string>
  check_expression(const FieldSpec &spec, const std::vector<Parameter> &parameters, unsigned dim, Diagnostics &diagnostics);

  /// Checks all parameters: names that hide a coordinate, constant or function, their texts, and cycles among them.
  void check_parameters(const std::vector<Parameter> &parameters, unsigned dim, Diagnostics &diagnostics);

  /// The functions an expression may call.
  std::vector<std::string> function_names();
} // namespace unilateral
