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
  ///
  /// Where the cell has a StressBasis, among its bubbles. Else, on quadrilaterals that are no parallelograms, by multipliers of the
  /// equations E x = D d, a tenth of the work that a basis for each cell would be: with M the matrix of C^-1,
  ///     x = M^-1 (m + E' mu),   (E M^-1 E' + c N N') mu = D d - E M^-1 m,
  /// N the dependent_equations(). Without c N N', which changes nothing where the data agree, the matrix would be singular.
  template <int dim>
  class CellStress
  {
  public:
    /// Throws std::domain_error where tractions and divergence cannot all be had.
    CellStress(const typename BodyCells<dim>::OnCell &cell, const typename ElasticLaw<dim>::Matrix &compliance);

    /// @p data, see CompositeStresses; @p moments: int phi_k J' eps(v) J over the part, by index(part, k, component), twice the shear. The
    /// coefficients of tau^. Throws std::domain_error where the equations are not met.
    Eigen::VectorXd closest(const Eigen::VectorXd &data, const Eigen::VectorXd &moments) const;

    typename ElasticLaw<dim>::Matrix to_stress; ///< L/det: tau from tau^

  private:
    using Block = typename ElasticLaw<dim>::Matrix;

    void            prepare_multipliers(const CompositeStresses<2> &stresses, const Block &block);
    Eigen::VectorXd by_multipliers(const Eigen::VectorXd &data, const Eigen::VectorXd &moments) const;
    Eigen::VectorXd times_inverse(Eigen::VectorXd x) const; ///< M^-1 x

    const StressBasis                       *basis;
    Eigen::MatrixXd                          weighted_bubbles;
    typename CompositeStresses<2>::Equations equations; ///< of quadrilaterals
    Block                                    inverse_block;
    Eigen::LLT<Eigen::MatrixXd>              factors; ///< of the bubbles or the multipliers
  };
} // namespace unilateral
