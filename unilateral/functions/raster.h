// A raster file as a function of x and y.
#pragma once

#include <array>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace unilateral
{
  /// The first band of a file in one of the formats that hold their own pixels (GeoTIFF, ESRI ASCII, PNG, DTED, ...), held in memory,
  /// bilinear between pixel centres; constant in the outer half pixel, undefined beyond. The file's own band scale and offset are not
  /// applied. Of the files beside it only a header and a world file are read.
  class Raster
  {
  public:
    using Extent = std::array<std::array<double, 2>, 2>;

    /// Reads @p file and places it by its own affine geotransform (rotation and any orientation allowed) or, if given, so that the outer
    /// edges of its pixels lie on @p extent, first row at the top. With an extent a .csv, .txt or .dat file is a plain matrix of numbers.
    /// Throws std::runtime_error with the reason.
    Raster(const std::string &file, const std::optional<Extent> &extent);

    /// The same of @p samples in memory, row by row from the top; not finite: no data.
    Raster(std::size_t n_columns, std::size_t n_rows, std::vector<double> samples, const Extent &extent);

    /// The sample at (x, y), or nothing where a pixel that takes part has no data.
    /// Throws std::domain_error when the point is outside.
    std::optional<double> sample(double x, double y) const;

    double pixel_size() const; ///< the shorter side
    bool   has_gaps() const { return gaps; }

  private:
    void mark_gaps();
    void place(const Extent &extent);
    /// Throws std::runtime_error where the transform has no inverse.
    void invert_transform(const std::string &name);

    double      pixel(std::size_t column, std::size_t row) const { return samples[row * n_columns + column]; }
    std::string extent_text() const;

    std::size_t           n_columns = 0, n_rows = 0;
    std::vector<double>   samples;        ///< row by row from the file's first; NaN: no data
    std::array<double, 6> transform = {}; ///< (column, row) of pixel corners -> (x, y), GDAL's order
    std::array<double, 4> inverse = {};   ///< of the linear part
    bool                  gaps = false;
  };
} // namespace unilateral
