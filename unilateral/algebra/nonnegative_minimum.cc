#include "unilateral/algebra/nonnegative_minimum.h"
#include "unilateral/algebra/dense_solvers.h"

#include <algorithm>
#include <vector>

namespace unilateral
{
  using Eigen::Index;
  using Eigen::MatrixXd;
  using Eigen::VectorXd;

  namespace
  {
    constexpr unsigned rounds = 40, sweeps_per_round = 5;

    /// @p gradient: b - M x, kept up to date.
    void sweep(const MatrixXd &M, VectorXd &x, VectorXd &gradient)
    {
      for (Index i = 0; i < x.size(); ++i)
      {
        const double moved = std::max(x(i) + gradient(i) / M(i, i), 0.), step = moved - x(i);
        if (step == 0)
          continue;
        x(i) = moved;
        gradient -= step * M.col(i);
      }
    }

    /// Without constraints, the other entries zero.
    VectorXd minimum_on(const std::vector<Index> &positive, const MatrixXd &M, const VectorXd &b)
    {
      const MatrixXd M_positive = M(positive, positive);
      const VectorXd solution = M_positive.llt().solve(b(positive));
      VectorXd       x = VectorXd::Zero(b.size());
      x(positive) = solution;
      return x;
    }
  } // namespace

  VectorXd nonnegative_minimum(const MatrixXd &M, const VectorXd &b)
  {
    const double round_off = 1e-12 * b.cwiseAbs().sum();
    const auto   value = [&](const VectorXd &x) { return x.dot(0.5 * (M * x) - b); };
    VectorXd     x = VectorXd::Zero(b.size()), gradient = b;
    for (unsigned round = 0; round < rounds; ++round)
    {
      for (unsigned k = 0; k < sweeps_per_round; ++k)
        sweep(M, x, gradient);
      std::vector<Index> positive;
      for (Index i = 0; i < x.size(); ++i)
        if (x(i) > 0)
          positive.push_back(i);
      if (positive.empty())
        return x;
      const VectorXd candidate = minimum_on(positive, M, b), projected = candidate.cwiseMax(0.);
      if (!candidate.allFinite())
        return x;
      VectorXd   at_candidate = b - M * projected;
      const bool feasible = candidate.minCoeff() >= 0;
      if (feasible && at_candidate.maxCoeff() <= round_off)
        return candidate;
      if (feasible || value(projected) < value(x))
      {
        x = projected;
        gradient = at_candidate;
      }
    }
    return x;
  }
} // namespace unilateral
