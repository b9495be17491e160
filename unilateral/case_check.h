// What is wrong with a case although each of its values can be read.
#pragma once

#include "unilateral/case.h"

#include <string>
#include <vector>

namespace unilateral
{
  /// Names of the boundary of box, ball and shell, element against mesh and kind, quadrature names, signs of constants, bounds that cross.
  void check_case(const Case &request, Diagnostics &diagnostics);

  std::vector<std::string>        kind_names();                           ///< membrane, ...
  std::string                     element_names_text(unsigned dimension); ///< "Q1 .. Q8, P1 .. P3"
  const std::vector<std::string> &result_blocks();                        ///< first keys of results.json that an [[expect]] may name

  /// The parts of the boundary; empty for a mesh file, whose names are not known before it is read.
  std::vector<std::string> part_names(const MeshSpec &mesh, unsigned dimension);
} // namespace unilateral
