// What a mesh file can be.
#pragma once

namespace unilateral
{
  enum class MeshFormat
  {
    msh, ///< Gmsh's mesh files
    geo, ///< Gmsh's scripts
    step ///< drawings
  };
} // namespace unilateral
