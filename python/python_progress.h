// How a long computation talks to Python: progress, and requests to stop.
#pragma once

#include "unilateral/base/progress.h"

#include <pybind11/pybind11.h>

#include <chrono>
#include <optional>

namespace unilateral
{
  /// Calls a callable with a dict for each finished level. Asks every 20 ms for Ctrl-C, in threads for exceptions that others have set for
  /// them, and whether `stop` says true. To be used with the GIL released.
  class PythonProgress : public Progress
  {
  public:
    PythonProgress(pybind11::object on_level, pybind11::object stop);

    void level_finished(const LevelReport &level) override;
    bool stop_requested() const override;

    /// Throws what stopped the computation, KeyboardInterrupt where nothing else did.
    [[noreturn]] void throw_reason() const;

  private:
    pybind11::object                                   on_level, stop, any_instruction;
    mutable std::chrono::steady_clock::time_point      asked = std::chrono::steady_clock::now();
    mutable std::optional<pybind11::error_already_set> reason;
    mutable bool                                       stopped = false;
  };
} // namespace unilateral
