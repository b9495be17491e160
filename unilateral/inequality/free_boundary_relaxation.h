// Nonlinear Gauss-Seidel steps around the free boundary.
#pragma once

#include "unilateral/inequality/augmented_problem.h"

namespace unilateral
{
  /// Lowers the energy of @p augmented by symmetric Gauss-Seidel steps on the unknowns around the predicted free boundary alone, where
  /// what a coarser mesh says of u and of the contact is the least accurate; @p active becomes the contact that is found there. All
  /// unknowns at a node move together, to the minimum of the energy with the others held. The rest of u stays as it is, so that the work
  /// is that of the free boundary, not of the mesh (A. Brandt, C. W. Cryer, SIAM J. Sci. Stat. Comput. 4 (1983), relax near singularities
  /// more than elsewhere). For symmetric a; nothing happens where DiscreteProblem::rows_near_free_boundary() has no rows. Where several
  /// processes share the problem all take part: unknowns on the cuts between them move together, damped.
  void relax_near_free_boundary(const AugmentedProblem &augmented, std::vector<bool> &active, Vector &u);
} // namespace unilateral
