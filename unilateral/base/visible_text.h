// Text from outside, names in a case or a file of somebody else, as it may be shown to people.
#pragma once

#include <string>

namespace unilateral
{
  /// @p text with what a terminal would obey, or what would make it look like something else, written out, "\x1b" or "\u202e": control
  /// characters, line ends among them, marks that turn the direction of writing, and bytes that are no UTF-8. What is left is one line.
  std::string visible(const std::string &text);

  /// The same, but for the line ends, which stay: for text of several lines whose names are visible() already.
  std::string visible_lines(const std::string &text);
} // namespace unilateral
