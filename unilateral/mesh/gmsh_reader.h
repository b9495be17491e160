// Gmsh itself: files -> cells and names. For a process of its own, which Gmsh may end, crash or fill; gmsh_file.h runs it in one.
#pragma once

#include "unilateral/mesh/cell_list.h"
#include "unilateral/mesh/mesh_description.h"
#include "unilateral/mesh/mesh_format.h"
#include "unilateral/mesh/mesh_outline.h"

#include <optional>
#include <utility>

namespace unilateral
{
  /// Switches Gmsh on, silent and without the user's settings. Once a process, which ends with it, and before the sandbox: libraries below
  /// Gmsh look for settings of their own.
  void start_gmsh();

  /// Dimension and names of spec.file, which is what @p format says. Throws InputError.
  MeshOutline outline_by_gmsh(const MeshDescription &spec, MeshFormat format);

  /// The same of a .msh file, and its cells of whatever kind, unless they make no mesh.
  std::pair<MeshOutline, std::optional<CellList>> outline_and_cells_by_gmsh(const MeshDescription &spec);

  /// The cells of spec.file, which is what @p format says; a script or drawing is meshed, see read_gmsh_file(). Throws InputError.
  CellList cells_by_gmsh(const MeshDescription &spec, MeshFormat format, bool simplex, unsigned order);
} // namespace unilateral
