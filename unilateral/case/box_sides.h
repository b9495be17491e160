// The sides of a box by their direction.
#pragma once

#include "unilateral/case/case.h"

namespace unilateral
{
  /// In a case on a box, "x-", "x+", "y-", "y+", "z-", "z+" become the names that the mesh has: left, right, bottom, top, front, back.
  /// Names that a [[part]] defines stay. Reports a side that has a boundary condition under both of its names.
  void use_names_of_mesh(Case &request, Diagnostics &diagnostics);
} // namespace unilateral
