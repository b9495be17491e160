// Files and standard output of a command.
#pragma once

#include <filesystem>
#include <stdexcept>
#include <string>

namespace unilateral
{
  /// The machine, not the program, is at fault: disk full, no permission.
  class OutputError : public std::runtime_error
  {
    using std::runtime_error::runtime_error;
  };

  /// Results on standard output; a full disk must not pass for success. Throws OutputError.
  void print_results(const std::string &text);

  /// Calls @p action; what it throws about files becomes an OutputError.
  template <typename Action>
  void write_files(const Action &action)
  {
    try
    {
      action();
    }
    catch (const std::runtime_error &e)
    {
      throw OutputError(e.what());
    }
  }

  /// Before hours of work: can the results be written to @p directory? Leaves nothing behind. Throws InputError.
  void check_writable(const std::filesystem::path &directory);

  /// The same of a file that is to be written.
  void check_writable_file(const std::filesystem::path &file);
} // namespace unilateral
