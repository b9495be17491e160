// How large a problem will become.
#pragma once

#include "unilateral/discretisation/problem.h"

namespace unilateral
{
  /// Unknowns after the refinements that the case asks for, without those by the error. Refinements of every cell: vertices, lines,
  /// quadrilaterals or triangles, and cells are counted, of which each makes so many of its own dimension and of those below. Local ones:
  /// about as many as they make of cells.
  template <int dim>
  double unknowns_on_finest(const Problem<dim> &problem);
} // namespace unilateral
