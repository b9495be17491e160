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

  void check_writable(const std::filesystem::path &directory)
  {
    namespace fs = std::filesystem;
    const SourceLocation where{directory.string()};
    std::error_code      failure;
    fs::path             existing = fs::absolute(directory, failure).lexically_normal();
    if (fs::exists(existing, failure) && !fs::is_directory(existing, failure))
      throw InputError(where, "this is a file, so the results cannot go into a folder of that name; choose another with -o",
                       MessageName("cannot-write"));
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
} // namespace unilateral
