// Completion of commands, options, case files, keys of --set, cases of init and names of messages, for three shells.
#pragma once

#include <string>

namespace unilateral
{
  /// @p shell is bash, zsh or fish.
  std::string completion_script(const std::string &shell);
} // namespace unilateral
