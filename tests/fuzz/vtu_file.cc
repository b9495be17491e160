// The grids that a run has written, which another run may take as fields: what is read fits together.
#include "fuzzed_bytes.h"

#include "unilateral/base/diagnostics.h"
#include "unilateral/output/vtu_reader.h"

#include <cstdint>

namespace
{
  void require_lengths(const std::vector<unilateral::VtuArray> &arrays, const std::size_t n)
  {
    for (const auto &array : arrays)
      std::visit([&](const auto &values) { fuzzed::require(values.size() == n * array.n_components); }, array.values);
  }
} // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t *bytes, const std::size_t size)
{
  try
  {
    const unilateral::VtuGrid grid = unilateral::read_vtu(fuzzed::file(bytes, size));
    fuzzed::require(grid.offsets.size() == grid.cell_types.size());
    std::int32_t begin = 0;
    for (const std::int32_t end : grid.offsets)
    {
      fuzzed::require(begin <= end && static_cast<std::size_t>(end) <= grid.connectivity.size());
      begin = end;
    }
    for (const std::int32_t point : grid.connectivity)
      fuzzed::require(point >= 0 && static_cast<std::size_t>(point) < grid.points.size());
    require_lengths(grid.point_arrays, grid.points.size());
    require_lengths(grid.cell_arrays, grid.cell_types.size());
  }
  catch (const unilateral::InputError &)
  {
  }
  return 0;
}
