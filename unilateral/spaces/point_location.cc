#include "unilateral/spaces/point_location.h"

#include "unilateral/mesh/congruent_cells.h"
#include "unilateral/mesh/reference_face.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <limits>

namespace unilateral
{
  using namespace dealii;

  template <int dim>
  Point<dim> unit_point(const FunctionSpace<dim> &space, const typename Triangulation<dim>::cell_iterator &cell, const Point<dim> &x)
  {
    if (dim == 1 || !space.element.simplex())
      return space.mapping->transform_real_to_unit_cell(cell, x);
    if (!is_multilinear(*space.mapping))
      return space.mesh.curved_cells->unit_point(cell, x);
    Tensor<2, dim> edges; // by columns
    for (unsigned k = 0; k < dim; ++k)
      for (unsigned d = 0; d < dim; ++d)
        edges[d][k] = cell->vertex(k + 1)[d] - cell->vertex(0)[d];
    return Point<dim>(invert(edges) * (x - cell->vertex(0)));
  }

  template <int dim>
  PlaceInMesh<dim> locate(const FunctionSpace<dim> &space, const Point<dim> &x)
  {
    PlaceInMesh<dim> best;
    best.outside = std::numeric_limits<double>::infinity();
    for (const auto &cell : space.dof_handler.active_cell_iterators())
    {
      if (cell->center().distance(x) > cell->diameter())
        continue;
      Point<dim> unit;
      try
      {
        unit = unit_point(space, cell, x);
      }
      catch (const typename Mapping<dim>::ExcTransformationFailed &)
      {
        continue;
      }
      if (const double outside = distance_outside(unit, space.element.simplex()); outside < best.outside)
        best = {cell, unit, outside};
      if (best.outside == 0)
        break;
    }
    return best;
  }

#define INSTANTIATE(dim)                                                                                                                   \
  template PlaceInMesh<dim> locate(const FunctionSpace<dim> &, const Point<dim> &);                                                        \
  template Point<dim>       unit_point(const FunctionSpace<dim> &, const Triangulation<dim>::cell_iterator &, const Point<dim> &);
  INSTANTIATE(1)
  INSTANTIATE(2)
  INSTANTIATE(3)
#undef INSTANTIATE
} // namespace unilateral
