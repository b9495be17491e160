// What the tolerance of adaptive refinement is of.
#pragma once

#include <cstddef>
#include <optional>
#include <string>

namespace unilateral
{
  struct RefinementGoal
  {
    enum class Kind
    {
      energy,        ///< the error in the energy norm
      contact_force, ///< sum of w_i lambda_i over all constraints
      probe          ///< a component of u at a probe
    };

    Kind                    kind = Kind::energy;
    std::string             name = "energy"; ///< as the case file writes it
    std::size_t             probe = 0;
    std::optional<unsigned> component = {}; ///< of a vector-valued u

    bool is_a_number() const { return kind != Kind::energy; }
  };

  /// "energy", "contact_force", or the path of a probe in the results, "solution.probes.0.value" or "solution.probes.0.value.1"; nothing
  /// where @p text is none of these.
  std::optional<RefinementGoal> refinement_goal(const std::string &text);
} // namespace unilateral
