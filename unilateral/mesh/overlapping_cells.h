// Cells of a mesh file that lie over each other.
#pragma once

#include <deal.II/base/point.h>

#include <optional>
#include <utility>
#include <vector>

namespace unilateral
{
  /// Two cells that overlap, or nothing. @p cells are vertex numbers in deal.II's order, every cell by itself of positive volume.
  ///
  /// Cells that share a face must lie on either side of it: this finds a mesh that is folded, and is linear in the number of cells.
  /// Simplices around an inner vertex overlap then only if their angles add up to more than the full one. Other pairs are looked for by a
  /// tree of boxes, n log n, and overlap where no plane parts them: for triangles and quadrilaterals the normals of their edges are tried,
  /// for tetrahedra those of their faces and the products of their edges, each cell cut by at least 1e-3 of its width (5 % where two cells
  /// share no vertex: pieces of a mesh whose common curve is meshed twice lie over each other by a sagitta). Hexahedra may have warped
  /// faces: of those with a common vertex only the sides of common faces are looked at. Segments may cover each other by 1e-3 of the
  /// shorter one. @p curved: the vertices are corners of curved cells, whose straight edges may cut into neighbours by the sagittas: only
  /// cells without a common vertex that cover each other by 30 % are meant then.
  template <int dim>
  std::optional<std::pair<unsigned, unsigned>> overlapping_cells(const std::vector<dealii::Point<dim>>    &points,
                                                                 const std::vector<std::vector<unsigned>> &cells,
                                                                 bool                                      simplex,
                                                                 bool                                      curved = false);
} // namespace unilateral
