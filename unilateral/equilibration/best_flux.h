// The flux in a cell with given moments that is closest to k grad v.
#pragma once

#include "unilateral/equilibration/reference_fluxes.h"
#include "unilateral/equilibration/tabulated_element.h"

#include <deal.II/base/quadrature.h>
#include <deal.II/base/tensor.h>

#include <Eigen/Core>

#include <vector>

namespace unilateral
{
  /// Among the fields y = J y^ / det J of ReferenceFluxes with given moments d that with the least int (y - k grad v) . k^-1 (y - k grad
  /// v), by a rule on the reference cell. With T = J' k^-1 J / det J it minimises int y^ . T y^ - 2 y^ . J' grad v dx^. Where T is
  /// constant, the answer is P d + R J' grad v with two matrices that depend on T alone, up to a factor of it: they are kept for those T
  /// that repeat, as on meshes of squares, whatever their size.
  template <int dim>
  class BestFlux
  {
  public:
    BestFlux(const ReferenceFluxes<dim> &fields, const dealii::Quadrature<dim> &rule);

    /// The coefficients of y^. @p inverse_k, @p gradient (of v): at the points; @p uniform: k does not depend on the place.
    Eigen::VectorXd coefficients(const Eigen::VectorXd                      &moments,
                                 const StraightCell<dim>                    &cell,
                                 const typename StraightCell<dim>::AtPoints &at,
                                 const std::vector<dealii::Tensor<2, dim>>  &inverse_k,
                                 bool                                        uniform,
                                 const std::vector<dealii::Tensor<1, dim>>  &gradient);

    Eigen::MatrixXd values, divergences; ///< of the fields, see ReferenceFluxes

  private:
    /// For all multiples of one T.
    struct Solution
    {
      dealii::Tensor<2, dim> T; ///< of norm 1
      bool                   found = false;
      Eigen::MatrixXd        of_moments, of_gradient; ///< P, and R |T|
    };
    void find(Solution &solution) const;

    const Eigen::MatrixXd    &particular, &bubbles;
    const std::vector<double> weights;
    const Eigen::MatrixXd     bubble_values;
    std::vector<Solution>     known;
  };
} // namespace unilateral
