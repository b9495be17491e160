// The part of a mesh that one of several processes has.
#pragma once

#include "unilateral/base/processes.h"
#include "unilateral/base/shared_unknowns.h"
#include "unilateral/mesh/mesh.h"

#include <deal.II/dofs/dof_handler.h>
#include <deal.II/grid/tria.h>

#include <array>
#include <map>
#include <memory>
#include <set>
#include <vector>

namespace unilateral
{
  /// A non-overlapping decomposition of a mesh of hypercubes, all of one level, and the own part of it as a mesh of its own. Every process
  /// knows the whole mesh on that level; from there on each refines its part alone.
  template <int dim>
  struct Subdomain
  {
    Processes                          processes;
    unsigned                           level = 0;       ///< of refinement of `whole`
    Mesh<dim>                          whole;           ///< alive as long as the part: manifolds refer to it
    std::vector<unsigned>              own_cells;       ///< for each coarse cell of the part its number among the active cells of the whole
    std::vector<unsigned>              vertex;          ///< [coarse cell of the part][vertex]: its number in the whole
    std::vector<std::vector<unsigned>> cells_at_vertex; ///< of the whole
    std::vector<unsigned>              owner;           ///< for each cell of the whole its process
  };

  /// Decides who gets which cells, by bisection of the mesh at right angles to its longest side, and cuts out the own part. @p mesh
  /// becomes the part: faces that the cut has laid bare belong to a boundary part "" that it gets in addition.
  template <int dim>
  std::unique_ptr<Subdomain<dim>> cut_out_subdomain(Mesh<dim> &mesh, unsigned level, const Processes &processes);

  /// What others have too of the unknowns of a space of Lagrange elements on the part, refined uniformly. They are recognised without a
  /// message: a node on an edge or face of the mesh that was cut is a combination of the vertices of that edge or face with whole numbers
  /// for weights, and who has cells there is known to all.
  template <int dim>
  SharedUnknowns unknowns_on_cuts(const Subdomain<dim> &subdomain, const dealii::DoFHandler<dim> &dof_handler);

  /// All unknowns of nodes that are named by their first one.
  template <int dim>
  std::map<dealii::types::global_dof_index, std::array<dealii::types::global_dof_index, dim>>
  unknowns_of_nodes(const dealii::DoFHandler<dim> &dof_handler, const std::set<dealii::types::global_dof_index> &first);

  /// For each point one of @p n_parts parts of nearly equal size, by recursive coordinate bisection.
  template <int dim>
  std::vector<unsigned> bisect(const std::vector<dealii::Point<dim>> &points, unsigned n_parts);
} // namespace unilateral
