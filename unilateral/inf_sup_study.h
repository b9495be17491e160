// The inf-sup constants of a case on a sequence of refinements, and what they say about its element and rule.
#pragma once

#include "unilateral/case.h"
#include "unilateral/inf_sup.h"
#include "unilateral/progress.h"

#include <nlohmann/json_fwd.hpp>

#include <optional>
#include <string>
#include <vector>

namespace unilateral
{
  struct InfSupStudy
  {
    struct Row
    {
      unsigned              level = 0;
      double                h = 0; ///< largest cell diameter over sqrt(dim): the side of a square cell
      InfSup                all;   ///< q anywhere
      std::optional<InfSup> zone;  ///< q in the zone that was asked for; empty where no point lies in it
    };
    std::string                     element, quadrature, on, zone; ///< zone: the expression
    bool                            exact_pairing = false;         ///< (14)
    std::vector<Row>                rows;
    std::optional<StabilityVerdict> verdict; ///< from the zone where there is one; absent with fewer than two levels
    std::string                     stopped; ///< why a finer level was left out
  };

  /// The case's own coarse mesh and up to @p n_levels refinements in all, of its first constraint, as far as dense matrices go.
  /// @p zone: an expression in x y z and the case's parameters that is not 0 where q may live, e.g. "x > 1/3 && x < 2/3"; "" for none.
  /// Throws InputError (also for a fault in @p zone, a case without a constraint, or a coarse mesh that is already too large).
  template <int dim>
  InfSupStudy study_inf_sup(const Case &request, unsigned n_levels, const std::string &zone, Diagnostics &diagnostics, Progress &progress);

  /// infsup.json.
  nlohmann::ordered_json to_json(const InfSupStudy &study, const Case &request);

  /// infsup.csv: a heading and a line a level.
  std::string to_csv(const InfSupStudy &study);
} // namespace unilateral
