// A mesh divided among several processes, and the part that one of them has.
#pragma once

#include "unilateral/base/processes.h"
#include "unilateral/mesh/division.h"
#include "unilateral/mesh/mesh.h"

#include <deal.II/grid/tria.h>

#include <cstdint>
#include <memory>
#include <unordered_map>
#include <vector>

namespace unilateral
{
  /// What the parts of a mesh know of each other that are divided again, all at the same time.
  struct NeighborParts
  {
    struct Cell
    {
      std::uint64_t id;    ///< the same on all processes
      unsigned      owner; ///< after this division
    };
    std::vector<std::uint32_t>             vertex_ids; ///< of each vertex, the same on all processes
    std::vector<std::pair<unsigned, Cell>> cells;      ///< of other parts, at the vertices that these have, too
  };

  /// A non-overlapping decomposition of a mesh, and the own part of it as a mesh of its own, whose coarse cells are base cells. Every
  /// process knows the mesh as it was when it was divided; from there on each refines its part alone.
  /// Many processes divide a mesh in several steps: at first several of them have the same part, which then is the "whole" that these
  /// divide among themselves.
  template <int dim>
  struct Subdomain
  {
    Processes processes;   ///< one for each part
    unsigned  n_alike = 1; ///< processes that have this part, too, this one included
    unsigned  level = 0;   ///< of refinement of `whole`
    Mesh<dim> whole;       ///< what this step divides; alive as long as the part: manifolds refer to it. Without a
                           ///< triangulation where another process has made it, see sent_part.h
    Division                   division;
    std::vector<unsigned>      own_cells;        ///< for each coarse cell of the part its number among the base cells that are known here
    std::vector<std::uint32_t> ids_of_cells;     ///< likewise its number among those of all processes; empty: the same
    std::vector<unsigned>      own_active_cells; ///< for each active cell of the part, as it was cut out, its number in the whole
    std::vector<std::uint32_t> vertex;           ///< [coarse cell of the part][vertex]: its id
    std::vector<std::uint32_t> ids_of_vertices;  ///< of each vertex of the coarse mesh of the part
    std::vector<std::vector<unsigned>>
      cells_at_vertex; ///< [vertex of the whole]: base cells, those of neighbour parts with further numbers

    dealii::Point<dim>                          some_point;       ///< of the mesh, the same on all processes
    std::unordered_map<std::uint32_t, unsigned> number_of_vertex; ///< in the whole, by its id; empty: its number is the id
    std::unique_ptr<Subdomain>                  previous;         ///< the step before; manifolds refer to its whole mesh

    /// How often the coarse cells of the part have been refined since the coarse mesh of the case.
    unsigned level_of_coarse_cells() const
    {
      return whole.simplex ? level : division.base_level + (previous ? previous->level_of_coarse_cells() : 0);
    }

    unsigned id_of_cell(const unsigned coarse) const { return ids_of_cells.empty() ? own_cells[coarse] : ids_of_cells[coarse]; }
    unsigned owner(const unsigned base_cell) const { return division.owner[base_cell]; }
    const std::vector<unsigned> &cells_at(const std::uint32_t id) const
    {
      return cells_at_vertex[number_of_vertex.empty() ? id : number_of_vertex.at(id)];
    }
  };

  /// What a part knows of the others, without the mesh that was divided.
  template <int dim>
  std::unique_ptr<Subdomain<dim>> without_whole(const Subdomain<dim> &subdomain);

  /// Cuts out the own part. @p mesh becomes the part, refined as it was: faces that the cut has laid bare belong to a
  /// boundary part "" that it gets in addition. Curved cells keep their place in memory, so that a mapping may refer to them.
  /// Where the mesh was refined in places, it has to conform at the cuts, see refinement_at_cuts.h.
  /// Where it is a part of a mesh already, @p previous and @p neighbors, see find_neighbor_parts(), belong to that.
  template <int dim>
  std::unique_ptr<Subdomain<dim>> cut_out_subdomain(Mesh<dim>                      &mesh,
                                                    unsigned                        level,
                                                    const Processes                &processes,
                                                    Division                        division,
                                                    std::unique_ptr<Subdomain<dim>> previous = nullptr,
                                                    const NeighborParts            &neighbors = {});
} // namespace unilateral
