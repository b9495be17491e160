// A function of position and of quantities that are known only where it is evaluated.
#pragma once

#include "unilateral/base/diagnostics.h"
#include "unilateral/functions/expression.h"
#include "unilateral/functions/field_spec.h"

#include <array>
#include <functional>
#include <memory>
#include <span>
#include <string>
#include <vector>

namespace unilateral
{
  struct Integrand
  {
    /// At many points: @p quantities has for each of the names below a number per point.
    using Values = std::function<void(
      std::span<const std::array<double, 3>> points, const std::vector<std::vector<double>> &quantities, std::span<double> values)>;

    std::vector<std::string> quantities; ///< those that it uses
    Values                   values;
  };

  /// Compiles an expression in position, the parameters and any of the @p quantities.
  /// Throws InputError at the true position of the fault; a name that is both a parameter and a quantity is one.
  Integrand compile_integrand(const FieldSpec                           &spec,
                              const std::shared_ptr<CompiledParameters> &parameters,
                              const std::vector<std::string>            &quantities);
} // namespace unilateral
