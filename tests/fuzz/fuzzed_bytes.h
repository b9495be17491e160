// What the fuzzers make of the bytes that libFuzzer gives them.
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <string>

#include <sys/mman.h>
#include <sys/types.h>
#include <unistd.h>

namespace fuzzed
{
  inline std::string text(const std::uint8_t *bytes, const std::size_t size)
  {
    return {reinterpret_cast<const char *>(bytes), size};
  }

  /// The path of a file in memory with these bytes, the same file each time.
  inline std::string file(const std::uint8_t *bytes, const std::size_t size)
  {
    static const int number = memfd_create("fuzzed", 0);
    if (number < 0 || ftruncate(number, 0) != 0 || pwrite(number, bytes, size, 0) != static_cast<ssize_t>(size))
      std::abort();
    return "/proc/self/fd/" + std::to_string(number);
  }

  /// A condition that must hold for whatever is read: libFuzzer reports the bytes for which it does not.
  inline void require(const bool condition)
  {
    if (!condition)
      std::abort();
  }
} // namespace fuzzed
