// Q_h, its cone N_h, and K_h: the paper's sets over the points of I_G.
#pragma once

#include "unilateral/inequality/discrete_problem.h"

namespace unilateral
{
  /// Q_h: a number at each of the N points of I_G, with the inner product I_G(p q). The pairing with V_h is (q, v)_G = I_G(q v), the L2
  /// product where (14) holds. The sign is the paper's here: a multiplier p of N_h is <= 0, the contact pressure lambda = -p is not.
  /// Keeps a reference to the problem.
  class MultiplierSpace
  {
  public:
    explicit MultiplierSpace(const DiscreteProblem &problem) : problem(problem) {}

    double inner_product(const Vector &p, const Vector &q) const; ///< I_G(p q)
    double norm(const Vector &q) const;                           ///< ||q||_0 = I_G(q^2)^1/2
    double pairing(const Vector &q, const Vector &v) const;       ///< (q, v)_G = I_G(q Bv), v in V_h without its Dirichlet values

    /// (16): q <= 0 at every point.
    bool in_N_h(const Vector &q) const;

    /// sup { -(q, v - s)_G : q in N_h, ||q||_0 = 1 } = I_G(((v - s)^+)^2)^1/2: v lies in K_h (17) if and only if this is 0.
    double violation(const Vector &v) const;

    /// (10): v <= s at every point, up to @p tolerance.
    bool in_K_h(const Vector &v, double tolerance = 0) const;

  private:
    Vector excess(const Vector &v) const; ///< Bv - s

    const DiscreteProblem &problem;
  };
} // namespace unilateral
