// A piece of work on a file from outside, done by a child process that can do little else; see sandbox.h.
#pragma once

#include "unilateral/base/sandbox.h"

#include <functional>
#include <string>

namespace unilateral
{
  /// How the work of a child process ended.
  struct ConfinedResult
  {
    enum class End
    {
      finished,      ///< with an answer
      exited,        ///< by exit() somewhere in a library, without an answer
      command,       ///< it tried to start another program
      writing,       ///< it tried to write a file
      out_of_time,   ///< of the processor, or waits for too long
      out_of_memory, ///< that its limit leaves, or killed, presumably by the system for that reason
      crashed        ///< by the signal of that number
    };
    End         end = End::crashed;
    std::string answer;
    int         signal = 0;
  };

  /// Calls @p prepare and then @p work in a child of this process, with an empty environment and no streams, @p work within the sandbox of
  /// @p rules, and returns what @p work returns. The child shares nothing with this process but a pipe, and dies with it. What they throw
  /// ends as `crashed`, but for std::bad_alloc.
  /// @p stop_requested is asked several times a second, if there is one; when it says so, the child is killed and Interrupted thrown.
  /// Throws std::runtime_error when no process can be started.
  ConfinedResult run_confined(const std::function<void()>                            &prepare,
                              const std::function<std::string(const SandboxState &)> &work,
                              const SandboxRules                                     &rules,
                              const std::function<bool()>                            &stop_requested);
} // namespace unilateral
