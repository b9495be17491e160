#include "unilateral/case/box_sides.h"

#include "unilateral/mesh/make_outline.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>

namespace unilateral
{
  void use_names_of_mesh(Case &request, Diagnostics &diagnostics)
  {
    if (request.mesh.source != MeshDescription::Source::box)
      return;
    static const std::array<std::string, 6> directions = {"x-", "x+", "y-", "y+", "z-", "z+"};

    const auto sides = box_part_names(std::min(request.dimension, 3u));
    const auto rename = [&](std::string &part)
    {
      const auto k = std::size_t(std::find(directions.begin(), directions.end(), part) - directions.begin());
      const bool is_taken =
        std::any_of(request.mesh.parts.begin(), request.mesh.parts.end(), [&](const auto &other) { return other.name == part; });
      if (k >= sides.size() || is_taken)
        return false;
      part = sides[k];
      return true;
    };
    for (auto &condition : request.boundary)
      if (const std::string written = condition.part; rename(condition.part))
        for (const auto &other : request.boundary)
          if (&other != &condition && other.part == condition.part)
            diagnostics.error(condition.where,
                              fmt::format("'{}' and '{}' are the same side of the box; keep one of them", written, other.part),
                              MessageName("contradiction"));
    for (auto &constraint : request.constraints)
      rename(constraint.on);
    for (auto &pair : request.periodic)
      for (std::string *const part : {&pair.first, &pair.second})
        rename(*part);
    for (auto &functional : request.functionals)
      rename(functional.on);
  }
} // namespace unilateral
