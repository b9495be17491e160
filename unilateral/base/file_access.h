// What the one who starts the program has to say about the files that cases name.
#pragma once

#include <functional>
#include <string>

namespace unilateral
{
  struct FileAccess
  {
    bool                  allow_scripts = false; ///< run Gmsh scripts even where the system cannot confine them
    std::function<bool()> stop_requested;        ///< asked several times a second while another process reads a file; may be empty
    bool                  read_ahead = false;    ///< a mesh is made next: its cells may be kept where they come along with its names

    /// Where several processes read the same files at the same time: what @p read returns on the first of them, which alone calls it.
    /// Empty: each process reads.
    std::function<std::string(const std::function<std::string()> &read)> by_first_process = nullptr;
  };

  /// Of this process, as set_file_access() was told last; at first no scripts without a sandbox, and nobody who asks to stop.
  const FileAccess &file_access();

  /// Before the first file is read.
  void set_file_access(FileAccess access);
} // namespace unilateral
