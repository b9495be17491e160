// STL files, text and binary: what is read has triangles, and all coordinates are finite.
#include "fuzzed_bytes.h"

#include "unilateral/functions/stl_file.h"

#include <cmath>
#include <stdexcept>

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t *bytes, const std::size_t size)
{
  try
  {
    const auto triangles = unilateral::read_stl(fuzzed::file(bytes, size));
    fuzzed::require(!triangles.empty());
    for (const auto &triangle : triangles)
      for (const auto &vertex : triangle)
        for (const double coordinate : vertex)
          fuzzed::require(std::isfinite(coordinate));
  }
  catch (const std::runtime_error &)
  {
  }
  return 0;
}
