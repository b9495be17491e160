// box, ball, shell, Gmsh file -> triangulation with named parts and regions.
#pragma once

#include "unilateral/case/case.h"

#include <deal.II/grid/tria.h>

#include <memory>
#include <string>
#include <vector>

namespace unilateral
{
  /// A coarse mesh, not yet refined, with the names its file or shape gives.
  template <int dim>
  struct Mesh
  {
    /// Its manifolds may refer to it (ball): a copy made by copy_triangulation() must not outlive it.
    std::unique_ptr<dealii::Triangulation<dim>> triangulation;
    std::vector<std::string>                    part_names;     ///< index: boundary_id of the faces
    std::vector<std::string>                    region_names;   ///< index: material_id of the cells
    bool                                        curved = false; ///< geometry of order > 1 is worth its price (ball, shell)
    bool                                        simplex = false;
    std::vector<std::string>                    warnings; ///< what was left out of a file, a sentence each
  };

  /// What can be said of a mesh before it is built.
  struct MeshOutline
  {
    unsigned dimension = 0;
    /// Every name that a part or a region can have. Of a file: its own names, and "boundary" and "domain", which what has no name is
    /// called if there is any.
    std::vector<std::string> part_names, region_names;
  };

  /// Outline of the mesh that @p spec describes (reads the file if need be).
  /// Throws InputError when the file is missing or is not a mesh.
  MeshOutline mesh_outline(const MeshSpec &spec);

  /// The coarse mesh, of simplices when @p simplex (box, ball, shell are cut; a file must already hold the right kind).
  /// Part names: box: left right bottom top front back (x-, x+, y-, y+, z-, z+); ball: surface; shell: inner outer;
  /// file: the physical names, "boundary" for unnamed faces. Region names: physical names, else "domain". In a STEP file the names of
  /// its surfaces and volumes, "surface7" for a face (in 2-D "curve7") without one.
  /// A segment is both kinds of cell: in 1-D @p simplex changes nothing.
  /// Throws InputError: wrong cell kind for the element, mixed kinds, inverted cells, unreadable file.
  template <int dim>
  Mesh<dim> make_mesh(const MeshSpec &spec, bool simplex);
} // namespace unilateral
