#include "unilateral/equilibration/system_of_parts.h"

#include <algorithm>
#include <vector>

namespace unilateral
{
  using Eigen::MatrixXd;
  using Eigen::VectorXd;

  SystemOfParts::SystemOfParts(const Processes &processes, const unsigned n, const std::map<unsigned, MatrixXd> &own) : processes(processes)
  {
    // One record for each: the two processes, and the matrix.
    std::vector<double> records;
    for (const auto &[other, coupling] : own)
    {
      records.push_back(processes.rank());
      records.push_back(other);
      records.insert(records.end(), coupling.data(), coupling.data() + n * n);
    }
    records = processes.gather(records);
    std::vector<Eigen::Triplet<double>> entries;
    double                              largest = 0;
    const auto                          add = [&](const unsigned p, const unsigned q, const MatrixXd &block, const double factor)
    {
      for (unsigned k = 0; k < n; ++k)
        for (unsigned l = 0; l < n; ++l)
          entries.emplace_back(p * n + k, q * n + l, factor * block(k, l));
      largest = std::max(largest, block.cwiseAbs().maxCoeff());
    };
    for (std::size_t at = 0; at < records.size(); at += 2 + n * n)
    {
      const unsigned p = unsigned(records[at]), q = unsigned(records[at + 1]);
      const MatrixXd block = Eigen::Map<const MatrixXd>(&records[at + 2], n, n);
      if (p == q)
        add(p, p, block, 1);
      else
        for (const unsigned side : {p, q})
        {
          add(side, side, block, 0.5);
          add(side, side == p ? q : p, block, -0.5);
        }
      if (p != q && (p == processes.rank() || q == processes.rank()))
        couplings.try_emplace(p == processes.rank() ? q : p, MatrixXd::Zero(n, n)).first->second += 0.5 * block;
    }
    Eigen::SparseMatrix<double> matrix(processes.size() * n, processes.size() * n);
    matrix.setFromTriplets(entries.begin(), entries.end());
    matrix.makeCompressed();
    constexpr double dependent = 1e-12;
    factors.setPivotThreshold(dependent * largest);
    factors.compute(matrix);
  }

  VectorXd SystemOfParts::solve(const VectorXd &own) const
  {
    const std::vector<double> r = processes.gather(std::vector<double>(own.begin(), own.end()));
    return factors.solve(VectorXd(Eigen::Map<const VectorXd>(r.data(), r.size())));
  }
} // namespace unilateral
