// The curvature that a list of cells has, for the mesh that was made of it.
#pragma once

#include "unilateral/mesh/cell_list.h"
#include "unilateral/mesh/mesh.h"

namespace unilateral
{
  /// Gives @p mesh the cells of order 2 of @p list, if these are not straight, and where there are any those of a drawing. Cells of order 2
  /// that are folded over themselves stay straight, with a warning. Throws InputError at @p where: straight cells that are folded.
  template <int dim>
  void curve_cells(Mesh<dim> &mesh, const CellList &list, const SourceLocation &where);
} // namespace unilateral
