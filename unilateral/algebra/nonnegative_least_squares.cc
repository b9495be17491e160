#include "unilateral/algebra/nonnegative_least_squares.h"
#include "unilateral/algebra/dense_solvers.h"

#include <limits>
#include <vector>

namespace unilateral
{
  Eigen::VectorXd nonnegative_least_squares(const Eigen::MatrixXd &A, const Eigen::VectorXd &b)
  {
    using Eigen::Index;
    using Eigen::VectorXd;
    VectorXd           x = VectorXd::Zero(A.cols());
    std::vector<Index> passive; // the columns with x > 0
    if (A.cols() == 0)
      return x;
    const double round_off = 1e-12 * A.colwise().norm().maxCoeff() * b.norm();
    for (Index iteration = 0; iteration < 3 * A.cols() + 30; ++iteration)
    {
      VectorXd gradient = A.transpose() * (b - A * x);
      for (const Index j : passive)
        gradient(j) = -std::numeric_limits<double>::infinity();
      Index best = 0;
      if (gradient.maxCoeff(&best) <= round_off)
        break;
      passive.push_back(best);
      while (!passive.empty())
      {
        Eigen::MatrixXd columns(A.rows(), Index(passive.size()));
        for (std::size_t k = 0; k < passive.size(); ++k)
          columns.col(k) = A.col(passive[k]);
        const VectorXd unconstrained = columns.colPivHouseholderQr().solve(b);
        if (unconstrained.minCoeff() > 0)
        {
          x.setZero();
          for (std::size_t k = 0; k < passive.size(); ++k)
            x(passive[k]) = unconstrained(k);
          break;
        }
        // Towards the unconstrained solution as far as all stay positive; what reaches zero leaves.
        double step = 1;
        for (std::size_t k = 0; k < passive.size(); ++k)
          if (unconstrained(k) <= 0)
            step = std::min(step, x(passive[k]) / (x(passive[k]) - unconstrained(k) + std::numeric_limits<double>::min()));
        std::vector<Index> kept;
        for (std::size_t k = 0; k < passive.size(); ++k)
        {
          const Index j = passive[k];
          x(j) += step * (unconstrained(k) - x(j));
          if (x(j) > 1e-14 * x.cwiseAbs().maxCoeff() && !(unconstrained(k) <= 0 && x(j) <= 1e-12 * x.cwiseAbs().maxCoeff()))
            kept.push_back(j);
          else
            x(j) = 0;
        }
        if (kept.size() == passive.size())
          kept.pop_back(); // no progress in floating point: give the newcomer up
        passive = kept;
      }
    }
    return x;
  }
} // namespace unilateral
