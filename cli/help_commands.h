// The commands that solve nothing and help with cases: schema, init, completion, explain, and the manual pages.
#pragma once

#include "cli/init.h"
#include "cli/options.h"

#include <string>

namespace unilateral
{
  bool is_help_command(Command command);

  /// What such a command prints; `init` writes its file besides. Throws InputError for names that there are not and files that are there.
  std::string run_help_command(const Options &options, CaseWithMesh case_with_mesh);
} // namespace unilateral
