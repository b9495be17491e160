// The stress on a cell with given tractions and divergence that is closest to that of a displacement.
#pragma once

#include "unilateral/algebra/dense_solvers.h"
#include "unilateral/equilibration/body_cells.h"
#include "unilateral/equilibration/elastic_law.h"

namespace unilateral
{
  /// On cells with one shape and one material: the minimum of 1/2 (C^-1 tau, tau) - (tau, eps(v)) over tau = J tau^ J'/det J, tau^ the
  /// stresses of CompositeStresses with given data. Their functions are orthonormal on each part, so that the matrix of C^-1 has a block L'
  /// C^-1 L/det for each, L = congruence(J).
  template <int dim>
  class CellStress
  {
  public:
    CellStress(const typename BodyCells<dim>::OnCell &cell, const typename ElasticLaw<dim>::Matrix &compliance);

    /// @p data, see CompositeStresses; @p moments: int phi_k J' eps(v) J over the part, by index(part, k, component), twice the shear. The
    /// coefficients of tau^.
    Eigen::VectorXd closest(const CompositeStresses<dim> &stresses, const Eigen::VectorXd &data, const Eigen::VectorXd &moments) const;

    typename ElasticLaw<dim>::Matrix to_stress; ///< L/det: tau from tau^

  private:
    Eigen::MatrixXd             weighted_bubbles;
    Eigen::LLT<Eigen::MatrixXd> factors;
  };
} // namespace unilateral
