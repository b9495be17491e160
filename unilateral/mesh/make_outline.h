// box, ball, shell, Gmsh file -> dimension and names, before there is a triangulation.
#pragma once

#include "unilateral/mesh/mesh_description.h"
#include "unilateral/mesh/mesh_outline.h"

#include <string>
#include <vector>

namespace unilateral
{
  /// Outline of the mesh that @p spec describes (reads the file if need be).
  /// Throws InputError when the file is missing or is not a mesh.
  MeshOutline mesh_outline(const MeshDescription &spec);

  /// left right bottom top front back, as many as there are sides in @p dim dimensions.
  std::vector<std::string> box_part_names(unsigned dim);
} // namespace unilateral
