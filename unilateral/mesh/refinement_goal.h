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
      probe,         ///< a component of u at a probe
      reaction       ///< a component of the force with which a part of the boundary holds a body
    };

    Kind                    kind = Kind::energy;
    std::string             name = "energy"; ///< as the case file writes it
    std::size_t             number = 0;      ///< of the probe or the reaction in the results
    std::optional<unsigned> component = {};  ///< of a vector-valued u, or of the force

    bool is_a_number() const { return kind != Kind::energy; }
  };

  /// "energy", "contact_force", or a path in the results: of a probe, "solution.probes.0.value" or "solution.probes.0.value.1", or of a
  /// reaction, "balance.reactions.0.force.1"; nothing where @p text is none of these.
  std::optional<RefinementGoal> refinement_goal(const std::string &text);
} // namespace unilateral
