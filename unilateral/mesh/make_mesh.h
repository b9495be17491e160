// box, ball, shell, Gmsh file -> triangulation with named parts and regions.
#pragma once

#include "unilateral/mesh/mesh.h"
#include "unilateral/mesh/mesh_description.h"

namespace unilateral
{
  /// The coarse mesh, of simplices when @p simplex (box, ball, shell are cut; a file must already hold the right kind).
  /// Part names: box: left right bottom top front back (x-, x+, y-, y+, z-, z+); ball: surface; shell: inner outer;
  /// file: the physical names, "boundary" for unnamed faces. Region names: physical names, else "domain". In a STEP file the names of
  /// its surfaces and volumes, "surface7" for a face (in 2-D "curve7") without one.
  /// @p order: of the geometry that cells of a drawing or script get: 1, 2, or higher for a mesh that will be refined, whose finer cells of
  /// order 2 then follow polynomials of that order on the coarse ones, see DrawnCells; that of a .msh file is its own.
  /// A segment is both kinds of cell: in 1-D @p simplex changes nothing.
  /// Throws InputError: wrong cell kind for the element, mixed kinds, inverted cells, unreadable file.
  template <int dim>
  Mesh<dim> make_mesh(const MeshDescription &spec, bool simplex, unsigned order = 1);
} // namespace unilateral
