// The command `expand`, which both programs have.
#pragma once

#include "cli/options.h"

#include "unilateral/case/case.h"

namespace unilateral
{
  /// The case with every default filled in goes to standard output. Returns the exit code; throws OutputError.
  int expand(const Options &options, const Case &request);
} // namespace unilateral
