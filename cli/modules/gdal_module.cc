// unilateral-gdal.so: see cli/file_readers.h.
#include "unilateral/functions/raster_file.h"

extern "C" void unilateral_read_raster_file(const std::string &file, const bool placed_by_file, unilateral::RasterPixels &pixels)
{
  pixels = unilateral::read_raster_file(file, placed_by_file);
}
