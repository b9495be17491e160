#include "unilateral/mesh/msh_index.h"

#include "unilateral/mesh/gmsh_order.h"

namespace unilateral
{
  unsigned MshIndex::corners_of_cell() const
  {
    return is_simplex(kind) ? dimension(kind) + 1 : 1u << dimension(kind);
  }

  unsigned MshIndex::corners_of_face() const
  {
    return is_simplex(kind) ? dimension(kind) : 1u << (dimension(kind) - 1);
  }

  unsigned MshIndex::nodes_of_cell() const
  {
    return corners_of_cell() + (order == 1 ? 0 : corners_around_middle_nodes(kind).size());
  }
} // namespace unilateral
