// What a case says of each region and each boundary part of a mesh.
#pragma once

#include "unilateral/case/case.h"
#include "unilateral/functions/field_function.h"

#include <string>
#include <vector>

namespace unilateral
{
  /// Index of @p name, or nothing.
  std::optional<unsigned> find_name(const std::vector<std::string> &names, const std::string &name);

  /// By material_id: what the region's [[material]] gives, the rest from [model]. Unknown regions are errors.
  std::vector<Coefficients>
  coefficients_by_region(const Case &request, const std::vector<std::string> &region_names, Diagnostics &diagnostics);

  /// What holds on a part of the boundary.
  struct PartCondition : BoundarySpec
  {
    bool named = false; ///< by a line of its own, not by `all`
  };

  /// By boundary_id. Unknown parts are errors.
  std::vector<PartCondition> conditions_by_part(const Case &request, const std::vector<std::string> &part_names, Diagnostics &diagnostics);

  /// The function, or zero.
  FieldFunction compile(const std::optional<FieldSpec> &spec, const Case &request);

  std::vector<FieldFunction> compile(const std::vector<FieldSpec> &specs, const Case &request);

  /// Those that depend on the place.
  std::vector<FieldFunction> not_constant(std::vector<FieldFunction> functions);
} // namespace unilateral
