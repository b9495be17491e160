// What lies beyond the cuts between subdomains.
#pragma once

#include "unilateral/discretisation/problem.h"

#include <map>
#include <utility>
#include <vector>

namespace unilateral
{
  /// The faces of the part of a mesh that other processes have, too: with straight cells on both sides that conform.
  template <int dim>
  class CutFaces
  {
  public:
    /// Collective.
    explicit CutFaces(const Problem<dim> &problem);

    struct Beyond
    {
      unsigned                   process;
      dealii::types::material_id region;
      unsigned                   number; ///< of the face among those of that process
    };

    /// A face of an active cell, on a cut.
    struct Face
    {
      std::size_t cell;
      unsigned    face;
      unsigned    vertex; ///< the unknown at one of its vertices
    };
    const std::vector<Face> &faces() const { return own; }

    /// Beyond face @p face of active cell @p cell; null where that is on no cut.
    const Beyond *find(const std::size_t cell, const unsigned face) const
    {
      const auto found = beyond.find({cell, face});
      return found == beyond.end() ? nullptr : &found->second;
    }

    /// Each face of this process on a cut has been found on another one.
    bool conform() const { return complete; }

    /// The numbers of the process beyond on each of faces(), in exchange for @p own_numbers. Where conform(). Collective.
    std::vector<std::vector<double>> exchange(const std::vector<std::vector<double>> &own_numbers) const;

  private:
    Processes                                          team;
    bool                                               complete = true;
    std::vector<Face>                                  own;
    std::map<std::pair<std::size_t, unsigned>, Beyond> beyond;
  };

  /// The cells on both sides of a face, of which the other may be that of another process, are of different regions.
  template <int dim, typename Cell>
  bool between_regions(const CutFaces<dim> &cuts, const Cell &cell, const unsigned face)
  {
    if (const auto *const beyond = cuts.find(cell->active_cell_index(), face))
      return beyond->region != cell->material_id();
    if (cell->at_boundary(face))
      return false;
    auto neighbor = cell->neighbor(face);
    while (neighbor->has_children())
      neighbor = neighbor->child(0);
    return neighbor->material_id() != cell->material_id();
  }
} // namespace unilateral
