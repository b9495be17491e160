// The rules I_G by name, and which of them goes with an element. The points and weights are in quadrature_rule.h: names need no deal.II.
#pragma once

#include "unilateral/spaces/element.h"

#include <optional>
#include <string>

namespace unilateral
{
  /// A rule's name as in the case file: nodal, gauss(n), lobatto(n), midpoint, trapezoid, simpson, edges.
  struct RuleName
  {
    enum class Family
    {
      nodal,     ///< the element's own support points; of Hermite elements the vertices
      gauss,     ///< n points a direction; simplices: the symmetric rule of degree 2n-1
      lobatto,   ///< n points a direction, end points included
      midpoint,  ///< the centre
      trapezoid, ///< the vertices
      simpson,   ///< three points a direction
      edges      ///< simplices: the midpoints of the edges, equal weights
    };
    Family   family = Family::nodal;
    unsigned n = 0; ///< of gauss(n), lobatto(n)

    std::string name() const;
  };

  /// The rule called @p name, or nothing.
  std::optional<RuleName> parse_rule(const std::string &name);

  /// What is wrong with a name that parse_rule() does not know, and what there is instead.
  std::string why_no_rule(const std::string &name);

  /// A stable rule with positive weights for the element: gauss(2) for discontinuous, trapezoid (the vertices) for c0ip, nodal where it has
  /// them (Q_p, P1, P2 on segments, P3 on triangles), else edges (P2, and P3 on tetrahedra).
  RuleName default_rule(const ElementName &element, unsigned dim);

  /// Points a direction of a tensor rule; of `nodal`, those of the element, 2 on a discontinuous one.
  unsigned n_points_1d(const RuleName &rule, const ElementName &element);

  /// Why the rule cannot be taken on the reference cell of dimension @p dim; empty where it can: it is not defined for the cell kind, n is
  /// out of range, or a weight is not positive (negative ones break the monotonicity behind Theorem 1, zero ones leave the point free).
  std::string why_rule_does_not_fit(const RuleName &rule, const ElementName &element, unsigned dim);
} // namespace unilateral
