#include "unilateral/functions/integrand.h"

#include <algorithm>
#include <utility>

namespace unilateral
{
  Integrand compile_integrand(const FieldSpec                           &spec,
                              const std::shared_ptr<CompiledParameters> &parameters,
                              const std::vector<std::string>            &quantities)
  {
    if (spec.kind == FieldSpec::Kind::constant)
      return {{},
              [value = spec.value](std::span<const std::array<double, 3>>, const std::vector<std::vector<double>> &,
                                   const std::span<double> values) { std::fill(values.begin(), values.end(), value); }};
    if (spec.kind != FieldSpec::Kind::expression)
      throw InputError(spec.where, "an integrand is a number or an expression", MessageName("wrong-type"));
    const auto expression = std::make_shared<Expression>(spec, parameters, quantities);
    return {expression->used_quantities(),
            [expression](const std::span<const std::array<double, 3>> points, const std::vector<std::vector<double>> &at_points,
                         const std::span<double> values) { expression->values(points, at_points, values); }};
  }
} // namespace unilateral
