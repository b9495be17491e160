#include "unilateral/report/image.h"

#include "unilateral/report/triangle_normal.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

#include <png.h>

namespace unilateral
{
  namespace
  {
    // Nine of the colours of viridis (van der Walt and Smith 2015, CC0); linear between them.
    constexpr std::array<std::array<double, 3>, 9> viridis = {{{68, 1, 84},
                                                               {71, 44, 122},
                                                               {59, 81, 139},
                                                               {44, 113, 142},
                                                               {33, 144, 141},
                                                               {39, 173, 129},
                                                               {92, 200, 99},
                                                               {170, 220, 50},
                                                               {253, 231, 37}}};

    constexpr std::array<std::uint8_t, 3> grey = {160, 160, 160}, pale = {206, 216, 228};

    // From the front, a little from the right, 28 degrees above the horizon.
    const double azimuth = 0.6, elevation = 0.49;

    /// Light from the upper left behind the eye; both sides alike.
    double light_on(const std::array<double, 3> &normal)
    {
      return 0.62 + 0.38 * std::abs(-0.35 * normal[0] + 0.45 * normal[1] + 0.82 * normal[2]);
    }
  } // namespace

  std::array<std::uint8_t, 3> colour_of(const double part)
  {
    const double                at = std::clamp(part, 0., 1.) * (viridis.size() - 1);
    const std::size_t           k = std::min<std::size_t>(std::size_t(at), viridis.size() - 2);
    std::array<std::uint8_t, 3> colour{};
    for (unsigned c = 0; c < 3; ++c)
      colour[c] = std::uint8_t(std::lround(viridis[k][c] + (at - double(k)) * (viridis[k + 1][c] - viridis[k][c])));
    return colour;
  }

  Image::Image(const unsigned width, const unsigned height, const View view, const unsigned upward_axis)
    : width(width), height(height), view(view), upward_axis(upward_axis),
      depth(std::size_t(width) * height, std::numeric_limits<float>::lowest()), rgba(std::size_t(width) * height * 4, 0)
  {
  }

  /// To the right, up, and towards the eye.
  std::array<double, 3> Image::seen(const std::array<float, 3> &x) const
  {
    if (view == View::top)
      return {x[0], x[1], x[2]};
    // To the right, away, and up before the eye is lifted and goes to the right.
    const std::array<double, 3> a = upward_axis == 0   ? std::array<double, 3>{x[1], x[2], x[0]}
                                    : upward_axis == 1 ? std::array<double, 3>{x[0], -x[2], x[1]}
                                                       : std::array<double, 3>{x[0], x[1], x[2]};
    const double across = std::cos(azimuth) * a[0] + std::sin(azimuth) * a[1], away = -std::sin(azimuth) * a[0] + std::cos(azimuth) * a[1];
    return {across, std::sin(elevation) * away + std::cos(elevation) * a[2], -std::cos(elevation) * away + std::sin(elevation) * a[2]};
  }

  void Image::fit(const Points &points)
  {
    std::array<double, 3> low{}, high{};
    low.fill(std::numeric_limits<double>::max());
    high.fill(std::numeric_limits<double>::lowest());
    for (const auto &x : points)
    {
      const auto at = seen(x);
      for (unsigned d = 0; d < 3; ++d)
        if (std::isfinite(at[d]))
        {
          low[d] = std::min(low[d], at[d]);
          high[d] = std::max(high[d], at[d]);
        }
    }
    const double across = std::max(high[0] - low[0], 1e-30), up = std::max(high[1] - low[1], 1e-30);
    scale = 0.96 * std::min(width / across, height / up);
    shift_x = width / 2. - scale * (low[0] + high[0]) / 2;
    shift_y = height / 2. + scale * (low[1] + high[1]) / 2;
    depth_of_field = std::max(high[2] - low[2], 1e-30);
  }

  template <typename Shade>
  void Image::fill(const std::array<std::array<double, 3>, 3> &corners, const Shade &shade)
  {
    std::array<double, 3> x{}, y{};
    for (unsigned k = 0; k < 3; ++k)
    {
      x[k] = shift_x + scale * corners[k][0];
      y[k] = shift_y - scale * corners[k][1];
      if (!std::isfinite(x[k]) || !std::isfinite(y[k]))
        return;
    }
    const double area = (x[1] - x[0]) * (y[2] - y[0]) - (x[2] - x[0]) * (y[1] - y[0]);
    if (area == 0)
      return;
    const int first_x = std::max(0, int(std::floor(std::min({x[0], x[1], x[2]})))),
              last_x = std::min(int(width) - 1, int(std::ceil(std::max({x[0], x[1], x[2]})))),
              first_y = std::max(0, int(std::floor(std::min({y[0], y[1], y[2]})))),
              last_y = std::min(int(height) - 1, int(std::ceil(std::max({y[0], y[1], y[2]}))));
    for (int j = first_y; j <= last_y; ++j)
      for (int i = first_x; i <= last_x; ++i)
      {
        const double px = i + 0.5, py = j + 0.5;
        const double b1 = ((px - x[0]) * (y[2] - y[0]) - (x[2] - x[0]) * (py - y[0])) / area,
                     b2 = ((x[1] - x[0]) * (py - y[0]) - (px - x[0]) * (y[1] - y[0])) / area, b0 = 1 - b1 - b2;
        if (b0 < -1e-6 || b1 < -1e-6 || b2 < -1e-6)
          continue;
        const std::size_t pixel = std::size_t(j) * width + i;
        shade(pixel, float(b0 * corners[0][2] + b1 * corners[1][2] + b2 * corners[2][2]), b0, b1, b2);
      }
  }

  void Image::draw(const Points             &points,
                   const Triangles          &triangles,
                   const std::vector<float> &values,
                   const double              low,
                   const double              high,
                   const bool                zero_is_pale)
  {
    for (const auto &triangle : triangles)
    {
      const std::array<std::array<double, 3>, 3> corners = {seen(points[triangle[0]]), seen(points[triangle[1]]),
                                                            seen(points[triangle[2]])};
      const double                               light = light_on(unit_normal(corners));
      fill(
        corners,
        [&](const std::size_t pixel, const float z, const double b0, const double b1, const double b2)
        {
          if (z <= depth[pixel])
            return;
          depth[pixel] = z;
          const std::array<double, 3> b = {b0, b1, b2};
          double                      value = 0, touching = 0;
          for (unsigned k = 0; k < 3; ++k)
          {
            value += b[k] * values[triangle[k]];
            touching += !zero_is_pale || values[triangle[k]] != 0 ? b[k] : 0.;
          }
          // At the rim of a contact colours go over into pale ones, and not through all of those below.
          value /= zero_is_pale && touching > 0 ? touching : 1;
          const auto   colour = std::isfinite(value) ? colour_of(high > low ? (value - low) / (high - low) : 0) : grey;
          const double share = !zero_is_pale || !std::isfinite(value) ? 1 : high > 0 ? touching * std::clamp(12 * value / high, 0., 1.) : 0;
          for (unsigned c = 0; c < 3; ++c)
            rgba[4 * pixel + c] = std::uint8_t(light * (share * colour[c] + (1 - share) * pale[c]));
          rgba[4 * pixel + 3] = 255;
        });
    }
  }

  void Image::dab(const double x, const double y, const double z, const double radius, const Colour &colour)
  {
    const int first_x = std::max(0, int(std::floor(x - radius))), last_x = std::min(int(width) - 1, int(std::floor(x + radius))),
              first_y = std::max(0, int(std::floor(y - radius))), last_y = std::min(int(height) - 1, int(std::floor(y + radius)));
    for (int j = first_y; j <= last_y; ++j)
      for (int i = first_x; i <= last_x; ++i)
      {
        const std::size_t pixel = std::size_t(j) * width + i;
        // What lies in a surface is seen; at its rim the depth changes within a pixel.
        if (std::hypot(i + 0.5 - x, j + 0.5 - y) > radius || z < depth[pixel] - 5e-3 * depth_of_field)
          continue;
        std::copy(colour.begin(), colour.end(), rgba.begin() + std::ptrdiff_t(4 * pixel));
        rgba[4 * pixel + 3] = 255;
      }
  }

  void Image::draw_lines(const Points                                    &points,
                         const std::vector<std::array<std::uint32_t, 2>> &lines,
                         const double                                     line_width,
                         const Colour                                    &colour)
  {
    for (const auto &line : lines)
    {
      const auto   a = seen(points[line[0]]), b = seen(points[line[1]]);
      const double length = scale * std::hypot(b[0] - a[0], b[1] - a[1]);
      if (!std::isfinite(length))
        continue;
      const int n = 1 + int(std::min(2 * length, 1e4));
      for (int k = 0; k <= n; ++k)
      {
        const double part = double(k) / n;
        dab(shift_x + scale * (a[0] + part * (b[0] - a[0])), shift_y - scale * (a[1] + part * (b[1] - a[1])), a[2] + part * (b[2] - a[2]),
            line_width / 2, colour);
      }
    }
  }

  void Image::draw_dots(const Points &points, const double diameter, const Colour &colour)
  {
    for (const auto &point : points)
      if (const auto x = seen(point); std::isfinite(x[0] + x[1] + x[2]))
        dab(shift_x + scale * x[0], shift_y - scale * x[1], x[2], diameter / 2, colour);
  }

  void Image::draw_translucent(const Sheet &sheet, const Triangles &triangles)
  {
    // What touches lies at the same depth: it belongs to the surface that was drawn first.
    const float        least = float(2e-3 * depth_of_field);
    std::vector<float> nearest(depth.size(), std::numeric_limits<float>::lowest());
    std::vector<float> light_at(depth.size(), 0.F);
    for (const auto &triangle : triangles)
    {
      if (sheet.hidden[triangle[0]] || sheet.hidden[triangle[1]] || sheet.hidden[triangle[2]])
        continue;
      const std::array<std::array<double, 3>, 3> corners = {seen(sheet.points[triangle[0]]), seen(sheet.points[triangle[1]]),
                                                            seen(sheet.points[triangle[2]])};
      const auto                                 light = float(light_on(unit_normal(corners)));
      fill(corners,
           [&](const std::size_t pixel, const float z, double, double, double)
           {
             if (z > nearest[pixel])
             {
               nearest[pixel] = z;
               light_at[pixel] = light;
             }
           });
    }
    for (std::size_t pixel = 0; pixel < depth.size(); ++pixel)
      if (light_at[pixel] > 0 && nearest[pixel] > depth[pixel] + (rgba[4 * pixel + 3] > 0 ? least : 0.F))
      {
        const double opacity = 0.3, below = rgba[4 * pixel + 3] / 255., all = opacity + (1 - opacity) * below;
        for (unsigned c = 0; c < 3; ++c)
          rgba[4 * pixel + c] = std::uint8_t((opacity * 150 * light_at[pixel] + (1 - opacity) * below * rgba[4 * pixel + c]) / all);
        rgba[4 * pixel + 3] = std::uint8_t(255 * all);
      }
  }

  std::string Image::png() const
  {
    png_image header{};
    header.version = PNG_IMAGE_VERSION;
    header.width = width;
    header.height = height;
    header.format = PNG_FORMAT_RGBA;
    header.flags = PNG_IMAGE_FLAG_FAST;
    png_alloc_size_t size = PNG_IMAGE_PNG_SIZE_MAX(header);
    std::string      bytes(size, 0);
    if (!png_image_write_to_memory(&header, bytes.data(), &size, 0, rgba.data(), 0, nullptr))
      throw std::runtime_error("the picture cannot be written as PNG");
    bytes.resize(size);
    return bytes;
  }
} // namespace unilateral
