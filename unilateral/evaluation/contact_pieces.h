// Where contact is: the points of a block that are in contact, and the connected pieces they form.
#pragma once

#include "unilateral/discretisation/problem.h"
#include "unilateral/inequality/discrete_problem.h"

#include <cstddef>
#include <vector>

namespace unilateral
{
  /// The points of a block, of all processes, numbered from 0, and the pieces of contact among them. Neighbours are the points of one cell
  /// or, where cells share no points (Gauss rules), of cells with a common vertex.
  ///
  /// In contact are the points with a positive pressure (Gauss rules: all points of their cells), and those in holes: behind a force that
  /// is concentrated along the edge of contact the discrete pressure vanishes at one point or several, the more the larger the force is
  /// beside the pressure. A hole is a region of cells without pressure within the box around the pieces it touches. Either it
  /// is no farther than `widest_hole` cells from the inside of a piece (points whose neighbours all are in contact) and beside one such
  /// piece only, or it is beside one piece only and has no more than `widest_hole` cells a direction. Points in contact by themselves, the
  /// supports of a pipeline, remain pieces of their own, however close they are.
  template <int dim>
  struct ContactPieces
  {
    static constexpr std::size_t none = -1;
    static constexpr unsigned    no_edge = -1;
    static constexpr unsigned    widest_hole = 8;

    ContactPieces(const Problem<dim> &problem, const ConstraintSet<dim> &constraint_set, std::size_t block, const Vector &lambda);

    std::size_t n_points() const { return x.size(); }

    unsigned                              dimension = dim; ///< of what the weights measure: dim, on a boundary part dim-1
    std::vector<dealii::Point<dim>>       x;
    std::vector<double>                   weight, pressure;
    std::vector<double>                   cell_size; ///< measure^(1/dimension) of the cells that hold the point, their mean
    std::vector<std::vector<std::size_t>> neighbors;
    std::vector<std::vector<std::size_t>> members; ///< of each piece
    std::vector<std::size_t>              piece;   ///< of each point, or `none`
    std::vector<unsigned>                 depth;   ///< steps to the edge of the piece; `no_edge` where all points are in contact

  private:
    void find_pieces(const std::vector<bool> &active);
  };
} // namespace unilateral
