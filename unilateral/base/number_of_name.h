// Names by their places in a list.
#pragma once

#include <algorithm>
#include <string>
#include <vector>

namespace unilateral
{
  /// The place of @p name in @p names, to which it is appended if it is new.
  inline unsigned number_of_name(const std::string &name, std::vector<std::string> &names)
  {
    const auto found = std::find(names.begin(), names.end(), name);
    if (found != names.end())
      return found - names.begin();
    names.push_back(name);
    return names.size() - 1;
  }
} // namespace unilateral
