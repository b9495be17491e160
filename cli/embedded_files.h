// Text files that are part of the program; cmake/embed_files.cmake turns them into a source.
#pragma once

#include <string>

namespace unilateral
{
  /// @p path from the root of the sources, as it is given to embed_files().
  const char *embedded_file(const std::string &path);
} // namespace unilateral
