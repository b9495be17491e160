// What a study shows of its solves.
#pragma once

#include "unilateral/base/progress.h"

#include <fmt/format.h>

#include <optional>
#include <string>
#include <utility>

namespace unilateral
{
  /// Every solve goes through the coarse levels again; a study that solves often shows of each the finest level only. The others are
  /// lines of the log.
  class FinestLevelProgress : public Progress
  {
  public:
    /// @p finest: the level that is shown; empty: none, for a solve that only prepares or compares. @p variant: LevelReport::variant.
    FinestLevelProgress(Progress &outer, const std::optional<unsigned> finest, std::string variant = "")
      : outer(outer), finest(finest), variant(std::move(variant))
    {
    }

    void phase(const std::string &name, const std::string &detail = "") override { outer.phase(name, detail); }
    void fraction(const double share) override { outer.fraction(share); }
    void newton_step(const NewtonStep &step) override { outer.newton_step(step); }
    void log(const std::string &line) override { outer.log(line); }
    bool stop_requested() const override { return outer.stop_requested(); }

    void level_finished(const LevelReport &level) override
    {
      if (finest && level.level >= *finest)
      {
        LevelReport shown = level;
        shown.variant = variant;
        outer.level_finished(shown);
      }
      else
        outer.log(fmt::format("level {}: {} unknowns, {} Newton steps, {} active, residual {:.1e}, {:.2f} s{}", level.level, level.n_dofs,
                              level.newton_iterations, level.n_active, level.residual, level.seconds,
                              level.converged ? "" : "; not converged: " + level.reason));
    }

  private:
    Progress               &outer;
    std::optional<unsigned> finest;
    std::string             variant;
  };
} // namespace unilateral
