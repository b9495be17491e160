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
    for (const auto &spec : statement.boundary)
      if (spec.part == "all")
        for (auto &condition : result)
          static_cast<BoundaryCondition &>(condition) = spec;
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
} // namespace unilateral
