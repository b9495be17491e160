// Cells, vertices and names as a file holds them -> triangulation.
#pragma once

#include "unilateral/mesh/cell_list.h"
#include "unilateral/mesh/mesh.h"

namespace unilateral
{
  /// The triangulation of @p list: cells turned to positive volume; faces of the boundary without a name become the part "boundary"; names
  /// on faces inside the domain are left out, and so are parts that have no other faces (with a warning).
  /// Throws InputError at @p where: cells of another dimension, without volume or folded over themselves, be it by their curvature, faces
  /// shared by more than two cells, hanging nodes, cells that overlap.
  template <int dim>
  Mesh<dim> mesh_of_cells(const CellList &list, const SourceLocation &where);
} // namespace unilateral
