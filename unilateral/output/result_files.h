// How files of results come into their folder: whole or not at all, and those of one run together.
#pragma once

#include "unilateral/base/processes.h"

#include <functional>
#include <ostream>
#include <string>

namespace unilateral
{
  /// Writes @p content to a new file beside @p path, which then takes its name: whoever looks sees the old file or the new one, never a
  /// part of it. A link at @p path is replaced, not followed. Throws std::runtime_error naming the path and the system's reason; nothing is
  /// left behind then.
  void write_file_atomically(const std::string &path, const std::string &content);

  /// The same from a function that writes to a stream.
  void write_file_atomically(const std::string &path, const std::function<void(std::ostream &)> &writer);

  /// @p text as an entry of a CSV file (RFC 4180): in quotes where it has commas, quotes or line breaks.
  std::string csv_text(const std::string &text);

  /// The files of one run. They are written to a new folder inside that of the results and move up all at once, by publish(). What is not
  /// published goes with the object; what a process that was killed has left goes when the next one comes. One folder for all processes
  /// of a run, which must see the same files.
  class ResultFiles
  {
  public:
    /// Makes the folder @p directory if it is not there. Collective. Throws std::runtime_error with the system's reason.
    explicit ResultFiles(const std::string &directory, const Processes &processes = {});
    ~ResultFiles();
    ResultFiles(const ResultFiles &) = delete;
    ResultFiles &operator=(const ResultFiles &) = delete;

    /// Where a file called @p name is to be written.
    std::string path_of(const std::string &name) const { return staging + "/" + name; }
    /// The folder of these paths.
    const std::string &folder() const { return staging; }

    /// Puts the files in their places. First those of the same names go, and others in the folder of the results that are @p superseded;
    /// @p last comes last, so that a folder that has it is complete. Collective. Throws std::runtime_error; nothing has changed then
    /// unless the system refuses to rename.
    void publish(const std::string &last, const std::function<bool(const std::string &name)> &superseded = {});

  private:
    void remove_own() noexcept;

    std::string directory, staging;
    Processes   processes;
    int         lock = -1; ///< held as long as the folder is in use, on the first process
  };
} // namespace unilateral
