#include "unilateral/equilibration/cell_stress.h"

namespace unilateral
{
  template <int dim>
  CellStress<dim>::CellStress(const typename BodyCells<dim>::OnCell &cell, const typename ElasticLaw<dim>::Matrix &compliance)
    : to_stress(congruence<dim>(cell.J) / cell.det)
  {
    const auto                            &bubbles = cell.stresses->bubbles;
    constexpr unsigned                     n = ElasticLaw<dim>::n;
    const typename ElasticLaw<dim>::Matrix block = to_stress.transpose() * compliance * to_stress * cell.det;
    weighted_bubbles.resize(bubbles.rows(), bubbles.cols());
    for (unsigned row = 0; row < bubbles.rows(); row += n)
      weighted_bubbles.template middleRows<n>(row).noalias() = block * bubbles.template middleRows<n>(row);
    if (bubbles.cols() > 0)
      factors.compute(bubbles.transpose() * weighted_bubbles);
  }

  template <int dim>
  Eigen::VectorXd
  CellStress<dim>::closest(const CompositeStresses<dim> &stresses, const Eigen::VectorXd &data, const Eigen::VectorXd &moments) const
  {
    Eigen::VectorXd x = stresses.particular * data;
    if (stresses.bubbles.cols() > 0)
      x += stresses.bubbles * factors.solve(stresses.bubbles.transpose() * moments - weighted_bubbles.transpose() * x);
    return x;
  }

  template class CellStress<2>;
  template class CellStress<3>;
} // namespace unilateral
