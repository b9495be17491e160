// From the text of an expression to instructions; what is wrong with it is said in words.
#pragma once

#include "unilateral/base/diagnostics.h"
#include "unilateral/functions/expression_code.h"
#include "unilateral/functions/field_spec.h"

#include <string>
#include <vector>

namespace unilateral
{
  struct ParsedExpression
  {
    ExpressionCode           code; ///< variables: 0 to 2 are x, y, z; 3 + j is parameter j of P, 3 + P + k quantity k
    std::vector<std::string> used; ///< the parameters, coordinates and quantities that occur
  };

  /// Parses @p spec.text, in which the first @p dim of x, y, z and the names of @p parameters are known, and those of @p quantities, whose
  /// values come with the points. Adds errors at their places in the file; the code is of use only when there are none. What is wrong
  /// inside parameters is no concern of this function.
  ParsedExpression parse_expression(const FieldSpec                &spec,
                                    const std::vector<Parameter>   &parameters,
                                    unsigned                        dim,
                                    Diagnostics                    &diagnostics,
                                    const std::vector<std::string> &quantities = {});

  /// The functions an expression may call.
  std::vector<std::string> function_names();
} // namespace unilateral
