#include "unilateral/mesh/gmsh_order.h"

#include <array>

namespace unilateral
{
  unsigned corner_of_gmsh(const CellKind kind, const unsigned corner)
  {
    static const std::array<unsigned, 8> order = {0, 1, 3, 2, 4, 5, 7, 6};
    return kind == CellKind::quadrilateral || kind == CellKind::hexahedron ? order[corner] : corner;
  }

  const std::vector<std::vector<unsigned>> &corners_around_middle_nodes(const CellKind kind)
  {
    using Corners = std::vector<std::vector<unsigned>>;
    static const Corners segment = {{0, 1}}, triangle = {{0, 1}, {1, 2}, {2, 0}},
                         tetrahedron = {{0, 1}, {1, 2}, {2, 0}, {3, 0}, {2, 3}, {1, 3}},
                         quadrilateral = {{0, 1}, {1, 2}, {2, 3}, {3, 0}, {0, 1, 2, 3}},
                         hexahedron = {{0, 1},
                                       {0, 3},
                                       {0, 4},
                                       {1, 2},
                                       {1, 5},
                                       {2, 3},
                                       {2, 6},
                                       {3, 7},
                                       {4, 5},
                                       {4, 7},
                                       {5, 6},
                                       {6, 7},
                                       {0, 1, 2, 3},
                                       {0, 1, 4, 5},
                                       {0, 3, 4, 7},
                                       {1, 2, 5, 6},
                                       {2, 3, 6, 7},
                                       {4, 5, 6, 7},
                                       {0, 1, 2, 3, 4, 5, 6, 7}};
    switch (kind)
    {
    case CellKind::segment:
      return segment;
    case CellKind::triangle:
      return triangle;
    case CellKind::quadrilateral:
      return quadrilateral;
    case CellKind::tetrahedron:
      return tetrahedron;
    case CellKind::hexahedron:
      break;
    }
    return hexahedron;
  }
} // namespace unilateral
