// What a region is made of, as it stands in [model] and [[material]].
#pragma once

#include "unilateral/case/case.h"
#include "unilateral/case/table_reader.h"

#include <string>

namespace unilateral
{
  /// The coefficients of the kind of @p request, whose dimension is known; keys of other kinds are refused with a word on where they
  /// belong. @p folder: where relative file names start.
  CoefficientSpecs read_coefficients(TableReader &table, const Case &request, const std::string &folder, Diagnostics &diagnostics);
} // namespace unilateral
