// Gmsh meshes what it has open.
#pragma once

#include "unilateral/mesh/mesh_description.h"
#include "unilateral/mesh/mesh_format.h"

namespace unilateral
{
  /// The script or drawing that Gmsh has open gets cells of @p order, see read_gmsh_file(). Throws InputError, and what Gmsh throws.
  void mesh_geometry(const MeshDescription &spec, MeshFormat format, bool simplex, unsigned order);
} // namespace unilateral
