#include "unilateral/functions/raster.h"

#include "unilateral/functions/matrix_file.h"
#include "unilateral/functions/raster_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <limits>
#include <stdexcept>
#include <utility>

namespace unilateral
{
  namespace
  {
    /// A point on the edge of the domain may miss the edge of the raster by rounding, in pixels.
    constexpr double edge_tolerance = 1e-6;

    /// A text file that is told where it lies has one number a pixel; without that it must have x and y as well (XYZ).
    bool is_matrix(const std::string &file, const std::optional<Raster::Extent> &extent)
    {
      const std::string ending = std::filesystem::path(file).extension().string();
      return extent && (ending == ".csv" || ending == ".CSV" || ending == ".txt" || ending == ".dat");
    }
  } // namespace

  Raster::Raster(const std::string &file, const std::optional<Extent> &extent)
  {
    const std::string name = std::filesystem::path(file).filename().string();
    std::error_code   failure;
    const auto        status = std::filesystem::status(file, failure);
    if (!std::filesystem::exists(status))
      throw std::runtime_error(fmt::format("raster '{}' does not exist", file));
    if (!std::filesystem::is_regular_file(status))
      throw std::runtime_error(fmt::format("raster '{}' is not a file", file));
    if (is_matrix(file, extent))
    {
      NumberMatrix matrix = read_matrix(file, max_raster_pixels);
      n_columns = matrix.n_columns;
      n_rows = matrix.n_rows;
      samples = std::move(matrix.values);
    }
    else
    {
      RasterPixels pixels = read_raster_file(file, !extent);
      n_columns = pixels.n_columns;
      n_rows = pixels.n_rows;
      samples = std::move(pixels.samples);
      transform = pixels.transform;
    }

    mark_gaps();
    if (extent)
      place(*extent);
    invert_transform(name);
  }

  Raster::Raster(const std::size_t n_columns, const std::size_t n_rows, std::vector<double> samples, const Extent &extent)
    : n_columns(n_columns), n_rows(n_rows), samples(std::move(samples))
  {
    if (n_columns * n_rows != this->samples.size() || this->samples.empty())
      throw std::runtime_error(fmt::format("a raster of {} x {} samples has {} numbers", n_columns, n_rows, this->samples.size()));
    mark_gaps();
    place(extent);
    invert_transform("");
  }

  void Raster::mark_gaps()
  {
    for (double &sample : samples)
      if (!std::isfinite(sample))
      {
        sample = std::numeric_limits<double>::quiet_NaN();
        gaps = true;
      }
  }

  void Raster::place(const Extent &extent)
  {
    const auto &[lower, upper] = extent;
    transform = {lower[0], (upper[0] - lower[0]) / double(n_columns), 0, upper[1], 0, (lower[1] - upper[1]) / double(n_rows)};
  }

  void Raster::invert_transform(const std::string &name)
  {
    const double determinant = transform[1] * transform[5] - transform[2] * transform[4];
    if (!std::isfinite(determinant) || determinant == 0)
      throw std::runtime_error(fmt::format("the geotransform of raster '{}' is singular", name));
    inverse = {transform[5] / determinant, -transform[2] / determinant, -transform[4] / determinant, transform[1] / determinant};
  }

  double Raster::pixel_size() const
  {
    return std::min(std::hypot(transform[1], transform[4]), std::hypot(transform[2], transform[5]));
  }

  std::string Raster::extent_text() const
  {
    double x0 = std::numeric_limits<double>::max(), x1 = -x0, y0 = x0, y1 = -x0;
    for (const double column : {0., double(n_columns)})
      for (const double row : {0., double(n_rows)})
      {
        const double x = transform[0] + column * transform[1] + row * transform[2];
        const double y = transform[3] + column * transform[4] + row * transform[5];
        x0 = std::min(x0, x);
        x1 = std::max(x1, x);
        y0 = std::min(y0, y);
        y1 = std::max(y1, y);
      }
    const bool aligned = transform[2] == 0 && transform[4] == 0;
    return fmt::format("[[{}, {}], [{}, {}]]{}", x0, y0, x1, y1, aligned ? "" : " (turned)");
  }

  std::optional<double> Raster::sample(const double x, const double y) const
  {
    const double dx = x - transform[0], dy = y - transform[3];
    const double column = inverse[0] * dx + inverse[1] * dy, row = inverse[2] * dx + inverse[3] * dy;
    if (!(column >= -edge_tolerance && column <= double(n_columns) + edge_tolerance && row >= -edge_tolerance &&
          row <= double(n_rows) + edge_tolerance))
      throw std::domain_error("outside the raster, which covers " + extent_text());

    // Centres have half-integer coordinates.
    const double      c = std::clamp(column - 0.5, 0., double(n_columns - 1)), r = std::clamp(row - 0.5, 0., double(n_rows - 1));
    const auto        c0 = static_cast<std::size_t>(c), r0 = static_cast<std::size_t>(r);
    const double      s = c - double(c0), t = r - double(r0);
    const std::size_t c1 = std::min(c0 + 1, n_columns - 1), r1 = std::min(r0 + 1, n_rows - 1);

    double value = 0;
    // A pixel without weight need not have data.
    const auto add = [&](const double weight, const double sample)
    {
      if (weight > 0)
        value += weight * sample;
    };
    add((1 - s) * (1 - t), pixel(c0, r0));
    add(s * (1 - t), pixel(c1, r0));
    add((1 - s) * t, pixel(c0, r1));
    add(s * t, pixel(c1, r1));
    if (std::isnan(value))
      return {};
    return value;
  }
} // namespace unilateral
