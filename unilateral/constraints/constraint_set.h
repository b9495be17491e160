// K_h: the points of I_G, their weights, the trace of V_h there and the obstacle (equations (8), (10)).
#pragma once

#include "unilateral/base/shared_unknowns.h"
#include "unilateral/constraints/quadrature_rule.h"
#include "unilateral/constraints/round_surface.h"
#include "unilateral/constraints/trace_row.h"
#include "unilateral/forms/bilinear_form.h"
#include "unilateral/functions/field_function.h"
#include "unilateral/functions/rigid_surface.h"

#include <deal.II/base/point.h>
#include <deal.II/base/types.h>
#include <deal.II/dofs/dof_handler.h>
#include <deal.II/fe/mapping.h>
#include <deal.II/lac/affine_constraints.h>

#include <memory>
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

  /// u >= bound or u <= bound, in the domain or on a boundary part, felt at the points of a rule. For a vector-valued u: u.n <= bound, or
  /// u.d <= bound with a given direction d, on a boundary part, and the bound is the gap.
  struct UnilateralCondition
  {
    Side                                      side = Side::upper;
    FieldFunction                             bound;
    std::shared_ptr<const RigidSurface>       surface;   ///< takes the place of the bound: the distance to it
    std::vector<double>                       direction; ///< d: none, or `dim` numbers of length 1
    std::optional<RoundSurface>               round;     ///< what the facets of the part stand for, which has the normals that count
    std::string                               on;        ///< name of the boundary part, empty in the domain
    std::optional<dealii::types::boundary_id> part;      ///< its id, none in the domain
    RuleName                                  rule;
    SourceLocation                            where;
  };

  /// The points of one side of one [[constraint]]: the index range [begin, end) of a ConstraintSet.
  struct ConstraintBlock
  {
    std::string on; ///< boundary part, "domain" when in the domain
    Side        side = Side::upper;
    RuleName    rule;
    bool        exact_pairing = false; ///< (14)
    std::size_t begin = 0, end = 0;
    std::size_t n_missed = 0; ///< points of the part that never meet the surface: no constraint acts there
  };

  /// A point of I_G.
  template <int dim>
  struct ConstraintPoint
  {
    dealii::Point<dim> x;
    double             weight = 0; ///< w_i > 0, summed over the cells that share the point
    double             bound = 0;  ///< psi(x_i) or the upper bound
    signed char        sign = 1;   ///< +1 upper, -1 lower
    /// A node on a cut between subdomains is a point on every process that has it; one of them owns it.
    bool owned = true;
  };

  /// K_h = { v in V_h : sign_i (v(x_i) - bound_i) <= 0 }, sign = +1 for an upper, -1 for a lower bound.
  template <int dim>
  struct ConstraintSet
  {
    std::vector<ConstraintPoint<dim>> points;
    TraceRows                         trace; ///< row i: v(x_i), without the sign
    std::vector<ConstraintBlock>      blocks;
    /// By block: the points of the part, owned by this process, that never meet the surface.
    std::vector<std::vector<dealii::Point<dim>>> missed;
    /// By point: the direction in which a vector-valued u is bounded; empty when u is scalar.
    std::vector<dealii::Tensor<1, dim>> directions;
    bool                                at_nodes_only = true; ///< one shape function lives at every point

    /// What a point has taken over from its image on a periodic part: so much of its weight acts there, on v(x) by this row.
    struct Image
    {
      std::size_t point;
      double      weight;
      TraceRow    row;
    };
    std::vector<Image> images;

    std::size_t size() const { return points.size(); }

    bool owns(const std::size_t i) const { return points[i].owned; }

    /// One shape function lives at every point: B' D B is diagonal, or a block for each node, and no trouble for any solver.
    bool at_nodes() const { return at_nodes_only; }

    /// Takes those points out.
    void remove(const std::vector<bool> &leaves);

    /// v(x_i) at every point.
    template <typename VectorType>
    std::vector<double> values_of(const VectorType &v) const
    {
      std::vector<double> values(size(), 0.);
      for (std::size_t i = 0; i < size(); ++i)
      {
        const auto row = trace[i];
        for (std::size_t k = 0; k < row.dofs.size(); ++k)
          values[i] += row.values[k] * v(row.dofs[k]);
      }
      return values;
    }
  };

  /// The constraint set of @p conditions on V_h = span of @p dof_handler. Points that cells share are merged and their weights summed;
  /// points where V_h is fixed by @p dirichlet are dropped, after a look whether the data respect the bound.
  /// On the cuts between subdomains (@p shared) the cells of all processes count.
  /// What v is at @p hanging_nodes follows from their neighbours: a point there hands its weight over to theirs, so that I_G(v) stays as it
  /// is, and is none. Where a neighbour has no point (a rule that leaves out nodes) it stays.
  /// Points on the second of two @p periodic parts are those on the first, with the weights of both; of their bounds the tighter one
  /// counts. Throws InputError when they do not, when no point meets the surface of an obstacle, when a lower bound lies above an upper
  /// one, or when a weight is not positive after that.
  template <int dim>
  ConstraintSet<dim> make_constraint_set(const std::vector<UnilateralCondition>  &conditions,
                                         const ElementName                       &element,
                                         const dealii::Mapping<dim>              &mapping,
                                         const dealii::DoFHandler<dim>           &dof_handler,
                                         const dealii::AffineConstraints<double> &dirichlet,
                                         const dealii::AffineConstraints<double> &hanging_nodes,
                                         const BilinearForm<dim>                 &form,
                                         const SharedUnknowns                    &shared = {});
} // namespace unilateral
