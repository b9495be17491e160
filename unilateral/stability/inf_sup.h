// The discrete inf-sup (LBB) constants of V_h and the rule I_G, equation (20).
#pragma once

#include "unilateral/stability/multiplier_pairing.h"

#include <optional>
#include <string>
#include <vector>

namespace unilateral
{
  /// The singular values of a pairing (q, v) between the points of I_G and V_h, in the norms ||q||_0 = I_G(q^2)^(1/2) and the full
  /// ||v||_m: those of W^(1/2) B H^(-1/2).
  struct InfSup
  {
    std::size_t           n_dofs = 0;             ///< free ones
    std::size_t           n_points = 0;           ///< in the zone
    std::size_t           rank = 0, nullity = 0;  ///< of the pairing; they add up to n_points
    double                C_h = 0;                ///< (20): 0 when the nullity is positive
    double                C_h_nonzero = 0;        ///< smallest singular value that is not zero
    std::optional<double> beta_h, beta_h_nonzero; ///< the same with the dual norm of q
    std::vector<double>   lowest_mode;  ///< q at the points of the zone with ||q||_0 = 1 that v feels least: a kernel vector if any
    bool                  dense = true; ///< by dense matrices, else by Lanczos iterations
  };

  struct InfSupLimits
  {
    std::size_t dense = 1200;             ///< points that dense matrices take,
    std::size_t dense_entries = 20000000; ///< with so many entries at most: unknowns times points
    std::size_t sparse = 120000;          ///< unknowns and points together beyond which nothing is tried
    std::size_t dual = 40000;             ///< unknowns of the richer space beyond which beta_h is left out
  };

  /// What takes about a minute: sparse factors fill up more in 3-D.
  constexpr InfSupLimits limits_for(const int dim)
  {
    return dim == 3 ? InfSupLimits{.sparse = 25000, .dual = 20000} : InfSupLimits();
  }

  /// Small problems by dense matrices: Cholesky factor of H, singular values; those above 1e-9 of the largest count. Large ones by a
  /// rank-revealing sparse QR factorisation of the pairing (rank, kernel) and Lanczos iterations (ARPACK) for the smallest eigenvalue of
  /// W^(1/2) B H^-1 B'W^(1/2) on the complement of the kernel, its inverse from a sparse factorisation of [H, P; P', 0].
  /// @p dual: the same functionals on a richer space, for beta_h; null leaves beta_h out. Large problems with a kernel have no
  /// beta_h_nonzero.
  /// Throws std::length_error when the problem is larger than @p limits, std::runtime_error when the iteration fails.
  InfSup inf_sup(const Pairing &pairing, const Pairing *dual = nullptr, const InfSupLimits &limits = {});

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

  /// @p best_rate: m in a domain, 1/2 on a boundary. At least two levels, from coarse to fine, each with points.
  /// @p stable_rule: the one to advise, "" when it is in use already.
  /// @p at_nodes: every point sees a shape function of its own. Then C_h >= c h^best_rate is proved, c of the shapes of the cells, and a
  /// rate between two meshes that are not alike says nothing against it.
  StabilityVerdict
  judge_stability(const std::vector<InfSup> &levels, double best_rate, const std::string &stable_rule, bool at_nodes = false);

  std::string to_string(Stability stability);
} // namespace unilateral
