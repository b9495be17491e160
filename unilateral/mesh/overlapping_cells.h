// Cells of a mesh file that lie over each other.
#pragma once

#include "unilateral/mesh/cell_table.h"

#include <deal.II/base/point.h>

#include <optional>
#include <utility>
#include <vector>

namespace unilateral
{
  /// Two cells that overlap, the one with the lower number first, or nothing. Every cell by itself is of positive volume, and no face has
  /// more than two cells. Segments need no faces.
  ///
  /// Cells that share a face must lie on either side of it: this finds a mesh that is folded, and is linear in the number of cells. The
  /// number of cells that cover a point then changes at the boundary alone: where cells overlap, one with a face on the boundary does.
  /// Those, n^(1/2) or n^(2/3) of n, are put in a tree of boxes, where each cell looks for one that it overlaps: one that no plane parts
  /// from it. For triangles and quadrilaterals the normals of their edges are tried, for tetrahedra those of their faces and the products
  /// of their edges, each cell cut by at least 1e-3 of its width (5 % where two cells share no vertex: pieces of a mesh whose common curve
  /// is meshed twice lie over each other by a sagitta). Hexahedra may have warped faces: of those with a common vertex only the sides of
  /// common faces are looked at. Segments may cover each other by 1e-3 of the shorter one. @p curved: the vertices are corners of curved
  /// cells, whose straight edges may cut into neighbours by the sagittas: only cells without a common vertex that cover each other by 30 %
  /// are meant then.
  template <int dim>
  std::optional<std::pair<unsigned, unsigned>> overlapping_cells(const std::vector<dealii::Point<dim>> &points,
                                                                 const CellTable                       &cells,
                                                                 const std::vector<FaceOfCells>        &faces,
                                                                 bool                                   curved = false);
} // namespace unilateral
