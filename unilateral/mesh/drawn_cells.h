// Coarse cells as a drawing has them: polynomials of higher degree than those that a mesh is computed on.
#pragma once

#include <deal.II/base/point.h>

#include <array>
#include <map>
#include <vector>

namespace unilateral
{
  /// Equidistant points of the reference cell, those i/degree with 0 <= i <= degree in each of @p dim coordinates; in a simplex those with
  /// sum i <= degree. The first coordinate is the fastest.
  std::vector<std::array<unsigned, 3>> equidistant_points(bool simplex, unsigned dim, unsigned degree);

  /// Some coarse cells as the images of the reference cell under polynomials F of a degree g >= 2 (in each coordinate for hypercubes),
  /// given by their values at equidistant points. Where the values are points of a smooth curve or surface, F misses it by O(h^(g+1)), or
  /// O(h^(g+2)) where g is even and cells are of about one size along it: for g = 4 what remains after refinement is far below the error of
  /// cells of degree 2 that stay as they are.
  template <int dim>
  class DrawnCells
  {
  public:
    using Corners = std::array<dealii::Point<dim>, dim + 1>;

    DrawnCells(bool simplex, unsigned degree);

    /// @p nodes: F at equidistant_points() of a reference cell in which the origin and the end of each unit vector of the reference cell of
    /// @p coarse_cell have the coordinates @p corners.
    void add(unsigned coarse_cell, const Corners &corners, std::vector<dealii::Point<dim>> nodes);

    bool contain(const unsigned coarse_cell) const { return cells.count(coarse_cell) > 0; }
    void remove(const unsigned coarse_cell) { cells.erase(coarse_cell); }

    /// F of a point in the reference cell of a cell that is contained.
    dealii::Point<dim> position(unsigned coarse_cell, const dealii::Point<dim> &unit) const;

    /// The cells in which the Jacobian of F is not positive at some equidistant point.
    std::vector<unsigned> folded_cells() const;

  private:
    struct Cell
    {
      Corners                         corners;
      std::vector<dealii::Point<dim>> nodes;
    };

    /// F in the reference cell that the nodes are numbered in.
    dealii::Point<dim> position(const Cell &cell, const dealii::Point<dim> &unit) const;
    /// Where @p i/degree of an equidistant point is 1 and the others 0; on simplices of d + 1 barycentric coordinates (Silvester's form).
    double shape(const std::array<unsigned, 3> &i, const dealii::Point<dim> &unit) const;

    bool                                 simplex;
    unsigned                             degree;
    std::vector<std::array<unsigned, 3>> lattice;
    std::map<unsigned, Cell>             cells; ///< by index of the coarse cell
  };
} // namespace unilateral
