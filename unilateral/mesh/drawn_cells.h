// Coarse cells as a drawing has them: polynomials of higher degree than those that a mesh is computed on.
#pragma once

#include <deal.II/base/point.h>

#include <array>
#include <cstddef>
#include <map>
#include <utility>
#include <vector>

namespace unilateral
{
  /// The points i/degree of the reference cell, 0 <= i <= degree in each of @p dim coordinates; in a simplex those with sum i <= degree.
  /// The first coordinate runs fastest.
  std::vector<std::array<unsigned, 3>> equidistant_points(bool simplex, unsigned dim, unsigned degree);

  /// Some coarse cells as the images of the reference cell under polynomials F of a degree g >= 2 (in each coordinate for hypercubes),
  /// given by their values at equidistant points. Where the values are points of a smooth curve or surface, F misses it by O(h^(g+1)), and
  /// areas and volumes by O(h^(g+2)) for even g: for g = 4 what remains after refinement is far below the error of cells of degree 2 that
  /// stay as they are.
  template <int dim>
  class DrawnCells
  {
  public:
    DrawnCells(bool simplex, unsigned degree);

    unsigned degree() const { return g; }

    /// The points of the reference cell where F is given.
    const std::vector<dealii::Point<dim>> &unit_nodes() const { return at; }

    /// @p nodes: F at unit_nodes().
    void add(unsigned coarse_cell, std::vector<dealii::Point<dim>> nodes) { nodes_of_cell[coarse_cell] = std::move(nodes); }

    bool contain(const unsigned coarse_cell) const { return nodes_of_cell.count(coarse_cell) > 0; }

    /// F at unit_nodes(), by cell.
    const std::map<unsigned, std::vector<dealii::Point<dim>>> &nodes() const { return nodes_of_cell; }
    void move_node(const unsigned coarse_cell, const std::size_t n, const dealii::Point<dim> &x) { nodes_of_cell.at(coarse_cell)[n] = x; }

    /// F of a point in the reference cell of a cell that is contained.
    dealii::Point<dim> position(unsigned coarse_cell, const dealii::Point<dim> &unit) const;

    /// The cells in which the Jacobian of F is not positive at some equidistant point.
    std::vector<unsigned> folded_cells() const;

  private:
    /// The Lagrange polynomials of all equidistant points, each 1 at its own and 0 at the others, at a point.
    std::vector<double> shape_functions(const dealii::Point<dim> &unit) const;

    bool                                                simplex;
    unsigned                                            g;
    std::vector<std::array<unsigned, 3>>                lattice;
    std::vector<dealii::Point<dim>>                     at;
    std::map<unsigned, std::vector<dealii::Point<dim>>> nodes_of_cell; ///< by index of the coarse cell
  };
} // namespace unilateral
