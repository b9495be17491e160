// The part of a mesh that one of several processes has.
#pragma once

#include "unilateral/base/processes.h"
#include "unilateral/mesh/mesh.h"

#include <deal.II/grid/tria.h>

#include <memory>
#include <vector>

namespace unilateral
{
  /// A non-overlapping decomposition of a mesh, all cells of one level, and the own part of it as a mesh of its own. Every process
  /// knows the whole mesh on that level; from there on each refines its part alone.
  template <int dim>
  struct Subdomain
  {
    Processes                          processes;
    unsigned                           level = 0;       ///< of refinement of `whole`
    Mesh<dim>                          whole;           ///< alive as long as the part: manifolds refer to it
    std::vector<unsigned>              own_cells;       ///< for each coarse cell of the part its number among the active cells of the whole
    std::vector<unsigned>              vertex;          ///< [coarse cell of the part][vertex]: its number in the whole
    std::vector<unsigned>              vertex_in_whole; ///< of each vertex of the coarse mesh of the part
    std::vector<std::vector<unsigned>> cells_at_vertex; ///< of the whole
    std::vector<unsigned>              owner;           ///< for each cell of the whole its process
  };

  /// Decides who gets which cells, and cuts out the own part. @p mesh becomes the part: faces that the cut has laid bare belong to a
  /// boundary part "" that it gets in addition. Curved cells keep their place in memory, so that a mapping may refer to them.
  template <int dim>
  std::unique_ptr<Subdomain<dim>> cut_out_subdomain(Mesh<dim> &mesh, unsigned level, const Processes &processes);

  /// For each point one of @p n_parts parts of nearly equal size, by recursive coordinate bisection.
  template <int dim>
  std::vector<unsigned> bisect(const std::vector<dealii::Point<dim>> &points, unsigned n_parts);
} // namespace unilateral
