// Whether the cells of a mesh that several processes have fit together where they do not share faces.
#pragma once

#include "unilateral/base/processes.h"
#include "unilateral/mesh/cell_table.h"
#include "unilateral/mesh/faces_between_parts.h"

#include <deal.II/base/point.h>

#include <cstdint>
#include <vector>

namespace unilateral
{
  /// No two cells of any parts overlap (overlapping_cells()), and no vertex of the boundary hangs (hanging_node()). @p points, and their
  /// numbers @p ids in the whole mesh, ascending, of the @p cells of this process; @p faces of these, and of those
  /// that have one own cell @p kinds, in their order. Cells with a face on the boundary go to all processes whose cells they may touch by
  /// the boxes around them. The same answer for all. Collective.
  template <int dim>
  bool fits_at_boundary(const std::vector<dealii::Point<dim>>      &points,
                        const std::vector<std::uint64_t>           &ids,
                        const CellTable                            &cells,
                        const std::vector<FaceOfCells>             &faces,
                        const std::vector<FacesBetweenParts::Face> &kinds,
                        bool                                        curved,
                        const Processes                            &processes);
} // namespace unilateral
