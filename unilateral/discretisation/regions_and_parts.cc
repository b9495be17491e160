#include "unilateral/discretisation/regions_and_parts.h"

#include <fmt/format.h>

#include <algorithm>

namespace unilateral
{
  std::optional<unsigned> find_name(const std::vector<std::string> &names, const std::string &name)
  {
    const auto it = std::find(names.begin(), names.end(), name);
    if (it == names.end())
      return {};
    return static_cast<unsigned>(it - names.begin());
  }

  std::vector<Coefficients>
  coefficients_by_region(const ProblemStatement &statement, const std::vector<std::string> &region_names, Diagnostics &diagnostics)
  {
    std::vector<Coefficients> result(region_names.size(), statement.model.coefficients);
    for (const auto &material : statement.materials)
    {
      const auto region = find_name(region_names, material.region);
      if (!region)
      {
        diagnostics.error(
          material.where,
          fmt::format("the mesh has no region '{}'{}", material.region, suggestion_with_list(material.region, region_names, "regions")),
          MessageName("unknown-region"));
        continue;
      }
      const auto override_with = [](auto &own, const auto &given)
      {
        if (given)
          own = given;
      };
      Coefficients &coefficients = result[*region];
      override_with(coefficients.stiffness, material.coefficients.stiffness);
      override_with(coefficients.velocity, material.coefficients.velocity);
      override_with(coefficients.reaction, material.coefficients.reaction);
      override_with(coefficients.young, material.coefficients.young);
      override_with(coefficients.poisson, material.coefficients.poisson);
      override_with(coefficients.thickness, material.coefficients.thickness);
      override_with(coefficients.load, material.coefficients.load);
    }
    return result;
  }

  std::vector<PartCondition>
  conditions_by_part(const ProblemStatement &statement, const std::vector<std::string> &part_names, Diagnostics &diagnostics)
  {
    std::vector<PartCondition> result(part_names.size());
    const auto                 periodic = [&](const std::string &part)
    {
      return std::any_of(statement.periodic.begin(), statement.periodic.end(),
                         [&](const auto &pair) { return pair.first == part || pair.second == part; });
    };
    for (const auto &spec : statement.boundary)
      if (spec.part == "all")
        for (std::size_t part = 0; part < result.size(); ++part)
          if (!periodic(part_names[part]))
            static_cast<BoundaryCondition &>(result[part]) = spec;
    for (const auto &spec : statement.boundary)
      if (spec.part != "all")
      {
        if (const auto part = find_name(part_names, spec.part))
        {
          static_cast<BoundaryCondition &>(result[*part]) = spec;
          result[*part].named = true;
        }
        else
          diagnostics.error(spec.where,
                            fmt::format("the boundary has no part '{}'{}", spec.part, suggestion_with_list(spec.part, part_names, "parts")),
                            MessageName("unknown-part"));
      }
    return result;
  }

  std::vector<PeriodicPair>
  periodic_pairs(const ProblemStatement &statement, const std::vector<std::string> &part_names, Diagnostics &diagnostics)
  {
    std::vector<PeriodicPair> result;
    for (const auto &spec : statement.periodic)
    {
      const auto part = [&](const std::string &name, const SourceLocation &where)
      {
        const auto found = find_name(part_names, name);
        if (!found)
          diagnostics.error(where, fmt::format("the boundary has no part '{}'{}", name, suggestion_with_list(name, part_names, "parts")),
                            MessageName("unknown-part"));
        return found;
      };
      const auto   first = part(spec.first, spec.first_where), second = part(spec.second, spec.second_where);
      PeriodicPair pair{first.value_or(0), second.value_or(0), {}, spec.first, spec.second, spec.where};
      for (const auto &component : spec.jump)
        pair.jump.push_back(component.is_constant() ? component.value(dealii::Point<1>()) : 0.); // see check_couplings()
      if (first && second)
        result.push_back(std::move(pair));
    }
    return result;
  }

  std::string why_no_such_place(const std::string              &on,
                                const std::string              &region,
                                const std::vector<std::string> &part_names,
                                const std::vector<std::string> &region_names)
  {
    const bool in_domain = on == "domain";
    if (!region.empty() && !in_domain)
      return fmt::format("'on' = \"{}\" is a part of the boundary, and 'region' a part of the domain; give one of them", on);
    if (!region.empty() && !find_name(region_names, region))
      return fmt::format("the mesh has no region '{}'{}", region, suggestion_with_list(region, region_names, "regions"));
    if (!in_domain && !find_name(part_names, on))
      return fmt::format("the boundary has no part '{}'{}", on, suggestion_with_list(on, part_names, "parts"));
    return "";
  }

  namespace
  {
    void check_periodic_parts(const ProblemStatement &statement, Diagnostics &diagnostics)
    {
      if (statement.periodic.empty())
        return;
      const SourceLocation &where = statement.periodic[0].where;
      if (statement.bending() || statement.model.kind == ModelChoices::Kind::projection)
        diagnostics.error(where, "periodic parts are for membranes and elastic bodies", MessageName("kind-does-not-fit"));
      if (statement.mesh.adapt)
        diagnostics.error(where,
                          "periodic parts need the same mesh on both, and mesh.adapt refines each by its own error; take mesh.refine or "
                          "[[mesh.local]], the same on both",
                          MessageName("contradiction"));
      for (const auto &pair : statement.periodic)
      {
        if (pair.first == pair.second)
          diagnostics.error(pair.second_where, fmt::format("'{}' cannot be periodic with itself", pair.first),
                            MessageName("contradiction"));
        for (const auto &component : pair.jump)
          if (!component.is_constant())
            diagnostics.error(component.where(), "'jump' must be constant: u on one part is u on the other plus the jump",
                              MessageName("contradiction"));
        for (const auto &other : statement.periodic)
          if (&other < &pair)
            for (const auto &[part, place] : {std::pair(pair.first, pair.first_where), std::pair(pair.second, pair.second_where)})
              if (part == other.first || part == other.second)
                diagnostics.error(place, fmt::format("'{}' belongs to two periodic pairs", part), MessageName("contradiction"));
        for (const auto &condition : statement.boundary)
          if (condition.part == pair.first || condition.part == pair.second)
            diagnostics.error(
              condition.where,
              fmt::format("'{}' is a periodic part: nothing acts there but the next period; leave it out of [boundary]", condition.part),
              MessageName("contradiction"));
        for (const auto &constraint : statement.constraints)
          if (!constraint.on.empty() && (constraint.on == pair.first || constraint.on == pair.second))
            diagnostics.error(constraint.on_where,
                              fmt::format("'{}' is a periodic part, where the body goes on: no constraint acts there", constraint.on),
                              MessageName("contradiction"));
      }
    }

    void check_rigid_part(const BoundaryCondition &condition, const ProblemStatement &statement, Diagnostics &diagnostics)
    {
      if (condition.part == "all")
        diagnostics.error(condition.where, "'all' cannot be rigid: every part would have a platen of its own; name the parts",
                          MessageName("contradiction"));
      for (const auto *motions : {&condition.components, &condition.rotations})
        for (const auto &motion : *motions)
          if (motion && !motion->is_constant())
            diagnostics.error(motion->where(),
                              fmt::format("the motion of the rigid part '{}' must be constant: x, y, z and rotation are those of the "
                                          "platen as a whole",
                                          condition.part),
                              MessageName("contradiction"));
      for (const auto &constraint : statement.constraints)
        if (constraint.on == condition.part)
          diagnostics.error(
            constraint.on_where,
            fmt::format("the part '{}' is bonded to a rigid platen and cannot touch anything; let another part touch", constraint.on),
            MessageName("constraint-on-fixed-part"));
    }
  } // namespace

  void check_couplings(const ProblemStatement &statement, Diagnostics &diagnostics)
  {
    check_periodic_parts(statement, diagnostics);
    for (const auto &condition : statement.boundary)
      if (condition.rigid)
        check_rigid_part(condition, statement, diagnostics);
  }
} // namespace unilateral
