// Gaps that jump: steps of an obstacle, edges of expressions like if(x > 1, 0, 0.1).
#pragma once

#include "unilateral/constraints/constraint_set.h"
#include "unilateral/equilibration/straight_face.h"

#include <deal.II/base/point.h>
#include <deal.II/grid/tria.h>

#include <map>
#include <vector>

namespace unilateral
{
  /// Looks for jumps along equidistant_rows() of faces, and between the faces of one condition that have a vertex in common. What is
  /// narrower than the distance of the points is not seen.
  template <int dim>
  class JumpingGaps
  {
  public:
    /// Jumps of less than 1e-5 of @p size are none.
    JumpingGaps(bool simplex, double size) : simplex(simplex), size(size) {}

    using Cell = typename dealii::Triangulation<dim>::cell_iterator;

    /// On this face, or between it and one that was looked at before.
    bool jumps_on(const UnilateralCondition &condition, const Cell &cell, unsigned face, const StraightFace<dim> &geometry);

  private:
    struct AtVertex
    {
      const UnilateralCondition *condition;
      dealii::Tensor<1, dim>     normal;
      double                     gap, change; ///< at a point just inside the face, and by what the slope explains up to the vertex
    };

    bool                                      simplex;
    double                                    size;
    std::map<unsigned, std::vector<AtVertex>> at_vertices;
  };
} // namespace unilateral
