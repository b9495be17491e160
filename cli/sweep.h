// Many runs of one case, each with other values of some keys, side by side on the processors there are.
#pragma once

#include "cli/console.h"
#include "cli/options.h"

namespace unilateral
{
  /// All combinations, the first axis slowest, each a run of its own by this program, in folders step-001, ... of the sweep's. Writes
  /// sweep.csv, sweep.json and report.html. Returns the exit code: that of the worst run; when a run fails by bad input, the others
  /// still run, and its message stands in the table.
  /// Throws InputError when already the first combination is no case, and Interrupted.
  int sweep(const Options &options, Console &console);
} // namespace unilateral
