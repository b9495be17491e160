#include "unilateral/equilibration/cell_stress.h"

#include "unilateral/equilibration/dependent_equations.h"

#include <algorithm>
#include <stdexcept>
#include <vector>

namespace unilateral
{
  template <int dim>
  CellStress<dim>::CellStress(const typename BodyCells<dim>::OnCell &cell, const typename ElasticLaw<dim>::Matrix &compliance)
    : to_stress(congruence<dim>(cell.J) / cell.det), basis(cell.basis)
  {
    constexpr unsigned n = ElasticLaw<dim>::n;
    const Block        block = to_stress.transpose() * compliance * to_stress * cell.det;
    if (basis)
    {
      const auto &bubbles = basis->bubbles;
      weighted_bubbles.resize(bubbles.rows(), bubbles.cols());
      for (unsigned row = 0; row < bubbles.rows(); row += n)
        weighted_bubbles.template middleRows<n>(row).noalias() = block * bubbles.template middleRows<n>(row);
      if (bubbles.cols() > 0)
        factors.compute(bubbles.transpose() * weighted_bubbles);
      return;
    }

    if constexpr (dim == 2)
      prepare_multipliers(*cell.stresses, block);
  }

  template <int dim>
  void CellStress<dim>::prepare_multipliers(const CompositeStresses<2> &stresses, const Block &block)
  {
    constexpr unsigned n = ElasticLaw<dim>::n;
    equations = stresses.equations();
    inverse_block = block.inverse();
    // A part has its own columns, and rows that are zero for all others.
    const auto     &E = equations.matrix;
    Eigen::MatrixXd S = Eigen::MatrixXd::Zero(E.rows(), E.rows()), own, weighted;
    const unsigned  n_own = stresses.n_scalar() * n;
    for (unsigned part = 0; part < stresses.n_parts(); ++part)
    {
      std::vector<unsigned> rows;
      for (unsigned row = 0; row < E.rows(); ++row)
        if ((E.row(row).segment(part * n_own, n_own).array() != 0).any())
          rows.push_back(row);
      own.resize(rows.size(), n_own);
      weighted.resize(rows.size(), n_own);
      for (unsigned i = 0; i < rows.size(); ++i)
        own.row(i) = E.row(rows[i]).segment(part * n_own, n_own);
      for (unsigned column = 0; column < n_own; column += n)
        weighted.template middleCols<n>(column).noalias() = own.template middleCols<n>(column) * inverse_block;
      const Eigen::MatrixXd products = own * weighted.transpose();
      for (unsigned i = 0; i < rows.size(); ++i)
        for (unsigned j = 0; j < rows.size(); ++j)
          S(rows[i], rows[j]) += products(i, j);
    }
    Eigen::MatrixXd N = dependent_equations(stresses);
    N = Eigen::HouseholderQR<Eigen::MatrixXd>(N).householderQ() * Eigen::MatrixXd::Identity(N.rows(), N.cols());
    S.noalias() += (S.trace() / S.rows()) * N * N.transpose();
    factors.compute(S);
  }

  template <int dim>
  Eigen::VectorXd CellStress<dim>::closest(const Eigen::VectorXd &data, const Eigen::VectorXd &moments) const
  {
    if (!basis)
      return by_multipliers(data, moments);
    Eigen::VectorXd x = basis->particular * data;
    if (basis->bubbles.cols() > 0)
      x += basis->bubbles * factors.solve(basis->bubbles.transpose() * moments - weighted_bubbles.transpose() * x);
    return x;
  }

  template <int dim>
  Eigen::VectorXd CellStress<dim>::times_inverse(Eigen::VectorXd x) const
  {
    constexpr unsigned n = ElasticLaw<dim>::n;
    for (unsigned row = 0; row < x.size(); row += n)
      x.template segment<n>(row) = (inverse_block * x.template segment<n>(row)).eval();
    return x;
  }

  template <int dim>
  Eigen::VectorXd CellStress<dim>::by_multipliers(const Eigen::VectorXd &data, const Eigen::VectorXd &moments) const
  {
    const Eigen::VectorXd right = equations.data * data;
    Eigen::VectorXd       x = times_inverse(moments), missing = right - equations.matrix * x;
    const double          size = std::max(right.norm(), missing.norm());
    // The second time takes away what the factors have lost where the cell is long or its angles are small.
    for (unsigned step = 0; step < 3 && missing.norm() > 1e-13 * size; ++step)
    {
      x += times_inverse(equations.matrix.transpose() * factors.solve(missing));
      missing = right - equations.matrix * x;
    }
    if (!(missing.norm() <= 1e-9 * size))
      throw std::domain_error("stresses in balance with given tractions cannot be had on a cell of its shape");
    return x;
  }

  template class CellStress<2>;
  template class CellStress<3>;
} // namespace unilateral
