// Commands and options as data, for completion and the manual page.
#pragma once

#include <string>
#include <vector>

namespace unilateral
{
  struct OptionDescription
  {
    std::string name;       ///< --output
    std::string short_name; ///< -o, or ""
    std::string value;      ///< what follows it, "FILE"; "" for a flag
    std::string description;
  };

  struct CommandDescription
  {
    std::string                    name;     ///< "study mesh"; "" for the program itself, whose options all commands take
    std::string                    argument; ///< "CASE", "KIND" ..., or ""
    std::string                    description;
    std::vector<OptionDescription> options;
  };

  /// The program first.
  std::vector<CommandDescription> describe_commands();

  /// Lines of at most @p width characters.
  std::string wrapped(const std::string &text, std::size_t width);
} // namespace unilateral
