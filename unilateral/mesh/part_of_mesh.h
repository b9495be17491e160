// A mesh that several processes make together, each some of it, and divide: one in a file, or a box.
#pragma once

#include "unilateral/base/processes.h"
#include "unilateral/mesh/mesh_description.h"
#include "unilateral/mesh/named_parts.h"
#include "unilateral/mesh/part_description.h"

#include <cstdint>
#include <optional>

namespace unilateral
{
  /// The part of this process of the mesh in spec.file, or of the box, with @p parts of the boundary: @p simplices or else quadrilaterals
  /// or hexahedra. A file has Gmsh's format 4.1 or 2.2 and cells of order 1, or of order 2 with all nodes of that. Each process reads some
  /// pieces of it, or counts off some cells and nodes of the box (ShareOfMesh); cells go to the parts by their centres (bisect_shared()),
  /// and what a part has to know of others is asked from processes that the numbers of vertices say: none has more than its share of cells
  /// and nodes, the first one an entry for each 20 000 nodes and elements of a file besides.
  ///
  /// The checks of mesh_of_cells(), on parts: cells of a part with each other, faces on cuts by the processes that their vertices say, and
  /// whether cells overlap by those with a face on the boundary, which processes send to each other where parts may touch.
  ///
  /// Nothing, on all processes: the file is of another kind or damaged, there are fewer than @p least_cells cells, or the mesh is one of
  /// which make_mesh() or name_parts() have something to say: mistakes, repeated cells, several pieces. Collective.
  template <int dim>
  std::optional<ReceivedPart<dim>> part_of_mesh(
    const MeshDescription &spec, bool simplices, const Processes &processes, std::uint64_t least_cells, const PartsByPlace &parts = {});
} // namespace unilateral
