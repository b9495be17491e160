// The unknowns around the free boundary, from the matrix or from the cells.
#pragma once

#include "unilateral/constraints/constraint_trace.h"
#include "unilateral/inequality/local_rows.h"
#include "unilateral/multigrid/level_hierarchy.h"

#include <vector>

namespace unilateral
{
  /// The unknowns of the cells where points in contact (@p active) meet others, and of cells around, four nodes at least in each
  /// direction; none that Dirichlet data fix or that other processes share. Costs three passes over the cells and one over the points.
  LocalRows rows_near_free_boundary(const LevelHierarchy &hierarchy, const ConstraintTrace &B, const std::vector<bool> &active);

  /// The same for unknowns that @p A connects: those next to the free boundary and four further layers. Matrix: SymmetricBlockMatrix or
  /// dealii::SparseMatrix<double>. With @p shared A is what the cells of this process contribute, and layers end at cuts. @p incomplete:
  /// unknowns of which @p A does not have the whole row, they are left out.
  template <typename Matrix>
  LocalRows rows_near_free_boundary(const Matrix                     &A,
                                    const ConstraintTrace            &B,
                                    const std::vector<bool>          &active,
                                    const SharedUnknowns             &shared = SharedUnknowns(),
                                    const std::vector<std::uint32_t> &incomplete = {});
} // namespace unilateral
