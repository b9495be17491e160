// The interface between discretisations and solvers: all that the solvers, the certificate and the studies know of a discretised problem.
#pragma once

#include "unilateral/algebra/linear_solve.h"
#include "unilateral/algebra/vector.h"
#include "unilateral/base/shared_unknowns.h"
#include "unilateral/inequality/local_rows.h"

#include <limits>
#include <string>
#include <vector>

namespace unilateral
{
  /// A u + B' W lambda = f with unilateral constraints B u <= s at N points of the rule I_G with weights W (equations (7), (18), (21)).
  ///
  /// Dirichlet data are eliminated: vectors have a zero in the entries that they fix, A has no coupling with those, and f and s hold
  /// the contribution of the data. A lower obstacle u >= psi is the rows -B, -s.
  class DiscreteProblem
  {
  public:
    virtual ~DiscreteProblem() = default;

    virtual void initialize_dof_vector(Vector &v) const = 0;   ///< n zeros
    virtual void initialize_point_vector(Vector &q) const = 0; ///< N zeros

    /// Where several processes have a part of the problem each: the unknowns that more than one of them has. Vectors have equal values
    /// there, and so have points at such nodes. All that follows is collective then.
    virtual const SharedUnknowns &shared() const
    {
      static const SharedUnknowns nothing;
      return nothing;
    }
    virtual bool owns_point(std::size_t) const { return true; } ///< false: another process counts it

    const Processes &processes() const { return shared().processes(); }

    /// The scalar product of vectors of V_h, every unknown counted once.
    double dot(const Vector &u, const Vector &v) const { return shared().dot(u.begin(), v.begin(), u.locally_owned_size()); }

    /// The sum of @p term(i) over the points of all processes, each counted once.
    template <typename Term>
    double sum_over_points(const Term &term) const
    {
      double            sum = 0;
      const std::size_t n = weights().locally_owned_size();
      for (std::size_t i = 0; i < n; ++i)
        if (owns_point(i))
          sum += term(i);
      return processes().sum(sum);
    }

    /// The same over the unknowns.
    template <typename Term>
    double sum_over_unknowns(const Term &term) const
    {
      double            sum = 0;
      const std::size_t n = load().locally_owned_size();
      for (std::size_t j = 0; j < n; ++j)
        if (shared().owns(j))
          sum += term(j);
      return processes().sum(sum);
    }

    /// The largest size of an entry on any process.
    double largest(const Vector &v) const { return processes().max(v.locally_owned_size() > 0 ? v.linfty_norm() : 0.); }

    virtual bool symmetric() const = 0; ///< a(u,v) = a(v,u)

    /// A basis of the functions on which a vanishes, the modes of a body that only contact holds; empty when a is coercive.
    virtual const std::vector<Vector> &null_space() const = 0;

    /// A basis of the rigid body modes (for a membrane the constant) that Dirichlet data leave free: the null space, and those that only
    /// springs or a reaction stop, however soft these are.
    virtual const std::vector<Vector> &rigid_body_modes() const { return null_space(); }

    virtual void apply_stiffness(Vector &Au, const Vector &u) const = 0;         ///< A u
    virtual void apply_gram(Vector &Hu, const Vector &u) const = 0;              ///< H u, the full H^m inner product
    virtual void apply_trace(Vector &Bu, const Vector &u) const = 0;             ///< B u
    virtual void apply_trace_transpose(Vector &BtWq, const Vector &q) const = 0; ///< B' W q

    /// |B| |u|, of which the last digit is what rounding leaves in Bu: components of a displacement may cancel in it.
    virtual void apply_trace_to_sizes(Vector &sizes, const Vector &u) const = 0;

    virtual const Vector &stiffness_diagonal() const = 0; ///< of A; 1 in entries fixed by Dirichlet data
    virtual const Vector &load() const = 0;               ///< f
    virtual const Vector &weights() const = 0;            ///< w > 0
    virtual const Vector &obstacle() const = 0;           ///< s

    /// Local compliance tau_i = w_i (B diag(A)^-1 B')_ii > 0: the displacement at point i per unit pressure there, elastic
    /// neighbours held. About h^2/k for a membrane, h/E for a boundary of a solid; the natural unit of a penalty parameter.
    virtual const Vector &compliance() const = 0;

    /// diag(B' W B): how much of the constraint each degree of freedom sees, n entries >= 0.
    virtual const Vector &trace_mass() const = 0;

    /// Solves (A + B' D B) x = rhs, D = diag(@p d) >= 0, starting from x, until the residual (in the norm of LinearSolve) is within
    /// @p tolerance. The factorisation or preconditioner is kept for the next call with the same d. @p Ax, where given, becomes A x.
    /// Throws std::runtime_error when the matrix is singular.
    virtual LinearSolve
    solve_tangent(const Vector &d, const Vector &rhs, const SolveTolerance &tolerance, Vector &x, Vector *Ax = nullptr) = 0;

    /// Where what each point does to each other one is known, from a factorisation: u and lambda of the problem with @p epsilon by a dense
    /// quadratic program for lambda alone. It is a start for an iteration, no result: nothing has been checked. False: not known.
    virtual bool solve_for_pressure(double /*epsilon*/, Vector & /*u*/, Vector & /*lambda*/) { return false; }

    /// A, which must be symmetric, and B for the unknowns around the boundary of the contact set @p active.
    virtual LocalRows rows_near_free_boundary(const std::vector<bool> &active) const = 0;

    virtual std::string linear_solver_name() const = 0;          ///< direct | amg | multigrid
    virtual bool        solves_exactly() const { return false; } ///< by a factorisation: an inexact solution costs the same

    /// Applications of A since construction, those inside solve_tangent included: the unit of work.
    virtual std::size_t n_operator_applications() const = 0;
  };
} // namespace unilateral
