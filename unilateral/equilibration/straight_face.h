// Faces of straight cells: parameters, normal, rules.
#pragma once

#include <deal.II/base/point.h>
#include <deal.II/base/quadrature.h>
#include <deal.II/base/tensor.h>
#include <deal.II/grid/tria.h>

#include <array>
#include <vector>

namespace unilateral
{
  /// The corners of a face as numbers of the corners of its cell, on the reference cell, which all functions here follow.
  template <int dim>
  std::vector<unsigned> corners_of_face(bool simplex, unsigned face);

  /// The corners of the reference cell.
  template <int dim>
  std::vector<dealii::Point<dim>> reference_corners(bool simplex);

  /// A flat face, x = origin + sum of xi_k edges[k], xi in the reference segment, triangle or square.
  template <int dim>
  struct StraightFace
  {
    /// Of the polytope with these corners.
    StraightFace(const std::vector<dealii::Point<dim>> &corners, bool simplex, unsigned face);
    StraightFace(const typename dealii::Triangulation<dim>::cell_iterator &cell, unsigned face);

    dealii::Point<dim>     at(const dealii::Point<dim - 1> &xi) const;
    dealii::Point<dim - 1> parameters(const dealii::Point<dim> &x) const; ///< of the foot of the perpendicular

    dealii::Point<dim>                          origin;
    std::array<dealii::Tensor<1, dim>, dim - 1> edges, dual;
    dealii::Tensor<1, dim>                      normal; ///< outwards, of unit length
    double                                      dS = 0; ///< area for a unit of area of the parameters
  };

  /// Exact for polynomials of @p degree on the reference face; on squares in each coordinate.
  template <int dim>
  dealii::Quadrature<dim - 1> rule_on_face(bool simplex, unsigned degree);

  /// Its points on a face of the reference cell.
  template <int dim>
  dealii::Quadrature<dim> on_reference_cell(bool simplex, unsigned face, const dealii::Quadrature<dim - 1> &rule);
} // namespace unilateral
