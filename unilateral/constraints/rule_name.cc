#include "unilateral/constraints/rule_name.h"

#include "unilateral/base/diagnostics.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <regex>

namespace unilateral
{
  std::string RuleName::name() const
  {
    switch (family)
    {
    case Family::nodal:
      return "nodal";
    case Family::gauss:
      return fmt::format("gauss({})", n);
    case Family::lobatto:
      return fmt::format("lobatto({})", n);
    case Family::midpoint:
      return "midpoint";
    case Family::trapezoid:
      return "trapezoid";
    case Family::simpson:
      return "simpson";
    case Family::edges:
      return "edges";
    }
    return "";
  }

  namespace
  {
    constexpr unsigned most_points = 20;

    unsigned fewest_points(const RuleName::Family family)
    {
      return family == RuleName::Family::lobatto ? 2 : 1; // Lobatto's rules have both end points
    }

    /// gauss(n) or lobatto(n), whatever n; 0 stands for what is negative, a million for what is beyond.
    std::optional<RuleName> parse_numbered_rule(const std::string &name)
    {
      std::smatch             match;
      static const std::regex with_number(R"(\s*(gauss|lobatto)\s*\(\s*(-?\d+)\s*\)\s*)");
      if (name.size() > 100 || !std::regex_match(name, match, with_number))
        return {};
      const std::string digits = match[2];
      const unsigned    n = digits[0] == '-' ? 0 : digits.size() > 6 ? 1'000'000 : std::stoul(digits);
      return RuleName{match[1] == "gauss" ? RuleName::Family::gauss : RuleName::Family::lobatto, n};
    }
  } // namespace

  std::optional<RuleName> parse_rule(const std::string &name)
  {
    using Family = RuleName::Family;
    for (const auto family : {Family::nodal, Family::midpoint, Family::trapezoid, Family::simpson, Family::edges})
      if (RuleName{family, 0}.name() == name)
        return RuleName{family, 0};

    const auto numbered = parse_numbered_rule(name);
    if (!numbered || numbered->n < fewest_points(numbered->family) || numbered->n > most_points)
      return {};
    return numbered;
  }

  std::string why_no_rule(const std::string &name)
  {
    if (const auto numbered = parse_numbered_rule(name))
      return fmt::format("there is no rule '{}': n of {}(n) must lie between {} and {}", name,
                         numbered->family == RuleName::Family::gauss ? "gauss" : "lobatto", fewest_points(numbered->family), most_points);
    return fmt::format(
      "unknown quadrature '{}'{}", name,
      suggestion_with_list(name, {"nodal", "gauss(n)", "lobatto(n)", "midpoint", "trapezoid", "simpson", "edges"}, "known"));
  }

  RuleName default_rule(const ElementName &element, unsigned dim)
  {
    using Family = RuleName::Family;
    if (element.family == ElementName::Family::discontinuous)
      return {Family::gauss, 2};
    if (element.family == ElementName::Family::c0ip)
      return {Family::trapezoid, 0};
    if (!element.simplex() || dim <= 1 || element.degree == 1)
      return {Family::nodal, 0};
    if (element.degree == 2)
      return {Family::edges, 0};
    return {dim == 2 ? Family::nodal : Family::edges, 0};
  }

  unsigned n_points_1d(const RuleName &rule, const ElementName &element)
  {
    using Family = RuleName::Family;
    switch (rule.family)
    {
    case Family::nodal:
      // Hermite elements have their values at the vertices.
      return element.family == ElementName::Family::discontinuous || element.family == ElementName::Family::hermite ? 2
                                                                                                                    : element.degree + 1;
    case Family::gauss:
    case Family::lobatto:
      return rule.n;
    case Family::midpoint:
      return 1;
    case Family::trapezoid:
      return 2;
    case Family::simpson:
    case Family::edges:
      return 3;
    }
    return 0;
  }

  namespace
  {
    /// Of the weights that integrate polynomials of a degree exactly by their values at the nodes of that degree on a simplex.
    enum class SmallestWeight
    {
      negative,
      zero,
      positive
    };

    SmallestWeight smallest_nodal_weight(const unsigned degree, const unsigned dim)
    {
      constexpr unsigned most = 8;
      using enum SmallestWeight;
      static constexpr std::array<std::array<SmallestWeight, most>, 3> by_degree = {
        {{positive, positive, positive, positive, positive, positive, positive, negative},
         {positive, zero, positive, negative, positive, negative, negative, negative},
         {positive, negative, zero, negative, negative, negative, negative, negative}}};
      return by_degree.at(dim - 1).at(std::clamp(degree, 1u, most) - 1);
    }

    /// The reason without the name of the rule before it.
    std::string why_not_on_simplex(const RuleName &rule, const ElementName &element, const unsigned dim)
    {
      using Family = RuleName::Family;
      if (rule.family == Family::nodal)
      {
        const SmallestWeight smallest = smallest_nodal_weight(element.degree, dim);
        const std::string    remedy =
          fmt::format("; a rule with positive weights for {} is '{}'", element.name(), default_rule(element, dim).name());
        if (smallest == SmallestWeight::negative)
          return fmt::format("has negative weights on {}: the penalty term would not be monotone and Theorem 1 would fail{}",
                             element.name(), remedy);
        if (smallest == SmallestWeight::zero)
          return fmt::format("has zero weights on {}: the constraint would not be felt at those points{}", element.name(), remedy);
      }
      if (dim > 1 && rule.family == Family::gauss && rule.n > 4)
        return "is not available on triangles and tetrahedra; the largest is gauss(4)";
      if (dim > 1 && rule.family == Family::lobatto)
        return "is not defined on triangles and tetrahedra; use nodal, edges or gauss(n)";
      if (dim > 1 && rule.family == Family::simpson)
        return "is not defined on triangles and tetrahedra; use edges, nodal or gauss(n)";
      return "";
    }
  } // namespace

  std::string why_rule_does_not_fit(const RuleName &rule, const ElementName &element, const unsigned dim)
  {
    if (dim == 0)
      return ""; // the end point of a segment: whatever the rule, the value there
    const std::string reason = element.simplex() ? why_not_on_simplex(rule, element, dim)
                               : rule.family == RuleName::Family::edges
                                 ? "is defined on triangles and tetrahedra only; use nodal or simpson"
                                 : "";
    return reason.empty() ? "" : fmt::format("the rule '{}' {}", rule.name(), reason);
  }
} // namespace unilateral
