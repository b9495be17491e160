// Symmetric stresses on a cell with given tractions on its faces and given divergence.
#pragma once

#include "unilateral/equilibration/cell_split.h"
#include "unilateral/equilibration/orthonormal_polynomials.h"

#include <deal.II/base/symmetric_tensor.h>

#include <Eigen/Core>

#include <vector>

namespace unilateral
{
  /// The normal stress component order of Flux without what is across the plane: xx, yy, xy in the plane, xx, yy, zz, xy, xz, yz in space.
  template <int dim>
  using StressVector = Eigen::Matrix<double, dim *(dim + 1) / 2, 1>;

  /// Symmetric tensor fields of degree r on each part of a CellSplit, with continuous tractions between the parts (the composite elements
  /// of Johnson and Mercier and, for higher degrees, of Arnold, Douglas and Gupta). Given are
  ///     tau n = sum_m t_fm b_m  on each face f, b_m the polynomials of degree r in the parameters of the StraightFace,
  ///     (div tau, phi_k) = g_jk on each part j, phi_k the orthonormal polynomials of degree r - 1 there.
  /// They must agree: for each rigid body mode v, sum over faces of int t.v = int g.v. Everything is in the coordinates of the corners;
  /// tau = J tau^ J'/det J takes fields to the image under an affine map, where the traction on the image of a face is J tau^ n^ dS^/dS and
  /// the divergence J div tau^/det J.
  /// References: C. Johnson, B. Mercier, Numer. Math. 30 (1978) 103-116; D. N. Arnold, J. Douglas, C. P. Gupta, Numer. Math. 45 (1984)
  /// 1-22.
  template <int dim>
  class CompositeStresses
  {
  public:
    static constexpr unsigned n_components = dim * (dim + 1) / 2;

    /// @p degree at least 1.
    CompositeStresses(const std::vector<dealii::Point<dim>> &corners, bool simplex, unsigned degree);

    unsigned n_parts() const { return split.facets.size(); }
    unsigned n_scalar() const { return on_parts[0].size(); } ///< functions on a part
    unsigned size() const { return n_parts() * n_scalar() * n_components; }
    unsigned n_data() const { return (n_faces * face_basis.size() + n_parts() * n_divergence) * dim; }

    unsigned index(const unsigned part, const unsigned k, const unsigned component) const
    {
      return (part * n_scalar() + k) * n_components + component;
    }
    unsigned traction(const unsigned face, const unsigned m, const unsigned c) const { return (face * face_basis.size() + m) * dim + c; }
    unsigned divergence(const unsigned part, const unsigned k, const unsigned c) const
    {
      return (n_faces * face_basis.size() + part * n_divergence + k) * dim + c;
    }

    /// matrix x = data d for the coefficients x of a stress with data d: moments of the tractions on inner and outer facets, divergence.
    struct Equations
    {
      Eigen::MatrixXd matrix, data;
    };
    Equations equations() const;

    const std::vector<dealii::Point<dim>>    corners;
    const bool                               simplex;
    const unsigned                           degree;
    const CellSplit<dim>                     split;
    const unsigned                           n_faces;
    const OrthonormalPolynomials<dim - 1>    face_basis;   ///< in the parameters of faces
    std::vector<OrthonormalPolynomials<dim>> on_parts;     ///< by part
    unsigned                                 n_divergence; ///< the first functions on a part, of degree r - 1
  };

  /// Entry of a symmetric tensor in StressVector.
  template <int dim>
  constexpr unsigned stress_index(const unsigned a, const unsigned b)
  {
    return a == b ? a : dim == 2 ? 2 : a + b + 2;
  }
} // namespace unilateral
