// What has to be known beyond the cuts of a mesh whose parts are divided again.
#pragma once

#include "unilateral/base/shared_unknowns.h"
#include "unilateral/mesh/subdomain.h"

#include <deal.II/dofs/dof_handler.h>

namespace unilateral
{
  /// Of all parts of a mesh that are about to be divided once more: numbers of vertices that all processes agree on, and the cells of
  /// other parts at the own vertices, with the processes that will have them. @p linear: linear functions on the own part, refined
  /// everywhere, and their unknowns that are @p shared. @p owner: of each active cell of the part, among the processes after the division.
  /// Collective.
  template <int dim>
  NeighborParts
  find_neighbor_parts(const dealii::DoFHandler<dim> &linear, const SharedUnknowns &shared, const std::vector<unsigned> &owner);
} // namespace unilateral
