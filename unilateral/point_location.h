// Which cell holds a point.
#pragma once

#include "unilateral/problem.h"

namespace unilateral
{
  template <int dim>
  struct PlaceInMesh
  {
    typename dealii::DoFHandler<dim>::active_cell_iterator cell;        ///< the nearest; none where `outside` is infinite
    dealii::Point<dim>                                     unit;        ///< the point in its reference coordinates
    double                                                 outside = 0; ///< how far it lies outside there: 0 inside
  };

  /// The cell that holds @p x, or the one that @p x misses by least: a point may lie a little outside a straight-sided mesh of a curved
  /// domain.
  template <int dim>
  PlaceInMesh<dim> locate(const Problem<dim> &problem, const dealii::Point<dim> &x);

  /// As many coordinates as the mesh has.
  template <int dim>
  dealii::Point<dim> to_point(const std::vector<double> &coordinates)
  {
    dealii::Point<dim> x;
    for (unsigned d = 0; d < dim; ++d)
      x[d] = coordinates[d];
    return x;
  }
} // namespace unilateral
