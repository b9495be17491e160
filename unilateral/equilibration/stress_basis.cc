#include "unilateral/equilibration/stress_basis.h"

#include "unilateral/algebra/dense_solvers.h"

#include <stdexcept>

namespace unilateral
{
  template <int dim>
  StressBasis::StressBasis(const CompositeStresses<dim> &stresses)
  {
    const auto                                  all = stresses.equations();
    const unsigned                              size = stresses.size();
    Eigen::ColPivHouseholderQR<Eigen::MatrixXd> qr;
    qr.setThreshold(1e-11);
    qr.compute(all.matrix.transpose());
    const unsigned        rank = qr.rank();
    const Eigen::MatrixXd Q = qr.householderQ() * Eigen::MatrixXd::Identity(size, size);
    const Eigen::MatrixXd d = (qr.colsPermutation().transpose() * all.data).topRows(rank);
    const Eigen::MatrixXd R = qr.matrixR().topLeftCorner(rank, rank);
    particular = Q.leftCols(rank) * R.transpose().triangularView<Eigen::Lower>().solve(d);
    bubbles = Q.rightCols(size - rank);

    // The equations that were left out follow from the others where forces and moments agree: as many conditions as rigid body modes.
    const Eigen::MatrixXd                       rest = all.matrix * particular - all.data;
    Eigen::ColPivHouseholderQR<Eigen::MatrixXd> conditions;
    conditions.setThreshold(1e-9);
    conditions.compute(rest.transpose() * rest);
    if (conditions.rank() != dim * (dim + 1) / 2)
      throw std::domain_error("stresses in balance with given tractions cannot be had on a cell of its shape");
  }

  template StressBasis::StressBasis(const CompositeStresses<2> &);
  template StressBasis::StressBasis(const CompositeStresses<3> &);
} // namespace unilateral
