#include "unilateral/equilibration/sampled_data.h"

#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <vector>

namespace unilateral
{
  namespace
  {
    bool has_samples(const FieldFunction &function)
    {
      return function.sample_spacing() > 0;
    }

    bool has_samples(const std::optional<FieldFunction> &function)
    {
      return function && has_samples(*function);
    }

    template <typename Function>
    bool has_samples(const std::vector<Function> &functions)
    {
      return std::any_of(functions.begin(), functions.end(), [](const Function &function) { return has_samples(function); });
    }

    bool has_samples(const std::optional<std::vector<FieldFunction>> &functions)
    {
      return functions && has_samples(*functions);
    }

    bool has_samples(const Coefficients &c)
    {
      return has_samples(c.stiffness) || has_samples(c.reaction) || has_samples(c.young) || has_samples(c.poisson) ||
             has_samples(c.thickness) || has_samples(c.load);
    }
  } // namespace

  std::string data_known_at_samples(const ProblemStatement &statement)
  {
    if (has_samples(statement.model.coefficients) ||
        std::any_of(statement.materials.begin(), statement.materials.end(), [](const Material &m) { return has_samples(m.coefficients); }))
      return "the load or a coefficient is known at samples only";
    for (const BoundaryCondition &c : statement.boundary)
      if (has_samples(c.value) || has_samples(c.flux) || has_samples(c.spring) || has_samples(c.components) || has_samples(c.traction) ||
          has_samples(c.pressure) || has_samples(c.springs))
        return fmt::format("what [boundary] says of '{}' is known at samples only", c.part);
    return "";
  }
} // namespace unilateral
