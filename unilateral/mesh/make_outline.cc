#include "unilateral/mesh/make_outline.h"

#include "unilateral/mesh/cell_list.h"
#include "unilateral/mesh/gmsh_file.h"

#include <fmt/format.h>

#include <algorithm>

namespace unilateral
{
  MeshOutline mesh_outline(const MeshDescription &spec)
  {
    MeshOutline outline;
    outline.region_names = {"domain"};
    switch (spec.source)
    {
    case MeshDescription::Source::none:
      throw InputError(spec.where, "no mesh; add [mesh] with one of box, ball, shell, file", MessageName("missing-key"));
    case MeshDescription::Source::box:
      outline.dimension = spec.box_lower.size();
      outline.part_names = box_part_names(std::min(outline.dimension, 3u));
      break;
    case MeshDescription::Source::ball:
      outline.dimension = spec.center.size();
      outline.part_names = {"surface"};
      break;
    case MeshDescription::Source::shell:
      outline.dimension = spec.center.size();
      outline.part_names = {"inner", "outer"};
      break;
    case MeshDescription::Source::file:
      outline = gmsh_outline(spec);
      break;
    case MeshDescription::Source::cells:
      outline = outline_of(*spec.cell_list);
      break;
    }
    if (outline.dimension < 1 || outline.dimension > 3)
      throw InputError(spec.where, fmt::format("the mesh has dimension {}; it must be 1, 2 or 3", outline.dimension),
                       MessageName("out-of-range"));
    return outline;
  }

  std::vector<std::string> box_part_names(const unsigned dim)
  {
    static const std::array<const char *, 6> names = {"left", "right", "bottom", "top", "front", "back"};
    return {names.begin(), names.begin() + 2 * dim};
  }
} // namespace unilateral
