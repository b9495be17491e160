// Where the time of a run goes, by part.
#pragma once

#include "unilateral/base/stopwatch.h"

#include <string>
#include <utility>
#include <vector>

namespace unilateral
{
  /// Wall-clock seconds by named part, in the order of their first use. A part that runs inside another stops the clock of the outer one:
  /// no second counts twice.
  class TimeByPart
  {
  public:
    /// Counts for a part as long as it lives.
    class Running
    {
    public:
      Running(TimeByPart &times, const std::size_t part) : times(times), outer(times.switch_to(part)) {}
      ~Running() { times.switch_to(outer); }
      Running(const Running &) = delete;
      Running &operator=(const Running &) = delete;

    private:
      TimeByPart       &times;
      const std::size_t outer;
    };

    [[nodiscard]] Running run(const std::string &part) { return Running(*this, index_of(part)); }

    const std::vector<std::pair<std::string, double>> &seconds() const { return parts; }

  private:
    static constexpr std::size_t none = static_cast<std::size_t>(-1);

    std::size_t index_of(const std::string &part)
    {
      for (std::size_t k = 0; k < parts.size(); ++k)
        if (parts[k].first == part)
          return k;
      parts.emplace_back(part, 0.);
      return parts.size() - 1;
    }

    std::size_t switch_to(const std::size_t part)
    {
      const double lap = watch.lap();
      if (current != none)
        parts[current].second += lap;
      return std::exchange(current, part);
    }

    std::vector<std::pair<std::string, double>> parts;
    std::size_t                                 current = none;
    Stopwatch                                   watch;
  };
} // namespace unilateral
