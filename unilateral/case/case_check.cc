#include "unilateral/case/case_check.h"

#include "unilateral/constraints/rule_name.h"
#include "unilateral/discretisation/regions_and_parts.h"
#include "unilateral/functions/compile_field.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
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
        const FieldFunction function = compile_field(spec, request.parameters, request.dimension > 0 ? request.dimension : 3);
        if (function.is_constant())
          return function.value(dealii::Point<1>());
      }
      catch (const InputError &)
      {
      } // problem_of() says what is wrong with it
      return {};
    }

    bool contains(const std::vector<std::string> &names, const std::string &name)
    {
      return std::find(names.begin(), names.end(), name) != names.end();
    }

    void
    check_part(const std::string &part, const SourceLocation &where, const bool all_is_one, const Case &request, Diagnostics &diagnostics)
    {
      std::vector<std::string> known = request.part_names;
      if (known.empty() || contains(known, part) || (all_is_one && part == "all"))
        return;
      if (all_is_one)
        known.push_back("all");
      diagnostics.error(where, fmt::format("the boundary has no part '{}'{}", part, suggestion_with_list(part, known, "parts")),
                        MessageName("unknown-part"));
    }

    void check_region(const MaterialSpec &material, const Case &request, Diagnostics &diagnostics)
    {
      if (!request.region_names.empty() && !material.region.empty() && !contains(request.region_names, material.region))
        diagnostics.error(material.where,
                          fmt::format("the mesh has no region '{}'{}", material.region,
                                      suggestion_with_list(material.region, request.region_names, "regions")),
                          MessageName("unknown-region"));
    }

    /// The rule must be defined on the cells (or faces) and have positive weights there.
    void check_rule(const ConstraintSpec &constraint, const Case &request, Diagnostics &diagnostics)
    {
      const auto &rule = constraint.quadrature;
      if (!rule)
        return;
      ElementName element = request.model.element;
      if (request.dimension == 0 || element.family == ElementName::Family::hermite || element.family == ElementName::Family::c0ip)
        return;
      if (request.dimension == 1)
        element.family = ElementName::Family::Q; // on segments there is no difference
      else if (element.simplex() && element.degree > 3)
        return;
      const unsigned dim = request.dimension - (constraint.on.empty() ? 0 : 1);
      if (const std::string reason = why_rule_does_not_fit(*rule, element, dim); !reason.empty())
        diagnostics.error(constraint.quadrature_where, reason, MessageName("rule-does-not-fit"));
    }

    /// A part has the condition of its own line, else that of `all`.
    bool values_are_fixed(const std::string &part, const Case &request)
    {
      const BoundarySpec *condition = nullptr;
      for (const BoundarySpec &candidate : request.boundary)
        if (candidate.part == part || (candidate.part == "all" && !condition))
          condition = &candidate;
      return condition && (condition->value ||
                           (!condition->components.empty() && std::all_of(condition->components.begin(), condition->components.end(),
                                                                          [](const auto &component) { return component.has_value(); })));
    }

    void check_element(const Case &request, Diagnostics &diagnostics)
    {
      const ElementName    &element = request.model.element;
      const SourceLocation &where = request.model.element_where;
      const std::string     known = element_names_text(request);
      const bool            for_bending = element.family == ElementName::Family::hermite || element.family == ElementName::Family::c0ip;
      if (request.bending())
      {
        const bool beam = request.model.kind == ModelSpec::Kind::beam;
        if (request.dimension > 0 && request.dimension != (beam ? 1 : 2))
          diagnostics.error(request.model.where,
                            beam ? fmt::format("a beam needs a 1-D mesh, this one is {}-D", request.dimension)
                                 : fmt::format("a plate needs a 2-D mesh, this one is {}-D", request.dimension),
                            MessageName("kind-does-not-fit"));
        if (!for_bending || (beam && element.family == ElementName::Family::c0ip))
          diagnostics.error(where,
                            fmt::format("element '{}' is not for kind = \"{}\"; known: {}", element.name(), beam ? "beam" : "plate", known),
                            MessageName("element-does-not-fit"));
        return;
      }
      if (element.family == ElementName::Family::discontinuous && request.model.kind != ModelSpec::Kind::projection)
        diagnostics.error(where,
                          fmt::format("element 'discontinuous' is for kind = \"projection\": derivatives need continuous functions; "
                                      "known: {}",
                                      known),
                          MessageName("element-does-not-fit"));
      else if (element.family == ElementName::Family::hermite || element.family == ElementName::Family::c0ip)
        diagnostics.error(where,
                          fmt::format("element '{}' is for plates and beams; {} has {}", element.name(),
                                      request.model.kind == ModelSpec::Kind::elasticity ? "an elastic body" : "a membrane", known),
                          MessageName("element-does-not-fit"));
      else if (element.family == ElementName::Family::P && element.degree > 3 && request.dimension != 1)
        diagnostics.error(where, fmt::format("there is no element '{}' on triangles and tetrahedra; known: {}", element.name(), known),
                          MessageName("element-does-not-fit"));
    }

    void check_local_refinement(const Case &request, Diagnostics &diagnostics)
    {
      const ElementName &element = request.model.element;
      if (!request.mesh.local.empty() && element.family == ElementName::Family::hermite)
        diagnostics.error(
          request.mesh.local[0].where.where,
          fmt::format("a mesh for '{}' is refined as a whole only; take c0ip2, or leave out [[mesh.local]]", element.name()),
          MessageName("element-does-not-fit"));
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

    void check_elastic_coefficients(const CoefficientSpecs &coefficients, const Case &request, Diagnostics &diagnostics)
    {
      if (coefficients.young)
        if (const auto E = constant_value(*coefficients.young, request); E && !(*E > 0))
          diagnostics.error(coefficients.young->where, fmt::format("'young' must be positive, it is {}", *E), MessageName("out-of-range"));
      if (coefficients.poisson)
        if (const auto nu = constant_value(*coefficients.poisson, request); nu && !(*nu > -1 && *nu < 0.5))
          diagnostics.error(coefficients.poisson->where,
                            fmt::format("'poisson' must lie between -1 and 1/2, it is {}{}", *nu,
                                        *nu == 0.5 ? "; a nearly incompressible material has 0.4999 at most" : ""),
                            MessageName("out-of-range"));
    }

    void check_coefficients(const CoefficientSpecs &coefficients, const Case &request, Diagnostics &diagnostics)
    {
      check_elastic_coefficients(coefficients, request, diagnostics);
      if (!coefficients.stiffness || coefficients.stiffness->empty())
        return;
      std::vector<double> k;
      for (const FieldSpec &entry : *coefficients.stiffness)
        if (const auto value = constant_value(entry, request))
          k.push_back(*value);
      const std::size_t n = coefficients.stiffness->size();
      if (k.size() == n && (n == 1 || n == 3 || n == 6) && !positive_definite(k))
        diagnostics.error(coefficients.stiffness->front().where,
                          n == 1 ? fmt::format("'{}' must be positive, it is {}", request.bending() ? "rigidity" : "stiffness", k[0])
                                 : fmt::format("'stiffness' must be positive definite, [{}] is not", fmt::join(k, ", ")),
                          MessageName("out-of-range"));
    }

    /// An elastic body has no default material: [model] gives it, or a [[material]] for every region.
    void check_young_and_poisson(const Case &request, Diagnostics &diagnostics)
    {
      if (request.model.kind != ModelSpec::Kind::elasticity)
        return;
      const auto check = [&](const char *const name, const std::optional<FieldSpec> CoefficientSpecs::*modulus)
      {
        const auto is_about_it = [&](const Diagnostic &message)
        { return message.message.find(fmt::format("'{}'", name)) != std::string::npos; };
        if (request.model.coefficients.*modulus ||
            std::any_of(diagnostics.all().begin(), diagnostics.all().end(), is_about_it)) // what is there and wrong has been said
          return;
        const bool everywhere = !request.materials.empty() &&
                                std::all_of(request.materials.begin(), request.materials.end(),
                                            [&](const MaterialSpec &material) { return (material.coefficients.*modulus).has_value(); });
        if (!everywhere || request.materials.size() < request.region_names.size())
          if (request.materials.empty() || !everywhere)
            diagnostics.error(request.model.where,
                              fmt::format("'{}' is missing in [model]{}", name, request.materials.empty() ? "" : " and in a [[material]]"),
                              MessageName("missing-key"));
      };
      check("young", &CoefficientSpecs::young);
      check("poisson", &CoefficientSpecs::poisson);
    }

    void check_constraint(const ConstraintSpec &constraint, const Case &request, Diagnostics &diagnostics)
    {
      if (!constraint.on.empty())
      {
        check_part(constraint.on, constraint.on_where, false, request, diagnostics);
        if (contains(request.part_names, constraint.on) && values_are_fixed(constraint.on, request))
          diagnostics.error(
            constraint.on_where,
            fmt::format("the values on '{}' are fixed by [boundary], so a constraint there could never act; make the part free",
                        constraint.on),
            MessageName("constraint-on-fixed-part"));
      }
      check_rule(constraint, request, diagnostics);
      if (constraint.lower && constraint.upper)
      {
        const auto lower = constant_value(*constraint.lower, request), upper = constant_value(*constraint.upper, request);
        if (lower && upper && *lower > *upper)
          diagnostics.error(constraint.lower->where,
                            fmt::format("'lower' = {} is above 'upper' = {}: no function lies between them", *lower, *upper),
                            MessageName("bounds-cross"));
      }
    }
    /// As a run does with the mesh itself: see check_functionals().
    void check_functional(const FunctionalOf<FieldSpec> &functional, const Case &request, Diagnostics &diagnostics)
    {
      if (request.part_names.empty() || request.region_names.empty())
        return; // the mesh could not be read
      const std::string reason = why_no_such_place(functional.on, functional.region, request.part_names, request.region_names);
      if (!reason.empty())
        diagnostics.error(functional.where, fmt::format("functional '{}': {}", functional.name, reason),
                          MessageName("functional-undefined"));
    }
  } // namespace

  Choice kind_names()
  {
    return {{"membrane", "elasticity", "projection", "beam", "plate"}, {}};
  }

  Choice solver_names()
  {
    return {{"auto", "direct", "amg", "multigrid"}, {}};
  }

  std::string element_names_text(const Case &request)
  {
    if (request.model.kind == ModelSpec::Kind::beam)
      return "hermite";
    if (request.model.kind == ModelSpec::Kind::plate)
      return "hermite, c0ip2, c0ip3, c0ip4, c0ip2-triangles, c0ip3-triangles";
    return request.dimension == 1 ? "Q1 to Q8, P1 to P8" : "Q1 to Q8, P1 to P3";
  }

  void check_case(const Case &request, Diagnostics &diagnostics)
  {
    check_element(request, diagnostics);
    check_local_refinement(request, diagnostics);
    check_coefficients(request.model.coefficients, request, diagnostics);
    for (const MaterialSpec &material : request.materials)
    {
      check_region(material, request, diagnostics);
      check_coefficients(material.coefficients, request, diagnostics);
    }
    check_young_and_poisson(request, diagnostics);
    const auto check_spring = [&](const FieldSpec &given, const char *const key)
    {
      if (const auto spring = constant_value(given, request); spring && *spring < 0)
        diagnostics.error(given.where, fmt::format("'{}' must not be negative, it is {}", key, *spring), MessageName("out-of-range"));
    };
    for (const BoundarySpec &condition : request.boundary)
    {
      check_part(condition.part, condition.where, true, request, diagnostics);
      if (condition.spring)
        check_spring(*condition.spring, "spring");
      if (condition.slope_spring)
        check_spring(*condition.slope_spring, "slope_spring");
      for (const FieldSpec &entry : condition.springs)
        check_spring(entry, "spring");
    }
    for (const SupportSpec &support : request.supports)
      if (support.spring)
        check_spring(*support.spring, "spring");
    for (const ConstraintSpec &constraint : request.constraints)
      check_constraint(constraint, request, diagnostics);
    for (const PeriodicSpec &pair : request.periodic)
    {
      check_part(pair.first, pair.first_where, false, request, diagnostics);
      check_part(pair.second, pair.second_where, false, request, diagnostics);
    }
    for (const auto &functional : request.functionals)
      check_functional(functional, request, diagnostics);
  }
} // namespace unilateral
