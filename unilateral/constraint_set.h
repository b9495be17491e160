// K_h: the points of I_G, their weights, the trace of V_h there and the obstacle (equations (8), (10)).
#pragma once

#include "unilateral/case.h"
#include "unilateral/field_function.h"
#include "unilateral/quadrature_rule.h"

#include <deal.II/base/point.h>
#include <deal.II/base/types.h>
#include <deal.II/dofs/dof_handler.h>
#include <deal.II/fe/mapping.h>
#include <deal.II/lac/affine_constraints.h>

#include <string>
#include <vector>

namespace unilateral
{
  /// Which side of u a bound is on.
  enum class Side
  {
    lower, ///< u >= bound
    upper  ///< u <= bound
  };

  /// u >= bound or u <= bound, in the domain or on a boundary part, felt at the points of a rule.
  struct UnilateralCondition
  {
    Side                                      side = Side::upper;
    FieldFunction                             bound;
    std::string                               on;   ///< name of the boundary part, empty in the domain
    std::optional<dealii::types::boundary_id> part; ///< its id, none in the domain
    RuleName                                  rule;
    SourceLocation                            where;
  };

  /// A row of the trace: the value of u at a point as a combination of degrees of freedom.
  struct TraceRow
  {
    std::vector<dealii::types::global_dof_index> dofs;
    std::vector<double>                          values;
  };

  /// The points of one side of one [[constraint]]: the index range [begin, end) of a ConstraintSet.
  struct ConstraintBlock
  {
    std::string on; ///< boundary part, "domain" when in the domain
    Side        side = Side::upper;
    RuleName    rule;
    bool        exact_pairing = false; ///< (14)
    std::size_t begin = 0, end = 0;
  };

  /// K_h = { v in V_h : sign_i (v(x_i) - bound_i) <= 0 }, sign = +1 for an upper, -1 for a lower bound.
  template <int dim>
  struct ConstraintSet
  {
    std::vector<dealii::Point<dim>> points;  ///< x_i
    std::vector<double>             weights; ///< w_i > 0, summed over the cells that share the point
    std::vector<TraceRow>           trace;   ///< row i: v(x_i), without the sign
    std::vector<double>             bound;   ///< psi(x_i) or the upper bound
    std::vector<double>             sign;    ///< +1 upper, -1 lower
    std::vector<ConstraintBlock>    blocks;

    std::size_t size() const { return points.size(); }

    /// Every point sees one degree of freedom: B' D B is diagonal and no trouble for any solver.
    bool at_nodes() const;

    /// v(x_i) at every point.
    template <typename VectorType>
    std::vector<double> values_of(const VectorType &v) const
    {
      std::vector<double> values(size(), 0.);
      for (std::size_t i = 0; i < size(); ++i)
        for (std::size_t k = 0; k < trace[i].dofs.size(); ++k)
          values[i] += trace[i].values[k] * v(trace[i].dofs[k]);
      return values;
    }
  };

  /// The constraint set of @p conditions on V_h = span of @p dof_handler. Points that cells share are merged and their weights summed;
  /// points where V_h is fixed by @p dirichlet are dropped, after a look whether the data respect the bound.
  /// Throws InputError when they do not, or when a lower bound lies above an upper one.
  template <int dim>
  ConstraintSet<dim> make_constraint_set(const std::vector<UnilateralCondition>  &conditions,
                                         const ElementSpec                       &element,
                                         const dealii::Mapping<dim>              &mapping,
                                         const dealii::DoFHandler<dim>           &dof_handler,
                                         const dealii::AffineConstraints<double> &dirichlet);
} // namespace unilateral
