#include "unilateral/discretisation/point_location.h"

#include "unilateral/mesh/reference_face.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <limits>

namespace unilateral
{
  using namespace dealii;

  template <int dim>
  Point<dim> unit_point(const Problem<dim> &problem, const typename Triangulation<dim>::cell_iterator &cell, const Point<dim> &x)
  {
    if (dim == 1 || !problem.element.simplex())
      return problem.mapping->transform_real_to_unit_cell(cell, x);
    Tensor<2, dim> edges; // by columns
    for (unsigned k = 0; k < dim; ++k)
      for (unsigned d = 0; d < dim; ++d)
        edges[d][k] = cell->vertex(k + 1)[d] - cell->vertex(0)[d];
    return Point<dim>(invert(edges) * (x - cell->vertex(0)));
  }

  template <int dim>
  void check_probes(const Problem<dim> &problem)
  {
    Diagnostics diagnostics;
    const auto &output = problem.statement.output;
    for (std::size_t k = 0; k < output.probes.size(); ++k)
      if (problem.processes().min(locate(problem, to_point<dim>(output.probes[k])).outside) > outside_by_straight_sides)
        diagnostics.error(k < output.probes_where.size() ? output.probes_where[k] : problem.statement.mesh.where,
                          fmt::format("the probe ({:.6g}) lies in no cell of the mesh: there is no u; move it inside, or leave it out",
                                      fmt::join(output.probes[k], ", ")));
    diagnostics.throw_if_errors();
  }

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
        unit = unit_point(problem, cell, x);
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

#define INSTANTIATE(dim)                                                                                                                   \
  template PlaceInMesh<dim> locate(const Problem<dim> &, const Point<dim> &);                                                              \
  template void             check_probes(const Problem<dim> &);                                                                            \
  template Point<dim>       unit_point(const Problem<dim> &, const Triangulation<dim>::cell_iterator &, const Point<dim> &);
  INSTANTIATE(1)
  INSTANTIATE(2)
  INSTANTIATE(3)
#undef INSTANTIATE
} // namespace unilateral
