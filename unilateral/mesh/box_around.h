// The box around a mesh.
#pragma once

#include "unilateral/base/processes.h"

#include <deal.II/base/bounding_box.h>
#include <deal.II/grid/tria.h>

#include <utility>

namespace unilateral
{
  /// Lower and upper corner of the box around the vertices, those of the parts of all @p processes. Collective.
  template <int dim>
  std::pair<dealii::Point<dim>, dealii::Point<dim>> box_around(const dealii::Triangulation<dim> &mesh, const Processes &processes)
  {
    auto corners = dealii::BoundingBox<dim>(mesh.get_vertices()).get_boundary_points();
    for (unsigned d = 0; d < dim; ++d)
    {
      corners.first[d] = processes.min(corners.first[d]);
      corners.second[d] = processes.max(corners.second[d]);
    }
    return corners;
  }
} // namespace unilateral
