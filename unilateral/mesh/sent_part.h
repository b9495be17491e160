// Parts of a mesh on their way from processes that have them to those that get them.
#pragma once

#include "unilateral/base/processes.h"
#include "unilateral/mesh/division.h"
#include "unilateral/mesh/mesh.h"
#include "unilateral/mesh/part_description.h"
#include "unilateral/mesh/subdomain.h"

#include <deal.II/base/point.h>

#include <cstdint>
#include <vector>

namespace unilateral
{
  /// Whether parts of @p mesh can be sent: its cells are straight or have their own nodes. Those that follow a manifold or a drawing can
  /// not, since their refinement needs it as a whole.
  template <int dim>
  bool can_be_sent(const Mesh<dim> &mesh);

  /// The cells of a mesh without hanging nodes, all on level 0 of the triangulation, as others are to get them: of a coarse mesh that one
  /// process has as a whole, or of a part, whose cells are divided anew with those of the other parts.
  template <int dim>
  class PartsToSend
  {
  public:
    /// Of the mesh as a whole.
    PartsToSend(const Mesh<dim> &whole, const Division &division);

    /// Of the part that @p subdomain is about, of whose cells each goes to its @p owner. @p first_cell: how many cells the processes with
    /// lower ranks have. @p neighbors: see find_neighbor_parts().
    PartsToSend(const Mesh<dim>      &part,
                const Subdomain<dim> &subdomain,
                std::uint64_t         first_cell,
                std::vector<unsigned> owner,
                const NeighborParts  &neighbors);

    /// The active cells that go to the process @p rank, in the order in which they are sent.
    const std::vector<unsigned> &cells_for(unsigned rank) const;

    /// These, and whose cells are around them. Empty where there are none.
    std::vector<char> bytes_for(unsigned rank) const;

  private:
    struct CellAround
    {
      std::uint32_t id;    ///< among all cells of the mesh
      std::uint32_t owner; ///< who gets it
    };
    void sort_by_owner();

    const Mesh<dim>                     &mesh;
    dealii::types::boundary_id           cut; ///< of faces on cuts of the parts that there are
    std::uint64_t                        first_cell = 0;
    std::vector<unsigned>                owner;
    std::vector<std::vector<unsigned>>   cells;        ///< [process]
    std::vector<std::uint32_t>           vertex_ids;   ///< empty: the number of the vertex
    std::vector<std::vector<CellAround>> cells_around; ///< [vertex], ascending
    dealii::Point<dim>                   some_point;
  };

  /// From the bytes of one process or several, in the order of their ranks; cells come in the order in which they were sent.
  template <int dim>
  ReceivedPart<dim> unpack_part(const std::vector<std::vector<char>> &messages, const Processes &processes);
} // namespace unilateral
