#include "unilateral/point_location.h"

#include "unilateral/reference_face.h"

#include <limits>

namespace unilateral
{
  using namespace dealii;

  template <int dim>
  PlaceInMesh<dim> locate(const Problem<dim> &problem, const Point<dim> &x)
  {
    PlaceInMesh<dim> best;
    best.outside = std::numeric_limits<double>::infinity();
    for (const auto &cell : problem.dof_handler.active_cell_iterators())
    {
      if (cell->center().distance(x) > cell->diameter())
        continue;
      Point<dim> unit;
      try
      {
        unit = problem.mapping->transform_real_to_unit_cell(cell, x);
      }
      catch (const typename Mapping<dim>::ExcTransformationFailed &)
      {
        continue;
      }
      if (const double outside = distance_outside(unit, problem.element.simplex()); outside < best.outside)
        best = {cell, unit, outside};
      if (best.outside == 0)
        break;
    }
    return best;
  }

  template PlaceInMesh<1> locate(const Problem<1> &, const Point<1> &);
  template PlaceInMesh<2> locate(const Problem<2> &, const Point<2> &);
  template PlaceInMesh<3> locate(const Problem<3> &, const Point<3> &);
} // namespace unilateral
