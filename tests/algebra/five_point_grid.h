// Systems of five-point differences with a known solution.
#pragma once

#include "unilateral/algebra/vector.h"

#include <deal.II/lac/dynamic_sparsity_pattern.h>
#include <deal.II/lac/sparse_matrix.h>

#include <Eigen/Core>

#include <cmath>

namespace unilateral
{
  inline Eigen::MatrixXd dense(const dealii::SparseMatrix<double> &matrix)
  {
    Eigen::MatrixXd result = Eigen::MatrixXd::Zero(matrix.m(), matrix.n());
    for (const auto &entry : matrix)
      result(entry.row(), entry.column()) = entry.value();
    return result;
  }

  /// Five-point differences on n x n nodes with a wind along x; @p copies of it that know nothing of each other, side by side at a node.
  class FivePointGrid
  {
  public:
    explicit FivePointGrid(const unsigned n, const double wind = 0, const unsigned copies = 1) : exact(n * n * copies), rhs(exact), x(exact)
    {
      dealii::DynamicSparsityPattern entries(exact.size(), exact.size());
      for_each_entry(n, wind, copies, [&](const unsigned i, const unsigned j, double) { entries.add(i, j); });
      pattern.copy_from(entries);
      matrix.reinit(pattern);
      for_each_entry(n, wind, copies, [&](const unsigned i, const unsigned j, const double a) { matrix.add(i, j, a); });
      for (unsigned i = 0; i < exact.size(); ++i)
        exact(i) = std::sin(1 + 0.1 * i * i);
      matrix.vmult(rhs, exact);
    }

    double error() const
    {
      Vector e(x);
      e -= exact;
      return e.linfty_norm();
    }

    /// ((x - exact)' T (x - exact))^1/2.
    double energy_error() const
    {
      Vector e(x), Te(x);
      e -= exact;
      matrix.vmult(Te, e);
      return std::sqrt(e * Te);
    }

    dealii::SparsityPattern      pattern;
    dealii::SparseMatrix<double> matrix;
    Vector                       exact, rhs, x;

  private:
    template <typename Visit>
    static void for_each_entry(const unsigned n, const double wind, const unsigned copies, const Visit &visit)
    {
      const int    step[4][2] = {{-1, 0}, {1, 0}, {0, -1}, {0, 1}};
      const double value[4] = {-1 - wind, -1 + wind, -1, -1};
      for (int i = 0; i < int(n); ++i)
        for (int j = 0; j < int(n); ++j)
          for (unsigned c = 0; c < copies; ++c)
            for (unsigned k = 0; k < 4; ++k)
            {
              const int  a = i + step[k][0], b = j + step[k][1], row = (i * n + j) * copies + c;
              const bool within = a >= 0 && b >= 0 && a < int(n) && b < int(n);
              visit(row, row, 1);
              if (within)
                visit(row, (a * n + b) * copies + c, value[k]);
            }
    }
  };
} // namespace unilateral
