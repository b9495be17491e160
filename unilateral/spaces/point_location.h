// Which cell holds a point.
#pragma once

#include "unilateral/spaces/function_space.h"

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
  PlaceInMesh<dim> locate(const FunctionSpace<dim> &space, const dealii::Point<dim> &x);

  /// The reference coordinates of @p x in @p cell, which need not hold it. Of triangles and tetrahedra, whose sides are straight, by
  /// solving for them: deal.II's iteration asks for a residual of 1e-12 in units of length, which coordinates of 1e5 do not have. Throws
  /// Mapping::ExcTransformationFailed.
  template <int dim>
  dealii::Point<dim>
  unit_point(const FunctionSpace<dim> &space, const typename dealii::Triangulation<dim>::cell_iterator &cell, const dealii::Point<dim> &x);

  /// A point up to so far outside of a cell, in its reference coordinates, belongs to it still.
  constexpr double outside_by_straight_sides = 0.05;

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
