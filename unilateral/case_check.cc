#include "unilateral/case_check.h"

#include "unilateral/field_function.h"
#include "unilateral/quadrature_rule.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace unilateral
{
  namespace
  {
    /// The value of a field that is the same everywhere, nothing for others and for those that are wrong.
    std::optional<double> constant_value(const FieldSpec &spec, const Case &request)
    {
      if (spec.kind == FieldSpec::Kind::constant)
        return spec.value;
      if (spec.kind != FieldSpec::Kind::expression)
        return {};
      try
      {
        const FieldFunction function(spec, request.parameters, request.dimension > 0 ? request.dimension : 3);
        if (function.is_constant())
          return function.value(dealii::Point<1>());
      }
      catch (const InputError &)
      {
      } // check_functions says what is wrong with it
      return {};
    }

    void check_part(const std::string              &part,
                    const SourceLocation           &where,
                    const std::vector<std::string> &parts,
                    const bool                      all_is_one,
                    Diagnostics                    &diagnostics)
    {
      if (parts.empty() || std::find(parts.begin(), parts.end(), part) != parts.end() || (all_is_one && part == "all"))
        return;
      std::vector<std::string> known = parts;
      if (all_is_one)
        known.push_back("all");
      const std::string nearest = did_you_mean(part, known);
      diagnostics.error(where, fmt::format("the boundary has no part '{}'{}; parts: {}", part,
                                           nearest.empty() ? "" : fmt::format("; did you mean '{}'?", nearest), fmt::join(known, ", ")));
    }

    void check_element(const Case &request, Diagnostics &diagnostics)
    {
      const ElementSpec    &element = request.model.element;
      const SourceLocation &where = request.model.element_where;
      const std::string     known = element_names_text(request.dimension);
      if (element.family == ElementSpec::Family::hermite || element.family == ElementSpec::Family::c0ip)
        diagnostics.error(
          where, fmt::format("element '{}' is for plates and beams and not available yet; a membrane has {}", element.name(), known));
      else if (element.family == ElementSpec::Family::P && element.degree > 3 && request.dimension != 1)
        diagnostics.error(where, fmt::format("there is no element '{}' on triangles and tetrahedra; known: {}", element.name(), known));
    }

    /// x' K x > 0 for the symmetric matrix whose upper triangle is @p k, by Sylvester's criterion.
    bool positive_definite(const std::vector<double> &k)
    {
      if (k.size() == 1)
        return k[0] > 0;
      if (k.size() == 3)
        return k[0] > 0 && k[0] * k[2] - k[1] * k[1] > 0;
      const double xx = k[0], xy = k[1], xz = k[2], yy = k[3], yz = k[4], zz = k[5];
      return xx > 0 && xx * yy - xy * xy > 0 && xx * (yy * zz - yz * yz) - xy * (xy * zz - yz * xz) + xz * (xy * yz - yy * xz) > 0;
    }

    void check_coefficients(const Coefficients &coefficients, const Case &request, Diagnostics &diagnostics)
    {
      if (!coefficients.stiffness || coefficients.stiffness->empty())
        return;
      std::vector<double> k;
      for (const FieldSpec &entry : *coefficients.stiffness)
        if (const auto value = constant_value(entry, request))
          k.push_back(*value);
      const std::size_t n = coefficients.stiffness->size();
      if (k.size() == n && (n == 1 || n == 3 || n == 6) && !positive_definite(k))
        diagnostics.error(coefficients.stiffness->front().where,
                          n == 1 ? fmt::format("'stiffness' must be positive, it is {}", k[0])
                                 : fmt::format("'stiffness' must be positive definite, [{}] is not", fmt::join(k, ", ")));
    }

    void
    check_constraint(const ConstraintSpec &constraint, const Case &request, const std::vector<std::string> &parts, Diagnostics &diagnostics)
    {
      if (!constraint.on.empty())
        check_part(constraint.on, constraint.on_where, parts, false, diagnostics);
      if (!constraint.quadrature.empty() && !parse_rule(constraint.quadrature))
        diagnostics.error(constraint.quadrature_where,
                          fmt::format("unknown quadrature '{}'; known: {}", constraint.quadrature, fmt::join(rule_names(), ", ")));
      if (constraint.lower && constraint.upper)
      {
        const auto lower = constant_value(*constraint.lower, request), upper = constant_value(*constraint.upper, request);
        if (lower && upper && *lower > *upper)
          diagnostics.error(constraint.lower->where,
                            fmt::format("'lower' = {} is above 'upper' = {}: no function lies between them", *lower, *upper));
      }
    }
  } // namespace

  std::vector<std::string> kind_names()
  {
    return {"membrane", "elasticity", "plate", "beam", "projection"};
  }

  std::string element_names_text(const unsigned dimension)
  {
    return dimension == 1 ? "Q1 to Q8, P1 to P8" : "Q1 to Q8, P1 to P3";
  }

  const std::vector<std::string> &result_blocks()
  {
    static const std::vector<std::string> blocks = {"mesh",   "space",       "constraint", "method", "solution",
                                                    "errors", "certificate", "solver",     "timing", "memory"};
    return blocks;
  }

  std::vector<std::string> part_names(const MeshSpec &mesh, const unsigned dimension)
  {
    static const std::array<const char *, 6> sides = {"left", "right", "bottom", "top", "front", "back"};
    switch (mesh.source)
    {
    case MeshSpec::Source::box:
      return {sides.begin(), sides.begin() + 2 * dimension};
    case MeshSpec::Source::ball:
      return {"surface"};
    case MeshSpec::Source::shell:
      return {"inner", "outer"};
    default:
      return {};
    }
  }

  void check_case(const Case &request, Diagnostics &diagnostics)
  {
    const std::vector<std::string> parts = part_names(request.mesh, request.dimension);
    check_element(request, diagnostics);
    check_coefficients(request.model.coefficients, request, diagnostics);
    for (const MaterialSpec &material : request.materials)
      check_coefficients(material.coefficients, request, diagnostics);
    for (const BoundarySpec &condition : request.boundary)
    {
      check_part(condition.part, condition.where, parts, true, diagnostics);
      if (condition.spring)
        if (const auto spring = constant_value(*condition.spring, request); spring && *spring < 0)
          diagnostics.error(condition.spring->where, fmt::format("'spring' must not be negative, it is {}", *spring));
    }
    for (const ConstraintSpec &constraint : request.constraints)
      check_constraint(constraint, request, parts, diagnostics);
  }
} // namespace unilateral
