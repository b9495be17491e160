// Line plots as SVG, which needs no program to be read.
#pragma once

#include <array>
#include <string>
#include <vector>

namespace unilateral
{
  struct PlotSeries
  {
    std::string         name;
    std::vector<double> x, y; ///< what is not finite, or not positive on a logarithmic axis, interrupts the line
    bool                line = true, markers = true, dashed = false;
  };

  struct Plot
  {
    std::string             title; ///< for those who do not see it
    std::string             x_label, y_label;
    bool                    x_log = false, y_log = false;
    std::vector<PlotSeries> series;

    /// Slopes shown by triangles below the first series (both axes logarithmic): y ~ x^slope.
    std::vector<double> slopes;
    unsigned            width = 720, height = 400;
  };

  /// An svg element whose colours are those of the page's style sheet (classes axis, grid, tick, label, line, series-0 to series-5, marker,
  /// slope, legend). Texts are escaped. "" where no series has a point.
  std::string to_svg(const Plot &plot);

  /// Round numbers in [low, high], about @p n of them.
  std::vector<double> round_ticks(double low, double high, unsigned n = 6);
} // namespace unilateral
