// Meshes in several pieces.
#pragma once

#include "unilateral/discretisation/problem.h"

namespace unilateral
{
  /// Throws an InputError where the mesh falls into pieces that no node, platen or periodic condition connects, and [boundary], springs and
  /// contact leave a motion of one of them free; warns where contact alone could hold it: rigid body modes are found, and their equilibrium
  /// is looked at, for the mesh as a whole. Without subdomains.
  template <int dim>
  void check_loose_pieces(const Problem<dim> &problem, Diagnostics &diagnostics);
} // namespace unilateral
