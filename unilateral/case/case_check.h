// What is wrong with a case although each of its values can be read.
#pragma once

#include "unilateral/case/case.h"
#include "unilateral/case/table_reader.h"

#include <string>

namespace unilateral
{
  /// Names of parts and regions, element against mesh and kind, quadrature against element, signs of constants, bounds that cross or
  /// that boundary values leave nothing to do.
  void check_case(const Case &request, Diagnostics &diagnostics);

  Choice      kind_names();                            ///< membrane, ...
  Choice      solver_names();                          ///< auto, direct, ...
  std::string element_names_text(const Case &request); ///< of its kind: "Q1 to Q8, P1 to P3"
} // namespace unilateral
