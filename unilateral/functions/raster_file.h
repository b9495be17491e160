// The pixels of a raster file, read by GDAL.
#pragma once

#include <array>
#include <cstddef>
#include <string>
#include <vector>

namespace unilateral
{
  constexpr std::size_t max_raster_pixels = 100'000'000; ///< 800 MB in memory

  /// The first band of a raster.
  struct RasterPixels
  {
    std::size_t           n_columns = 0, n_rows = 0;
    std::vector<double>   samples;        ///< row by row from the file's first; NaN: no data
    std::array<double, 6> transform = {}; ///< (column, row) of pixel corners -> (x, y), GDAL's order
  };

  /// The pixels of @p file, and their place where @p placed_by_file. Throws std::runtime_error with the reason: not a raster of a format
  /// that is read, damaged, too large, not numbers, or without a place.
  RasterPixels read_raster_file(const std::string &file, bool placed_by_file);
} // namespace unilateral
