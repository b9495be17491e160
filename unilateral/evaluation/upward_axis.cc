#include "unilateral/evaluation/upward_axis.h"

#include <deal.II/base/point.h>

#include <algorithm>
#include <optional>

namespace unilateral
{
  namespace
  {
    std::optional<unsigned> axis_of_weight(const std::optional<std::vector<FieldFunction>> &load)
    {
      std::optional<unsigned> axis;
      for (unsigned d = 0; load && d < load->size(); ++d)
      {
        const FieldFunction &component = (*load)[d];
        if (component.is_zero())
          continue;
        if (axis || !component.is_constant() || !(component.value(dealii::Point<3>()) < 0))
          return {};
        axis = d;
      }
      return axis;
    }
  } // namespace

  unsigned upward_axis(const ProblemStatement &statement)
  {
    constexpr unsigned y = 1, z = 2;
    if (statement.elastic())
    {
      if (const auto axis = axis_of_weight(statement.model.coefficients.load))
        return *axis;
      for (const auto &material : statement.materials)
        if (const auto axis = axis_of_weight(material.coefficients.load))
          return *axis;
    }
    if (statement.mesh.source != MeshDescription::Source::box)
      return z;
    const auto touches = [&](const char *const side)
    {
      return std::any_of(statement.constraints.begin(), statement.constraints.end(),
                         [side](const auto &constraint) { return constraint.on == side; });
    };
    return (touches("front") || touches("back")) && !touches("bottom") && !touches("top") ? z : y;
  }
} // namespace unilateral
