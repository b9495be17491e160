// A function by its values at the nodes of a mesh that is given by arrays.
#pragma once

#include "unilateral/functions/field_function.h"

#include <array>
#include <memory>
#include <vector>

namespace unilateral
{
  /// Linear cells: segments, triangles, quadrilaterals, tetrahedra or hexahedra, by the dimension and the number of corners of each;
  /// corners of quadrilaterals and hexahedra in lexicographic order, as deal.II has them.
  struct NodalMesh
  {
    unsigned                           dim = 2;
    std::vector<std::array<double, 3>> points;
    std::vector<std::vector<unsigned>> cells;
  };

  /// sum_k values[k] phi_k, phi_k the linear (multilinear) function of node k. Its gradient is that of the cell. A point that lies outside
  /// of the mesh by no more than 1e-6 of a cell belongs to it; farther away there is no value. Throws std::runtime_error where the number
  /// of values is not that of the points.
  std::shared_ptr<const FieldFunction::Source> nodal_function(std::shared_ptr<const NodalMesh> mesh, std::vector<double> values);
} // namespace unilateral
