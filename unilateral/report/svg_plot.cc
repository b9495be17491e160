#include "unilateral/report/svg_plot.h"

#include "unilateral/report/html.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace unilateral
{
  namespace
  {
    constexpr double left = 92, right = 16, top = 14, bottom = 50, legend_line = 20;

    /// One direction of a plot: numbers to places.
    struct Axis
    {
      bool   log = false;
      double low = 0, high = 1, from = 0, to = 1; ///< low and high as logarithms on a logarithmic axis

      bool   shows(const double value) const { return std::isfinite(value) && (!log || value > 0); }
      double scaled(const double value) const { return log ? std::log10(value) : value; }
      double place(const double value) const { return from + (to - from) * (scaled(value) - low) / (high - low); }
    };

    std::string tick_text(const double value, const bool log)
    {
      if (!log)
        return fmt::format("{:.4g}", value == 0 ? 0. : value);
      const double exponent = std::log10(value);
      if (std::abs(exponent - std::round(exponent)) > 1e-6 || (exponent > -2.5 && exponent < 3.5))
        return fmt::format("{:g}", value);
      return fmt::format("1e{:.0f}", exponent);
    }

    std::vector<double> ticks_of(const Axis &axis, const unsigned n)
    {
      if (!axis.log)
        return round_ticks(axis.low, axis.high, n);
      std::vector<double> ticks;
      const double        decades = axis.high - axis.low;
      const int           step = std::max(1, int(std::ceil(decades / (n + 1))));
      for (int k = int(std::ceil(axis.low - 1e-9)); k <= axis.high + 1e-9; ++k)
        if (k % step == 0)
          ticks.push_back(std::pow(10., k));
      if (ticks.size() < 2)
        for (int k = int(std::floor(axis.low)); k <= axis.high; ++k)
          for (const double digit : {2., 5.})
            if (const double value = digit * std::pow(10., k); axis.scaled(value) >= axis.low && axis.scaled(value) <= axis.high)
              ticks.push_back(value);
      std::sort(ticks.begin(), ticks.end());
      return ticks;
    }

    /// @p values: all coordinates of one direction. False where there is none to be shown.
    bool set_range(Axis &axis, const std::vector<double> &values)
    {
      double low = std::numeric_limits<double>::max(), high = std::numeric_limits<double>::lowest();
      for (const double value : values)
        if (axis.shows(value))
        {
          low = std::min(low, axis.scaled(value));
          high = std::max(high, axis.scaled(value));
        }
      if (low > high)
        return false;
      const double least = axis.log ? 0.5 : std::max(1e-9 * std::max(std::abs(low), std::abs(high)), 1e-300);
      const double margin =
        std::max(0.05 * (high - low), high - low < least ? (axis.log ? 0.5 : std::max(0.5 * std::abs(low), 1e-12)) : 0.);
      axis.low = low - margin;
      axis.high = high + margin;
      return true;
    }

    std::string path_of(const PlotSeries &series, const Axis &x, const Axis &y)
    {
      std::string path;
      bool        pen_down = false;
      for (std::size_t i = 0; i < std::min(series.x.size(), series.y.size()); ++i)
      {
        const bool shown = x.shows(series.x[i]) && y.shows(series.y[i]);
        if (shown)
          path += fmt::format("{}{:.2f} {:.2f}", pen_down ? "L" : "M", x.place(series.x[i]), y.place(series.y[i]));
        pen_down = shown;
      }
      return path;
    }

    /// A triangle beside the lower end of a series that rises by @p slope: its hypotenuse has the slope.
    std::string slope_triangle(const Axis &x, const Axis &y, const PlotSeries &series, const double slope, const unsigned number)
    {
      double at_x = std::numeric_limits<double>::max(), at_y = 0;
      for (std::size_t i = 0; i < series.x.size(); ++i)
        if (x.shows(series.x[i]) && y.shows(series.y[i]) && series.x[i] < at_x)
        {
          at_x = series.x[i];
          at_y = series.y[i];
        }
      if (at_y == 0)
        return "";
      // In decades: from a fifth to half of the width, below the line by a tenth of the height and more for each further triangle.
      const double width = 0.18 * (x.high - x.low), rise = slope * width, x0 = std::log10(at_x) + 0.12 * (x.high - x.low),
                   y0 = std::max(std::log10(at_y) + slope * (x0 - std::log10(at_x)) - (0.12 + 0.16 * number) * (y.high - y.low),
                                 y.low + 0.04 * (y.high - y.low) - std::min(0., rise));
      const auto place_x = [&](const double v) { return x.place(std::pow(10., v)); };
      const auto place_y = [&](const double v) { return y.place(std::pow(10., v)); };
      return fmt::format(
        "<path class=\"slope\" d=\"M{0:.1f} {1:.1f}L{2:.1f} {1:.1f}L{2:.1f} {3:.1f}Z\"/><text class=\"slope label\" x=\"{4:.1f}\" "
        "y=\"{5:.1f}\">{6:.3g}</text>\n",
        place_x(x0), place_y(y0), place_x(x0 + width), place_y(y0 + rise), place_x(x0 + width) + 5,
        (place_y(y0) + place_y(y0 + rise)) / 2 + 4, slope);
    }

    /// As many as the longest name leaves room for.
    std::size_t legend_columns(const Plot &plot)
    {
      constexpr double line_and_space = 40, width_of_character = 7.5;
      std::size_t      longest = 1;
      for (const PlotSeries &series : plot.series)
        longest = std::max(longest, series.name.size());
      return std::clamp<std::size_t>(
        static_cast<std::size_t>((plot.width - left - right) / (line_and_space + width_of_character * double(longest))), 1, 3);
    }

    std::string axes(const Plot &plot, const Axis &x, const Axis &y)
    {
      std::string svg;
      for (const double tick : ticks_of(x, 7))
        svg += fmt::format("<path class=\"grid\" d=\"M{0:.1f} {1:.1f}V{2:.1f}\"/><text class=\"tick\" text-anchor=\"middle\" x=\"{0:.1f}\" "
                           "y=\"{3:.1f}\">{4}</text>\n",
                           x.place(tick), y.from, y.to, y.from + 18, tick_text(tick, x.log));
      for (const double tick : ticks_of(y, 6))
        svg += fmt::format("<path class=\"grid\" d=\"M{0:.1f} {1:.1f}H{2:.1f}\"/><text class=\"tick\" text-anchor=\"end\" x=\"{3:.1f}\" "
                           "y=\"{4:.1f}\">{5}</text>\n",
                           x.from, y.place(tick), x.to, x.from - 7, y.place(tick) + 4, tick_text(tick, y.log));
      svg += fmt::format("<path class=\"axis\" d=\"M{:.1f} {:.1f}V{:.1f}H{:.1f}\"/>\n", x.from, y.to, y.from, x.to);
      svg += fmt::format("<text class=\"label\" text-anchor=\"middle\" x=\"{:.1f}\" y=\"{:.1f}\">{}</text>\n", (x.from + x.to) / 2,
                         y.from + 38, escaped(plot.x_label));
      svg += fmt::format("<text class=\"label\" text-anchor=\"middle\" transform=\"translate(14 {:.1f}) rotate(-90)\">{}</text>\n",
                         (y.from + y.to) / 2, escaped(plot.y_label));
      return svg;
    }
  } // namespace

  std::vector<double> round_ticks(const double low, const double high, const unsigned n)
  {
    if (!(high > low) || !std::isfinite(high - low))
      return {low};
    const double rough = (high - low) / std::max(n, 1u), power = std::pow(10., std::floor(std::log10(rough)));
    double       step = 10 * power;
    for (const double digit : {5., 2., 1.})
      if (digit * power >= rough * 0.75)
        step = digit * power;
    std::vector<double> ticks;
    for (double k = std::ceil(low / step - 1e-9); k * step <= high + 1e-9 * step; ++k)
      ticks.push_back(k * step);
    return ticks;
  }

  std::string to_svg(const Plot &plot)
  {
    std::vector<double> all_x, all_y;
    for (const PlotSeries &series : plot.series)
      for (std::size_t i = 0; i < std::min(series.x.size(), series.y.size()); ++i)
        if (std::isfinite(series.x[i]) && std::isfinite(series.y[i]) && (!plot.x_log || series.x[i] > 0) &&
            (!plot.y_log || series.y[i] > 0))
        {
          all_x.push_back(series.x[i]);
          all_y.push_back(series.y[i]);
        }
    const bool        with_legend = plot.series.size() > 1;
    const std::size_t n_legend_columns = legend_columns(plot);
    const std::size_t n_legend_lines = (plot.series.size() + n_legend_columns - 1) / n_legend_columns;
    const double      legend_height = with_legend ? legend_line * double(n_legend_lines) : 0;
    Axis              x{.log = plot.x_log, .from = left, .to = plot.width - right},
      y{.log = plot.y_log, .from = plot.height - bottom, .to = top + legend_height};
    if (!set_range(x, all_x) || !set_range(y, all_y))
      return "";
    std::string svg = fmt::format("<svg xmlns=\"http://www.w3.org/2000/svg\" role=\"img\" viewBox=\"0 0 {} {}\"><title>{}</title>\n",
                                  plot.width, plot.height, escaped(plot.title)) +
                      axes(plot, x, y);
    if (plot.x_log && plot.y_log && !plot.series.empty())
      for (std::size_t k = 0; k < plot.slopes.size(); ++k)
        svg += slope_triangle(x, y, plot.series.front(), plot.slopes[k], unsigned(k));
    for (std::size_t k = 0; k < plot.series.size(); ++k)
    {
      const PlotSeries &series = plot.series[k];
      const std::string name = fmt::format("series-{}", k % 6);
      if (series.line)
        svg += fmt::format("<path class=\"line {}\"{} d=\"{}\"/>\n", name, series.dashed ? " stroke-dasharray=\"6 4\"" : "",
                           path_of(series, x, y));
      if (series.markers)
        for (std::size_t i = 0; i < std::min(series.x.size(), series.y.size()); ++i)
          if (x.shows(series.x[i]) && y.shows(series.y[i]))
            svg += fmt::format("<circle class=\"marker {}\" cx=\"{:.1f}\" cy=\"{:.1f}\" r=\"3.2\"><title>{}: {}, {}</title></circle>\n",
                               name, x.place(series.x[i]), y.place(series.y[i]), escaped(series.name), number_text(series.x[i]),
                               number_text(series.y[i]));
      if (with_legend)
      {
        const std::size_t legend_row = k / n_legend_columns;
        const double      at_x = left + double(k % n_legend_columns) * (plot.width - left - right) / double(n_legend_columns),
                     at_y = top + legend_line * double(legend_row);
        svg += fmt::format("<g class=\"legend\"><path class=\"line {0}\"{1} d=\"M{2:.1f} {3:.1f}h22\"/><text class=\"label\" x=\"{4:.1f}\" "
                           "y=\"{5:.1f}\">{6}</text></g>\n",
                           name, series.dashed ? " stroke-dasharray=\"6 4\"" : "", at_x, at_y, at_x + 28, at_y + 4, escaped(series.name));
      }
    }
    return svg + "</svg>\n";
  }
} // namespace unilateral
