// The inf-sup constants of a case on a sequence of refinements, and what they say about its element and rule.
#pragma once

#include "unilateral/base/progress.h"
#include "unilateral/discretisation/problem_statement.h"
#include "unilateral/output/results.h"
#include "unilateral/output/vtu_file.h"
#include "unilateral/stability/inf_sup.h"

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
      double                h = 0;   ///< diameter of the largest cell
      InfSup                all;     ///< q anywhere
      std::optional<InfSup> by_L2;   ///< q anywhere, paired by the L2 product of polynomials; where that exists and differs from I_G
      std::optional<InfSup> contact; ///< q where the solved problem has contact; empty where it was not asked for or finds none
      std::optional<InfSup> zone;    ///< q in the zone that was asked for; empty where no point lies in it
    };
    std::string                     element, quadrature, on, zone; ///< zone: the expression
    bool                            exact_pairing = false;         ///< (14)
    std::vector<Row>                rows;
    std::optional<StabilityVerdict> verdict;         ///< from the zone where there is one; absent with fewer than two levels
    std::optional<StabilityVerdict> contact_verdict; ///< the same where the solved problem has contact
    std::string                     stopped;         ///< why a finer level was left out
    VtuGrid                         lowest_mode;     ///< of the finest level and of the zone that decides: see mode_grid()
  };

  struct InfSupStudyOptions
  {
    unsigned                     n_levels = 5;
    std::optional<FieldFunction> zone = {};           ///< not 0 where q may live
    std::string                  zone_name = {};      ///< how reports call it
    bool                         with_contact = true; ///< solve the case on each level and look at its contact zone too
    bool                         with_dual_norm = true;
    InfSupLimits                 limits = {};
  };

  /// The case's own coarse mesh and up to `n_levels` levels in all, of its first constraint, as far as the limits go.
  /// Throws InputError (also for a fault in the zone, a case without a constraint, or a coarse mesh that is already too large).
  template <int dim>
  InfSupStudy
  study_inf_sup(const ProblemStatement &statement, const InfSupStudyOptions &options, Diagnostics &diagnostics, Progress &progress);

  /// A multiplier for ParaView: the cells (or faces) with the mean of their points, and the points as vertex cells with their own
  /// values; cell array "lowest_mode". The pressures that V_h feels least: where a checkerboard is possible it shows.
  template <int dim>
  VtuGrid mode_grid(const Problem<dim>        &problem,
                    const ConstraintSet<dim>  &constraint_set,
                    const std::vector<bool>   &zone,
                    const std::vector<double> &mode);

  /// The constants, rates and verdicts alone.
  nlohmann::ordered_json constants_json(const InfSupStudy &study);

  /// infsup.json: the same with a heading.
  nlohmann::ordered_json to_json(const InfSupStudy &study, const CaseSource &source);

  /// infsup.csv: a heading and a line a level and zone.
  std::string to_csv(const InfSupStudy &study);
} // namespace unilateral
