// What a process gives up before it works on a file that somebody else may have written. Linux only: seccomp, Landlock and resource limits.
// None of them needs root, and root is bound by them, too.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace unilateral
{
  struct SandboxRules
  {
    std::vector<std::string> readable; ///< files, and folders with all that is below them; links are not followed
    double                   cpu_seconds = 60;
    double                   idle_seconds = 60; ///< how long it may wait for something, using no processor; its parent sees to that
    std::uint64_t            memory = std::uint64_t(4) << 30; ///< bytes of address space beyond what the process has already
  };

  /// What the system has taken from the process.
  struct SandboxState
  {
    bool system_calls = false; ///< by seccomp: no commands, no network, no file opened for writing
    bool paths = false;        ///< by Landlock: nothing read but what the rules name, nothing written or made
    bool complete() const { return system_calls && paths; }
  };

  /// What a process in the sandbox tried, as the byte that it sends before it ends.
  enum class Violation : char
  {
    command = 'C', ///< to start another program
    writing = 'W'  ///< to open a file for writing
  };

  /// Confines this process, which must have one thread, for good: as far as the system supports it, which the result says. A violation
  /// ends the process after its byte went to @p report; whatever else is not allowed fails with an error as if permission were missing.
  SandboxState enter_sandbox(const SandboxRules &rules, int report);
} // namespace unilateral
