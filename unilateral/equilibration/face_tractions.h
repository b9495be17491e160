// Polynomial tractions on the faces of a mesh, the same from both sides but for the sign.
#pragma once

#include "unilateral/equilibration/orthonormal_polynomials.h"
#include "unilateral/equilibration/straight_face.h"

#include <deal.II/grid/tria.h>

#include <Eigen/Core>

#include <vector>

namespace unilateral
{
  /// A polynomial of a given degree with dim components on each face, and its negative on the other side. Where a cell has several smaller
  /// neighbours on a face there is one polynomial on all of it.
  template <int dim>
  class FaceTractions
  {
  public:
    using Cell = typename dealii::Triangulation<dim>::active_cell_iterator;

    FaceTractions(const dealii::Triangulation<dim> &triangulation, unsigned degree);

    /// A cell at a face; the first one of a face is its owner, which has all of it.
    struct Member
    {
      std::size_t cell; ///< active cell index
      unsigned    face; ///< of the cell
    };
    struct Face
    {
      std::size_t                         begin, end; ///< its members
      StraightFace<dim>                   geometry;   ///< of the owner
      std::vector<dealii::Tensor<1, dim>> open;       ///< orthonormal directions in which the traction is not given
    };

    const Cell &cell(const std::size_t index) const { return cells[index]; }
    std::size_t face_of(const std::size_t cell, const unsigned face) const { return numbers[cell * n_faces + face]; }
    bool        owns(const std::size_t cell, const unsigned face) const
    {
      const Member &owner = members[faces[face_of(cell, face)].begin];
      return owner.cell == cell && owner.face == face;
    }

    /// The polynomial of a face that fits values at the points of `rule` best: exactly, if it is one.
    void set(std::size_t face, const std::vector<dealii::Tensor<1, dim>> &values);
    /// Adds direction times function m of the basis.
    void add(const std::size_t face, const unsigned m, const dealii::Tensor<1, dim> &amount)
    {
      coefficients[face * basis.size() + m] += amount;
    }

    /// Its coefficients in the basis, as it acts on the owner.
    const dealii::Tensor<1, dim> *polynomial(const std::size_t face) const { return &coefficients[face * basis.size()]; }

    /// The traction on a cell at the points of `rule` on its face @p geometry.
    void at_points(std::size_t cell, unsigned face, const StraightFace<dim> &geometry, std::vector<dealii::Tensor<1, dim>> &values) const;

    const bool                            simplex;
    const dealii::Quadrature<dim - 1>     rule;
    const OrthonormalPolynomials<dim - 1> basis;       ///< in the parameters of a face
    const Eigen::MatrixXd                 tests;       ///< it, at the points of the rule
    unsigned                              n_faces = 0; ///< of a cell
    std::vector<Face>                     faces;
    std::vector<Member>                   members;

  private:
    std::vector<Cell>                   cells;
    std::vector<std::size_t>            numbers;
    std::vector<dealii::Tensor<1, dim>> coefficients;
  };
} // namespace unilateral
