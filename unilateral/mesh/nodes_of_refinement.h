// How many nodes the refinement of some quadrilaterals or hexahedra adds.
#pragma once

#include <deal.II/grid/tria.h>

#include <cstddef>
#include <vector>

namespace unilateral
{
  /// How many more nodes Lagrange elements of @p degree have, hanging ones included, when the @p chosen active cells have been refined and
  /// those that must be refined with them. @p triangulation is left as it was.
  template <int dim>
  std::size_t n_new_nodes(dealii::Triangulation<dim> &triangulation, const std::vector<bool> &chosen, unsigned degree);
} // namespace unilateral
