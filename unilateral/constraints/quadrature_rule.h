// The points and weights of I_G, and the exactness test (14).
#pragma once

#include "unilateral/constraints/rule_name.h"

#include <deal.II/base/quadrature.h>

namespace unilateral
{
  /// The points and weights on the reference cell of dimension @p dim (the reference face of a boundary constraint has dim-1).
  /// Throws std::invalid_argument with the reason where why_rule_does_not_fit() has one.
  template <int dim>
  dealii::Quadrature<dim> quadrature_rule(const RuleName &rule, const ElementName &element);

  /// Equation (14) on the reference cell: is (q, v) = I_G(q v) for all v of the element and all q in the polynomial space that is
  /// unisolvent at the points of the rule (Q_{n-1} for n points a direction, P_k where the number of points is dim P_k)?
  /// False where no such space exists. Rules that share points between cells pair a continuous Q_h: there (14) is tested cell by cell all
  /// the same.
  template <int dim>
  bool exact_pairing(const RuleName &rule, const ElementName &element);
} // namespace unilateral
