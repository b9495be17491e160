// A mesh divided among several processes, and the part that one of them has.
#pragma once

#include "unilateral/base/processes.h"
#include "unilateral/mesh/mesh.h"

#include <deal.II/grid/tria.h>

#include <memory>
#include <vector>

namespace unilateral
{
  /// Which process has which cells of a mesh. The cells of the finest level that covers all of the mesh, its base cells, are given away
  /// with all their descendants; in a mesh whose cells have all been refined equally often they are its active cells.
  struct Division
  {
    int                   base_level = 0; ///< of the triangulation
    std::vector<unsigned> owner;          ///< for each base cell its process
  };

  /// In @p n_parts of nearly equal size; @p weights: of each active cell, empty: all alike.
  template <int dim>
  Division divide(const dealii::Triangulation<dim> &whole, unsigned n_parts, const std::vector<double> &weights = {});

  /// A non-overlapping decomposition of a mesh, and the own part of it as a mesh of its own, whose coarse cells are base cells. Every
  /// process knows the whole mesh as it was when it was divided; from there on each refines its part alone.
  template <int dim>
  struct Subdomain
  {
    Processes                          processes;
    unsigned                           level = 0; ///< of refinement of `whole`
    Mesh<dim>                          whole;     ///< alive as long as the part: manifolds refer to it
    Division                           division;
    std::vector<unsigned>              own_cells;        ///< for each coarse cell of the part its number among the base cells
    std::vector<unsigned>              own_active_cells; ///< for each active cell of the part, as it was cut out, its number in the whole
    std::vector<unsigned>              vertex;           ///< [coarse cell of the part][vertex]: its number in the whole
    std::vector<unsigned>              vertex_in_whole;  ///< of each vertex of the coarse mesh of the part
    std::vector<std::vector<unsigned>> cells_at_vertex;  ///< base cells

    unsigned owner(const unsigned base_cell) const { return division.owner[base_cell]; }
  };

  /// Cuts out the own part. @p mesh becomes the part, refined as it was: faces that the cut has laid bare belong to a
  /// boundary part "" that it gets in addition. Curved cells keep their place in memory, so that a mapping may refer to them.
  /// Where the mesh was refined in places, it has to conform at the cuts, see refinement_at_cuts.h.
  template <int dim>
  std::unique_ptr<Subdomain<dim>> cut_out_subdomain(Mesh<dim> &mesh, unsigned level, const Processes &processes, Division division);

  /// For each point one of @p n_parts parts of nearly equal weight, by recursive coordinate bisection; no @p weights: all alike.
  template <int dim>
  std::vector<unsigned> bisect(const std::vector<dealii::Point<dim>> &points, unsigned n_parts, const std::vector<double> &weights = {});
} // namespace unilateral
