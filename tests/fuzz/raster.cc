// Rasters. GDAL reads the file; it is a library that is not compiled with sanitizers, so what is looked for is what we make of it.
#include "fuzzed_bytes.h"

#include "unilateral/functions/raster.h"

#include <stdexcept>

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t *bytes, const std::size_t size)
{
  try
  {
    const unilateral::Raster::Extent extent = {{{-1, -2}, {3, 4}}};
    const unilateral::Raster         placed(fuzzed::file(bytes, size), extent);
    for (const double x : {-1., 0.25, 3.})
      for (const double y : {-2., 0.75, 4.})
        placed.sample(x, y);
    const unilateral::Raster raster(fuzzed::file(bytes, size), {});
    raster.pixel_size();
    for (const double x : {-1e300, 0., 0.5, 1e300})
      raster.sample(x, -x);
  }
  catch (const std::domain_error &)
  {
  }
  catch (const std::runtime_error &)
  {
  }
  return 0;
}
