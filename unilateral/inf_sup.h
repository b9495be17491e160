// The discrete inf-sup (LBB) constants of V_h and the rule I_G, equation (20).
#pragma once

#include "unilateral/assembled.h"
#include "unilateral/problem.h"

#include <optional>
#include <string>
#include <vector>

namespace unilateral
{
  /// The singular values of the pairing (q, v)_G between the points of I_G and V_h, in the norms ||q||_0 = I_G(q^2)^(1/2) and the full
  /// ||v||_m: those of W^(1/2) B H^(-1/2).
  struct InfSup
  {
    std::size_t           n_dofs = 0;             ///< free ones
    std::size_t           n_points = 0;           ///< in the zone
    std::size_t           rank = 0, nullity = 0;  ///< singular values above 1e-9 of the largest count
    double                C_h = 0;                ///< (20): 0 when the nullity is positive
    double                C_h_nonzero = 0;        ///< smallest singular value that counts
    std::optional<double> beta_h, beta_h_nonzero; ///< the same with the dual norm of q, see dual_norm_of()
    std::vector<double>   lowest_mode;            ///< q at the points of the zone that belongs to C_h (or a kernel vector)
  };

  /// Largest number of free unknowns that the dense computation takes.
  constexpr std::size_t largest_dense_inf_sup = 2600;

  /// Computes everything exactly, with dense matrices: Cholesky of H, singular values of the pairing.
  /// @p zone: the points that q may use (N flags). @p with_dual_norm also computes beta_h.
  ///
  /// The dual norm ||q||_{-m} = sup (q, v)/||v||_m is taken over a richer space. (q, v) is the L2 product of the polynomial q where (14)
  /// holds, over degree p + 6 in 1-D, p + 3 in 2-D on the same mesh, accurate to about three digits for the modes that decide. Elsewhere
  /// it is I_G(q v): in 1-D over hats between the points, exact up to O(h^2); in 2-D over degree p + 3, where point masses have no dual
  /// norm in the limit and beta_h depends on the rule. In 3-D and on simplices beta_h is not computed.
  /// Throws std::invalid_argument when the problem is too large for dense matrices.
  template <int dim>
  InfSup inf_sup(const Problem<dim> &problem, const ConstraintSet<dim> &constraint_set, const std::vector<bool> &zone, bool with_dual_norm);

  enum class Stability
  {
    stable,          ///< C_h falls no faster than the inverse inequality allows: h^m in a domain, h^(1/2) on a boundary
    weakly_unstable, ///< C_h or the smallest non-zero singular value falls faster: a checkerboard
    kernel           ///< a share of Q_h that does not shrink with h is invisible to V_h
  };

  struct StabilityVerdict
  {
    Stability   stability = Stability::stable;
    double      rate = 0; ///< C_h_nonzero ~ h^rate between the last two levels
    std::string advice;   ///< one sentence: what it means and what to do
  };

  /// @p best_rate: m in a domain, 1/2 on a boundary. At least two levels.
  StabilityVerdict judge_stability(const std::vector<InfSup> &levels, double best_rate, const std::string &stable_rule);

  std::string to_string(Stability stability);
} // namespace unilateral
