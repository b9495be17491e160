#pragma once

#include <chrono>

namespace unilateral
{
  /// Wall-clock seconds between laps.
  class Stopwatch
  {
  public:
    double lap()
    {
      const auto   now = std::chrono::steady_clock::now();
      const double seconds = std::chrono::duration<double>(now - start).count();
      start = now;
      return seconds;
    }

  private:
    std::chrono::steady_clock::time_point start = std::chrono::steady_clock::now();
  };
} // namespace unilateral
