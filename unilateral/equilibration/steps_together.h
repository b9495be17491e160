// Steps of several processes, any of which may find a reason to stop.
#pragma once

#include "unilateral/base/diagnostics.h"
#include "unilateral/base/processes.h"

#include <algorithm>
#include <stdexcept>
#include <string>
#include <vector>

namespace unilateral
{
  /// Does @p act; what it says where data have no value, or cells no place.
  template <typename Action>
  std::string reason_from(const Action &act)
  {
    try
    {
      act();
    }
    catch (const InputError &error)
    {
      return std::string("a bound or a coefficient has no value inside a cell: ") + error.what();
    }
    catch (const std::domain_error &error)
    {
      return error.what();
    }
    return "";
  }

  /// Of the @p own ones of all processes; empty: none has one. Collective.
  inline std::string first_reason(const std::string &own, const Processes &processes)
  {
    if (processes.alone())
      return own;
    std::vector<char> text(own.begin(), own.end());
    if (!own.empty())
      text.push_back('\n');
    const std::vector<char> all = processes.gather(text);
    return {all.begin(), std::find(all.begin(), all.end(), '\n')};
  }

  /// Unless there is a @p reason already, the same on all processes, does @p act, which may set it or throw, but sends no messages; then
  /// all learn of it. Collective.
  template <typename Action>
  void step_together(std::string &reason, const Processes &processes, const Action &act)
  {
    if (!reason.empty())
      return;
    if (const std::string thrown = reason_from(act); !thrown.empty())
      reason = thrown;
    reason = first_reason(reason, processes);
  }
} // namespace unilateral
