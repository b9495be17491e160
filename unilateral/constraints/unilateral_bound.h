// What bounds u; `Function` is a FieldFunction, or the text of one in a case file.
#pragma once

#include "unilateral/base/diagnostics.h"
#include "unilateral/constraints/rule_name.h"
#include "unilateral/functions/field_function.h"
#include "unilateral/functions/surface_description.h"

#include <optional>
#include <string>
#include <vector>

namespace unilateral
{
  /// lower <= u <= upper in the domain, or on a boundary part; elasticity: u.n <= gap on a boundary part.
  template <typename Function>
  struct UnilateralBoundOf
  {
    std::optional<Function>           lower = {}, upper = {};
    std::optional<Function>           gap = {};        ///< elasticity: as a function of position,
    std::optional<SurfaceDescription> surface = {};    ///< or measured to a surface
    std::vector<double>               direction = {};  ///< elasticity: takes the place of n; none, or `dim` numbers
    std::string                       on = {};         ///< boundary part; empty: the domain
    std::optional<RuleName>           quadrature = {}; ///< I_G; none: the element's default rule
    SourceLocation                    where = {}, on_where = {}, quadrature_where = {};
  };

  using UnilateralBound = UnilateralBoundOf<FieldFunction>;
} // namespace unilateral
