// Gmsh files -> cells and names: .msh is read, .geo and .step are meshed on the way.
#pragma once

#include "unilateral/mesh/cell_list.h"
#include "unilateral/mesh/mesh_description.h"
#include "unilateral/mesh/mesh_outline.h"

namespace unilateral
{
  /// Dimension and names of the mesh or of the geometry in spec.file; of a .msh its cells, too, if file_access() wants them and several
  /// processes are not to read them in pieces. Throws
  /// InputError at spec.where when it is missing or not what it says.
  MeshOutline gmsh_outline(const MeshDescription &spec);

  /// Takes the cells of spec.read_ahead, if it has any. Else reads spec.file (.msh, versions 2.2 and 4.1, text or binary), or meshes it
  /// (.geo, .step, .stp): as the file itself asks when that gives triangles or tetrahedra for @p simplex, else quadrilaterals or hexahedra;
  /// otherwise anew with cells of about spec.size. Parts and regions are the physical groups by name, or by number when they have none. In
  /// .geo files that have physical groups for cells the cells of no group are left out, as Gmsh does when it saves. A .step file has no
  /// groups: its parts are the names of its faces, else "surface1", "surface2", ... (2-D: "curve1", ...) as Gmsh numbers them, its regions
  /// the names of its volumes, else "volume1", ... (2-D: "surface1", ...) when there are several of them. Lengths of a .step file come in
  /// millimetres whatever unit it was drawn in. Elements of order 2 keep their geometry, those of higher order are cut down to it. What is
  /// meshed here gets cells of @p order 1 or 2 (straight ones where Gmsh cannot curve them). With a higher order they have order 2, and
  /// `drawn_cells` has the curved ones of up to 100 000 cells at the higher order, too. Throws InputError at spec.where: missing file, not
  /// a mesh, no cells, several cell kinds, cells of the wrong kind, a 2-D mesh out of the plane z = constant, geometry that cannot be
  /// meshed.
  CellList read_gmsh_file(const MeshDescription &spec, bool simplex, unsigned order = 1);
} // namespace unilateral
