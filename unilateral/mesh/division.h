// Which of several processes gets which cells of a mesh.
#pragma once

#include "unilateral/base/processes.h"

#include <deal.II/base/point.h>
#include <deal.II/base/types.h>
#include <deal.II/grid/tria.h>

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

  /// Parts of the boundary whose nodes are tied to each other.
  using TiedParts = std::vector<dealii::types::boundary_id>;

  /// In @p n_parts of nearly equal size; @p weights: of each active cell, empty: all alike. All base cells with a vertex on one of some
  /// @p tied parts get the same owner, so that no node there lies on a cut.
  template <int dim>
  Division divide(const dealii::Triangulation<dim> &whole,
                  unsigned                          n_parts,
                  const std::vector<double>        &weights = {},
                  const std::vector<TiedParts>     &tied = {});

  /// For each point one of @p n_parts parts of nearly equal weight, by recursive coordinate bisection; no @p weights: all alike.
  template <int dim>
  std::vector<unsigned> bisect(const std::vector<dealii::Point<dim>> &points, unsigned n_parts, const std::vector<double> &weights = {});

  /// What the process with most of it has over the mean of all.
  double largest_over_mean(double own, const Processes &processes);

  /// [vertex]: the base cells there, in ascending order.
  template <int dim>
  std::vector<std::vector<unsigned>> find_cells_at_vertices(const dealii::Triangulation<dim> &whole, int base_level);
} // namespace unilateral
