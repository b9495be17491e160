// Vector fields on the reference cell with given flux through the faces and given divergence.
#pragma once

#include <deal.II/base/point.h>
#include <deal.II/base/quadrature.h>
#include <deal.II/base/tensor.h>

#include <Eigen/Core>

#include <array>
#include <vector>

namespace unilateral
{
  /// Polynomial vector fields y^ on the reference cell: Raviart-Thomas RT_r on segments, squares and cubes (component d of degree r + 1 in
  /// x_d and r in the others), BDM_(r+1) on triangles and tetrahedra (all of degree r + 1). The contravariant Piola transform
  /// y = J y^ / det J takes them to cells: y.n dS = y^.n^ dS^ and div y dx = div y^ dx^, so what is said here of faces and divergence holds
  /// on every cell. Reference: D. Boffi, F. Brezzi, M. Fortin, Mixed Finite Element Methods and Applications (2013), ch. 2.
  template <int dim>
  class ReferenceFluxes
  {
  public:
    ReferenceFluxes(bool simplex, unsigned degree);

    /// A face: points in the coordinates of the cell; `normal` outwards, of length dS^ / d(parameters).
    struct Face
    {
      dealii::Quadrature<dim> rule;
      dealii::Tensor<1, dim>  normal;
      Eigen::MatrixXd         tests; ///< points x test functions: the normal components of the space are those polynomials, the first is 1
    };

    unsigned size() const { return functions.size(); }
    unsigned n_moments() const { return faces.size() * n_face_tests + n_cell_tests; }
    unsigned face_moment(const unsigned face, const unsigned test) const { return face * n_face_tests + test; }
    unsigned cell_moment(const unsigned test) const { return faces.size() * n_face_tests + test; }

    /// Rows: points times components; columns: the functions.
    Eigen::MatrixXd values_at(const std::vector<dealii::Point<dim>> &points) const;
    Eigen::MatrixXd divergences_at(const std::vector<dealii::Point<dim>> &points) const;
    Eigen::MatrixXd cell_tests_at(const std::vector<dealii::Point<dim>> &points) const; ///< points x tests: the divergences, the first is 1

    std::vector<Face> faces;
    unsigned          n_face_tests = 0, n_cell_tests = 0;

    /// The field of moments d (of y^.n^ on faces, of div y^ on the cell) is `particular` d plus any combination of `bubbles`, the columns,
    /// which have none. The moments of 1 must agree: the flux out of the cell is the integral of the divergence.
    Eigen::MatrixXd particular, bubbles;

  private:
    struct Function
    {
      unsigned                  component;
      std::array<unsigned, dim> degrees; ///< of Legendre polynomials in each coordinate
    };
    void add_faces(bool simplex);

    const unsigned                         degree;
    std::vector<Function>                  functions;
    std::vector<std::array<unsigned, dim>> cell_degrees; ///< of the tests
  };
} // namespace unilateral
