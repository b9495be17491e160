// Where the solution is inside an obstacle that no point of the rule I_G is near enough to notice.
#pragma once

#include "unilateral/algebra/vector.h"
#include "unilateral/constraints/constraint_set.h"
#include "unilateral/discretisation/problem.h"

#include <cstddef>
#include <vector>

namespace unilateral
{
  struct UnseenContact
  {
    std::size_t      condition = 0; ///< its number in Problem::conditions
    double           depth = 0;     ///< of the obstacle in the body (of a scalar u: by how much the bound is passed); unit of length
    std::size_t      cell = 0;      ///< active cell index
    dealii::Point<3> x;             ///< coordinates beyond dim are zero
  };

  /// The conditions on boundary parts are imposed at the points of I_G. Here they are checked at others: the vertices, the middles of the
  /// edges and points inside of each face (simplices), a Lobatto lattice with twice as many points a direction (other cells). Between
  /// points in contact u passes a curved bound by O(h^2), which is part of the mesh's error; what is returned is where no point within a
  /// cell's diameter is in contact: one entry for each face where the depth is more than 1e-6 of its cell's diameter. Points whose values
  /// are prescribed do not count. The smallest feature that is seen is as large as the distance of these points.
  template <int dim>
  std::vector<UnseenContact>
  unseen_contact(const Problem<dim> &problem, const ConstraintSet<dim> &set, const Vector &u, const Vector &lambda);
} // namespace unilateral
