#include "cli/run_files.h"

#include "unilateral/base/diagnostics.h"

#include <fmt/format.h>

#include <cerrno>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <system_error>

namespace unilateral
{
  void print_results(const std::string &text)
  {
    const bool written = std::fwrite(text.data(), 1, text.size(), stdout) == text.size() && std::fflush(stdout) == 0;
    if (!written && errno != EPIPE) // who closes the pipe has read enough
      throw OutputError(fmt::format("cannot write to standard output: {}", std::strerror(errno)));
  }

  namespace
  {
    namespace fs = std::filesystem;

    void check_folder(const fs::path &directory, const SourceLocation &where)
    {
      std::error_code failure;
      fs::path        existing = fs::absolute(directory, failure).lexically_normal();
      // A name that is too long, a loop of links, a link to nowhere: there is something in the way, or there can be nothing.
      const auto missing = [&](const fs::path &path) { return fs::symlink_status(path, failure).type() == fs::file_type::not_found; };
      while (missing(existing) && existing.has_relative_path())
        existing = existing.parent_path();
      // Permissions do not tell of file systems that take no files; a folder that can be made there does.
      std::string probe = (existing / "unilateral-XXXXXX").string();
      if (!fs::is_directory(existing, failure) || mkdtemp(probe.data()) == nullptr)
        throw InputError(
          where, fmt::format("the results cannot be written, '{}' takes no new files; choose another folder with -o", existing.string()),
          MessageName("cannot-write"));
      fs::remove(probe, failure);
    }
  } // namespace

  void check_writable(const fs::path &directory)
  {
    const SourceLocation where{directory.string()};
    std::error_code      failure;
    if (fs::exists(directory, failure) && !fs::is_directory(directory, failure))
      throw InputError(where, "this is a file, so the results cannot go into a folder of that name; choose another with -o",
                       MessageName("cannot-write"));
    check_folder(directory, where);
  }

  void check_writable_file(const fs::path &file)
  {
    const SourceLocation where{file.string()};
    std::error_code      failure;
    if (fs::is_directory(file, failure))
      throw InputError(where, "this is a folder; choose the name of a file with -o", MessageName("cannot-write"));
    const fs::path folder = fs::absolute(file, failure).parent_path();
    if (!fs::is_directory(folder, failure))
      throw InputError(where, fmt::format("there is no folder '{}'; choose another with -o", folder.string()), MessageName("cannot-write"));
    check_folder(folder, where);
  }
} // namespace unilateral
