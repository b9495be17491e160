#include "unilateral/stability/inf_sup.h"

#include "unilateral/algebra/dense_solvers.h"
#include "unilateral/algebra/eigenvalues.h"
#include "unilateral/algebra/singular_values.h"

#include <Eigen/CholmodSupport>
#include <Eigen/SPQRSupport>
#include <Eigen/SparseCholesky>
#include <Eigen/UmfPackSupport>

#include <fmt/format.h>

#include <cmath>
#include <random>
#include <stdexcept>

namespace unilateral
{
  using Eigen::MatrixXd;
  using Eigen::VectorXd;

  namespace
  {
    using Cholesky = Eigen::CholmodDecomposition<SparseMatrixd, Eigen::Upper>;

    constexpr double rank_threshold = 1e-9; ///< of the largest singular value

    /// L^-1 P with H = L L' (up to a permutation): then P'H^-1 P = (L^-1 P)'(L^-1 P).
    MatrixXd whiten(const Pairing &pairing)
    {
      const Eigen::SimplicialLLT<SparseMatrixd> cholesky(pairing.gram);
      return cholesky.matrixL().solve(cholesky.permutationP() * MatrixXd(pairing.functionals));
    }

    /// A matrix with the same singular values and right vectors, no longer than wide.
    MatrixXd without_excess_rows(const MatrixXd &M)
    {
      if (M.rows() <= M.cols())
        return M;
      const Eigen::HouseholderQR<MatrixXd> qr(M);
      return qr.matrixQR().topRows(M.cols()).triangularView<Eigen::Upper>();
    }

    /// P'H^-1 P, some columns at a time.
    MatrixXd dual_gram(const Pairing &pairing)
    {
      constexpr Eigen::Index block = 64;
      const Cholesky         gram(pairing.gram);
      const Eigen::Index     N = pairing.functionals.cols();
      MatrixXd               D(N, N);
      for (Eigen::Index first = 0; first < N; first += block)
      {
        const Eigen::Index n_columns = std::min(block, N - first);
        D.middleCols(first, n_columns) =
          pairing.functionals.transpose() * MatrixXd(gram.solve(MatrixXd(pairing.functionals.middleCols(first, n_columns))));
      }
      return 0.5 * (D + D.transpose());
    }

    InfSup dense_inf_sup(const Pairing &pairing, const Pairing *dual)
    {
      InfSup               result;
      const MatrixXd       M = without_excess_rows(whiten(pairing));
      const SingularValues of_M = singular_values(M);
      const VectorXd      &sigma = of_M.values;
      while (result.rank < std::size_t(sigma.size()) && sigma(result.rank) > rank_threshold * sigma(0))
        ++result.rank;
      result.C_h_nonzero = result.rank > 0 ? sigma(result.rank - 1) : 0.;
      const VectorXd mode = of_M.right_vectors.col(of_M.right_vectors.cols() - 1);
      result.lowest_mode.assign(mode.begin(), mode.end());
      if (dual && result.rank > 0)
      {
        // beta^2 = min q'M'Mq / q'Dq: with D = L L' the smallest singular value of M L'^-1, squared.
        const Eigen::LLT<MatrixXd> D(dual_gram(*dual));
        if (D.info() != Eigen::Success)
          return result; // a pressure that the richer space does not feel either, or to rounding
        const MatrixXd relative = D.matrixL().solve(M.transpose());
        result.beta_h_nonzero = singular_values(relative).values(result.rank - 1);
      }
      return result;
    }

    /// (P'H^-1 P)^-1 by a factorisation of [H, P; P', -sigma], sigma next to nothing.
    class InverseSchurComplement
    {
    public:
      explicit InverseSchurComplement(const Pairing &pairing) : n(pairing.gram.rows()), N(pairing.functionals.cols())
      {
        const VectorXd h = pairing.gram.diagonal();
        double         largest = 0;
        for (int j = 0; j < N; ++j)
        {
          double sum = 0;
          for (SparseMatrixd::InnerIterator it(pairing.functionals, j); it; ++it)
            sum += it.value() * it.value() / h(it.row());
          largest = std::max(largest, sum);
        }
        shift = 1e-14 * largest;
        std::vector<Eigen::Triplet<double>> entries;
        for (int j = 0; j < n; ++j)
          for (SparseMatrixd::InnerIterator it(pairing.gram, j); it; ++it)
            entries.emplace_back(it.row(), j, it.value());
        for (int j = 0; j < N; ++j)
        {
          for (SparseMatrixd::InnerIterator it(pairing.functionals, j); it; ++it)
          {
            entries.emplace_back(it.row(), n + j, it.value());
            entries.emplace_back(n + j, it.row(), it.value());
          }
          entries.emplace_back(n + j, n + j, -shift);
        }
        matrix.resize(n + N, n + N);
        matrix.setFromTriplets(entries.begin(), entries.end());
        lu.compute(matrix);
        if (lu.info() != Eigen::Success)
          throw std::runtime_error("the sparse factorisation for the inf-sup constant failed");
      }

      VectorXd operator()(const VectorXd &q) const
      {
        VectorXd rhs = VectorXd::Zero(n + N);
        rhs.tail(N) = -q;
        return lu.solve(rhs).tail(N);
      }

      double shift = 0;

    private:
      int                             n, N;
      SparseMatrixd                   matrix;
      Eigen::UmfPackLU<SparseMatrixd> lu;
    };

    /// The complement of the kernel of P: the range of P'.
    class Range
    {
    public:
      explicit Range(const SparseMatrixd &P) : qr(SparseMatrixd(P.transpose())) {}
      std::size_t rank() const { return qr.rank(); }
      VectorXd    project(const VectorXd &q) const
      {
        VectorXd coefficients = qr.matrixQ().transpose() * q;
        coefficients.tail(q.size() - rank()).setZero();
        return qr.matrixQ() * coefficients;
      }

    private:
      Eigen::SPQR<SparseMatrixd> qr;
    };

    InfSup sparse_inf_sup(const Pairing &pairing, const Pairing *dual)
    {
      const SparseMatrixd &P = pairing.functionals;
      const std::size_t    N = P.cols();
      InfSup               result;
      result.dense = false;
      const Range range(P);
      result.rank = range.rank();
      const bool kernel = result.rank < N;
      if (result.rank == 0)
        return result;
      const InverseSchurComplement inverse_schur(pairing);
      const DenseMap               inverse = [&](const VectorXd &q) -> VectorXd
      { return kernel ? range.project(inverse_schur(range.project(q))) : inverse_schur(q); };
      const Eigenpair lowest = smallest_eigenpair(N, inverse, [](const VectorXd &q) { return q; });
      result.C_h_nonzero = std::sqrt(std::max(lowest.value - inverse_schur.shift, 0.));
      VectorXd mode = lowest.vector;
      if (kernel)
      {
        std::mt19937                           random(1980);
        std::uniform_real_distribution<double> uniform(-1, 1);
        for (double &x : mode)
          x = uniform(random);
        mode -= range.project(mode);
        mode /= mode.norm();
      }
      result.lowest_mode.assign(mode.begin(), mode.end());
      if (dual && !kernel)
      {
        const Cholesky gram(dual->gram);
        const DenseMap dual_norm = [&](const VectorXd &q) -> VectorXd
        { return dual->functionals.transpose() * VectorXd(gram.solve(VectorXd(dual->functionals * q))); };
        result.beta_h_nonzero = std::sqrt(smallest_eigenpair(N, inverse, dual_norm).value);
      }
      return result;
    }
  } // namespace

  InfSup inf_sup(const Pairing &pairing, const Pairing *dual, const InfSupLimits &limits)
  {
    const std::size_t n = pairing.gram.rows(), N = pairing.functionals.cols();
    InfSup            result;
    if (n + N > limits.sparse)
      throw std::length_error(fmt::format("{} free unknowns and {} points are more than the {} that are tried", n, N, limits.sparse));
    if (n > 0 && N > 0)
      result = N <= limits.dense && n * N <= limits.dense_entries ? dense_inf_sup(pairing, dual) : sparse_inf_sup(pairing, dual);
    result.n_dofs = n;
    result.n_points = N;
    result.nullity = N - result.rank;
    result.C_h = result.nullity > 0 ? 0. : result.C_h_nonzero;
    if (dual)
      result.beta_h = result.nullity > 0 ? std::optional<double>(0.) : result.beta_h_nonzero;
    return result;
  }

  std::string to_string(const Stability stability)
  {
    switch (stability)
    {
    case Stability::stable:
      return "stable";
    case Stability::weakly_unstable:
      return "weakly unstable";
    case Stability::kernel:
      return "kernel";
    }
    return "";
  }

  StabilityVerdict
  judge_stability(const std::vector<InfSup> &levels, const double best_rate, const std::string &stable_rule, const bool at_nodes)
  {
    StabilityVerdict verdict;
    const InfSup    &fine = levels.back(), &coarse = levels[levels.size() - 2];
    verdict.rate = std::log2(coarse.C_h_nonzero / fine.C_h_nonzero);
    // A kernel that grows like the number of points is one of every cell; a few vectors, or one a row of cells, come from the boundary.
    const double      growth = coarse.nullity > 0 && fine.nullity > 0
                                 ? std::log(double(fine.nullity) / coarse.nullity) / std::log(double(fine.n_points) / coarse.n_points)
                                 : 0.;
    const std::string remedy =
      stable_rule.empty() ? "look at finer levels, where the rate settles" : fmt::format("use the rule '{}'", stable_rule);
    if (fine.nullity > 0.02 * fine.n_points && growth > 0.75)
    {
      verdict.stability = Stability::kernel;
      verdict.advice =
        fmt::format("{} of {} pressure modes do not act on V_h: the contact force is right, the pressure is not unique; for a "
                    "smooth pressure {}",
                    fine.nullity, fine.n_points, remedy);
    }
    else if (verdict.rate > best_rate + 0.3 && at_nodes)
      verdict.advice =
        fmt::format("C_h falls like h^{:.1f} from the one mesh to the other, but for a rule of nodes it falls no faster than "
                    "h^{:.1g} in the end, which is proved: the pressure is unique and does not oscillate",
                    verdict.rate, best_rate);
    else if (verdict.rate > best_rate + 0.3)
    {
      verdict.stability = Stability::weakly_unstable;
      verdict.advice =
        fmt::format("C_h falls like h^{:.1f}, faster than the h^{:.1g} of a stable pair: pressures may oscillate from point to "
                    "point; {}",
                    verdict.rate, best_rate, remedy);
    }
    else
      verdict.advice = fmt::format("C_h falls like h^{:.1f}, as well as any pair can do in the L2 norm of (20): the pressure is unique and "
                                   "does not oscillate",
                                   verdict.rate);
    return verdict;
  }

} // namespace unilateral
