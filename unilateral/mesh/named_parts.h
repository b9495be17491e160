// Parts of the boundary by where they are.
#pragma once

#include "unilateral/mesh/mesh.h"
#include "unilateral/mesh/mesh_description.h"

#include <deal.II/base/point.h>

#include <vector>

namespace unilateral
{
  using PartsByPlace = std::vector<PartByPlace<FieldFunction>>;

  struct PlaceOfFace
  {
    bool belongs = false; ///< the function is not zero at the centre of the face
    bool cut = false;     ///< not all of the face is on the same side as its centre: not all points next to its corners are
  };

  template <int dim>
  PlaceOfFace place_of_face(const std::vector<dealii::Point<dim>> &corners, const FieldFunction &where);

  /// The faces of the coarse mesh that have their centre where PartByPlace::where is not zero become that part, whatever they were before:
  /// a later entry takes from those before it. A name that the mesh has already gets more faces. Faces that come from refinement belong
  /// where their parent does. An entry without a face is an error; that one ends inside faces, which then follow their centre, a warning.
  template <int dim>
  void name_parts(Mesh<dim> &mesh, const PartsByPlace &parts, Diagnostics &diagnostics);
} // namespace unilateral
