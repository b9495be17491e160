#include "unilateral/report/picture.h"

#include "unilateral/base/diagnostics.h"
#include "unilateral/report/feature_edges.h"
#include "unilateral/report/html.h"
#include "unilateral/report/image.h"
#include "unilateral/report/section.h"
#include "unilateral/report/svg_plot.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <limits>
#include <sstream>
#include <stdexcept>

#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

namespace unilateral
{
  namespace
  {
    // What a page has in its own style sheet.
    constexpr const char *style =
      "<style>text{font-family:'DejaVu Sans',Arial,sans-serif;font-size:13px;fill:#222}.tick{font-size:12px;fill:#444}"
      ".grid{stroke:#ddd;fill:none}.axis{stroke:#444;fill:none}.line{fill:none;stroke-width:2}.marker{stroke:none}"
      ".line.series-0{stroke:#0072b2}.line.series-1{stroke:#d55e00}.line.series-2{stroke:#009e73}.line.series-3{stroke:#cc79a7}"
      ".line.series-4{stroke:#e69f00}.line.series-5{stroke:#56b4e9}.marker.series-0{fill:#0072b2}.marker.series-1{fill:#d55e00}"
      ".marker.series-2{fill:#009e73}.marker.series-3{fill:#cc79a7}.marker.series-4{fill:#e69f00}.marker.series-5{fill:#56b4e9}</style>";

    constexpr double margin = 16, scale_width = 96;

    const Scene::Field &field_for(const Scene &scene, const std::string &name)
    {
      if (!name.empty())
      {
        if (const auto *const field = scene.find(name))
          return *field;
        std::vector<std::string> names;
        for (const auto &field : scene.fields)
          names.push_back(field.name);
        throw InputError({"--field", 0, 0}, fmt::format("the results have no field '{}'{}", name, suggestion(name, names)),
                         MessageName("unknown-choice"));
      }
      const Scene::Field *best = nullptr;
      for (const auto &field : scene.fields)
        if (field.name.starts_with("contact_pressure") && (!best || field.max > best->max))
          best = &field;
      if (const auto *const stress = scene.find("von_mises"); stress && (scene.vector || !best))
        best = stress;
      if (!best || best->max == best->min)
        best = scene.find("u");
      return best ? *best : scene.fields.front();
    }

    std::vector<float> sizes_of(const Scene::Field &field)
    {
      if (field.n_components == 1)
        return field.values;
      std::vector<float> sizes;
      for (std::size_t i = 0; i + field.n_components <= field.values.size(); i += field.n_components)
        sizes.push_back(std::hypot(field.values[i], field.values[i + 1], field.n_components > 2 ? field.values[i + 2] : 0.F));
      return sizes;
    }

    double extent_of(const Scene &scene)
    {
      double extent = 0;
      for (unsigned d = 0; d < 3; ++d)
      {
        const auto [low, high] =
          std::minmax_element(scene.points.begin(), scene.points.end(), [&](const auto &a, const auto &b) { return a[d] < b[d]; });
        extent = std::max(extent, double((*high)[d] - (*low)[d]));
      }
      return extent;
    }

    /// The factor of heights: 1 where u is of the size of the mesh, else so that its range is a third of that.
    double height_factor(const Scene &scene, const Scene::Field &u)
    {
      const double extent = extent_of(scene), range = double(u.max) - u.min;
      return range > 0 && (range > 0.8 * extent || range < 0.15 * extent) ? 0.3 * extent / range : 1;
    }

    struct Placed
    {
      std::vector<std::array<float, 3>> points;
      std::vector<Image::Sheet>         bounds;   ///< obstacles of membranes
      std::vector<std::array<float, 3>> obstacle; ///< of bodies, at the points of I_G
      std::string                       note;     ///< how far it is exaggerated
      bool                              flat = false;
    };

    /// The obstacle of a body where the constraint has it: a point of I_G may go so far along its direction as u does plus the gap.
    /// Displacements are multiplied by @p factor. Points that are farther away than the body is large are left out.
    std::vector<std::array<float, 3>> obstacle_of_body(const Scene &scene, const double factor)
    {
      const auto                       &cloud = scene.cloud;
      const double                      farthest = extent_of(scene) / 2;
      std::vector<std::array<float, 3>> points;
      for (std::size_t i = 0; i < std::min(cloud.u_along.size(), cloud.direction.size()); ++i)
      {
        const double way = factor * (double(cloud.u_along[i]) + cloud.gap[i]);
        if (!(std::abs(way) < farthest)) // or not a number
          continue;
        points.push_back(cloud.points[i]);
        for (unsigned d = 0; d < 3; ++d)
          points.back()[d] += float(way * cloud.direction[i][d]);
      }
      return points;
    }

    /// Where the points are shown.
    Placed placed(const Scene &scene)
    {
      Placed            result{.points = scene.points, .bounds = {}, .obstacle = {}, .note = {}};
      const auto *const u = scene.find("u");
      if (!u)
        return result;
      if (scene.vector)
      {
        const double factor = deformation_factor(scene);
        for (std::size_t i = 0; i < result.points.size(); ++i)
          for (unsigned d = 0; d < 3; ++d)
            result.points[i][d] += float(factor * u->values[u->n_components * i + d]);
        result.note = factor == 1 ? "displacements to scale" : fmt::format("displacements × {:.3g}", factor);
        result.flat = scene.dimension == 2;
        result.obstacle = obstacle_of_body(scene, factor);
        if (result.flat)
          result.note += "; thin line: the body without load";
        if (!result.obstacle.empty())
          result.note += "; dots: the obstacle";
      }
      else if (scene.dimension == 2)
      {
        const double factor = height_factor(scene, *u), range = std::max(double(u->max) - u->min, 1e-300);
        for (std::size_t i = 0; i < result.points.size(); ++i)
          result.points[i][2] = float(factor * u->values[i]);
        result.note = factor == 1 ? "height u, to scale" : fmt::format("height {:.3g} u", factor);
        for (const auto &field : scene.fields)
          if (field.name.starts_with("lower") || field.name.starts_with("upper"))
          {
            Image::Sheet sheet{.points = scene.points, .hidden = {}};
            for (std::size_t i = 0; i < sheet.points.size(); ++i)
            {
              const float bound = field.values[i];
              sheet.hidden.push_back(!(std::abs(bound) < std::numeric_limits<float>::max()) || bound > u->max + range ||
                                     bound < u->min - range);
              sheet.points[i][2] = sheet.hidden.back() ? 0.F : float(factor * bound);
            }
            result.bounds.push_back(std::move(sheet));
          }
      }
      return result;
    }

    std::string colour_scale(const Scene::Field &field, const double x, const double y, const double height)
    {
      std::string svg = fmt::format("<text class=\"label\" text-anchor=\"end\" x=\"{:.0f}\" y=\"{:.0f}\">{}</text>\n", x + scale_width - 18,
                                    y - 12, escaped(field.name));
      const int   steps = 64;
      for (int k = 0; k < steps; ++k)
      {
        const auto colour = colour_of((k + 0.5) / steps);
        svg += fmt::format("<rect x=\"{:.1f}\" y=\"{:.2f}\" width=\"16\" height=\"{:.2f}\" fill=\"#{:02x}{:02x}{:02x}\"/>", x,
                           y + height * (1 - double(k + 1) / steps), height / steps + 0.6, colour[0], colour[1], colour[2]);
      }
      svg += '\n';
      for (const double tick : round_ticks(field.min, field.max, 6))
        if (field.max > field.min)
          svg += fmt::format("<text class=\"tick\" x=\"{:.1f}\" y=\"{:.1f}\">{:.4g}</text>\n", x + 22,
                             y + height * (1 - (tick - field.min) / (field.max - field.min)) + 4, tick == 0 ? 0. : tick);
      return svg;
    }

    std::string svg_head(const unsigned width, const unsigned height, const std::string &title, const bool standalone)
    {
      return fmt::format("<svg xmlns=\"http://www.w3.org/2000/svg\" role=\"img\" viewBox=\"0 0 {0} {1}\"{2}><title>{3}</title>\n{4}", width,
                         height, standalone ? fmt::format(" width=\"{}\" height=\"{}\"", width, height) : "", escaped(title),
                         standalone ? fmt::format("{}<rect width=\"100%\" height=\"100%\" fill=\"#fff\"/>\n", style) : "");
    }

    /// The inside of an svg element, moved.
    std::string nested(const std::string &svg, const double y)
    {
      const std::size_t begin = svg.find("<title>"), end = svg.rfind("</svg>");
      return begin == std::string::npos ? "" : fmt::format("<g transform=\"translate(0 {})\">{}</g>\n", y, svg.substr(begin, end - begin));
    }

    /// Of bodies and in space: the pressure at the points of I_G over the coordinate in which the contact extends farthest.
    std::string cloud_svg(const Scene &scene)
    {
      const auto &cloud = scene.cloud;
      unsigned    along = 0;
      double      farthest = -1;
      for (unsigned d = 0; d < scene.dimension; ++d)
      {
        double low = std::numeric_limits<double>::max(), high = std::numeric_limits<double>::lowest();
        for (std::size_t i = 0; i < cloud.points.size(); ++i)
          if (cloud.active[i])
          {
            low = std::min<double>(low, cloud.points[i][d]);
            high = std::max<double>(high, cloud.points[i][d]);
          }
        if (high - low > farthest)
        {
          farthest = high - low;
          along = d;
        }
      }
      if (farthest < 0)
        return "";
      Plot       plot{.title = "Contact pressure at the integration points",
                      .x_label = fmt::format("{} of the point", "xyz"[along]),
                      .y_label = "contact pressure",
                      .series = {},
                      .slopes = {},
                      .height = 320};
      PlotSeries series{.name = "pressure", .x = {}, .y = {}, .line = false};
      for (std::size_t i = 0; i < cloud.points.size() && series.x.size() < 3000; ++i)
        if (cloud.active[i])
        {
          series.x.push_back(cloud.points[i][along]);
          series.y.push_back(cloud.pressure[i]);
        }
      plot.series.push_back(std::move(series));
      return to_svg(plot);
    }

    /// The file goes with the object.
    struct ScratchFolder
    {
      ScratchFolder() : path((std::filesystem::temp_directory_path() / "unilateral-picture-XXXXXX").string())
      {
        if (!mkdtemp(path.data()))
          throw std::runtime_error("no folder for temporary files can be made; set TMPDIR to one that takes files");
      }
      ~ScratchFolder()
      {
        std::error_code ignored;
        std::filesystem::remove_all(path, ignored);
      }
      ScratchFolder(const ScratchFolder &) = delete;
      ScratchFolder &operator=(const ScratchFolder &) = delete;
      std::string    path;
    };
  } // namespace

  double deformation_factor(const Scene &scene)
  {
    const auto *const u = scene.find("u");
    const double      extent = extent_of(scene);
    if (!scene.vector || !u || !(u->max > 0) || !(extent > 0) || u->max > 0.02 * extent)
      return 1;
    // One significant digit: 1, 2, 5, 10, ...
    const double factor = 0.08 * extent / u->max, power = std::pow(10., std::floor(std::log10(factor)));
    return power * (factor >= 5 * power ? 5 : factor >= 2 * power ? 2 : 1);
  }

  std::string section_svg(const Scene &scene, const bool standalone)
  {
    if (scene.vector || scene.dimension == 3)
      return cloud_svg(scene);
    if (scene.empty())
      return "";
    const auto    line = default_section_line(scene);
    const Section section = section_along(scene, line.first, line.second);
    const auto   *u = scene.find("u");
    if (!u || section.s.size() < 2)
      return "";
    const double range = std::max<double>(double(u->max) - u->min, 1e-12 * std::abs(u->max));
    const auto  *along = scene.dimension == 1 ? "x" : "distance along the section";
    Plot above{.title = "The solution against its bounds", .x_label = "", .y_label = "u", .series = {}, .slopes = {}, .height = 300};
    Plot below{.title = "Contact pressure", .x_label = along, .y_label = "contact pressure", .series = {}, .slopes = {}, .height = 220};
    for (const auto &[name, values] : section.values)
    {
      PlotSeries series{.name = name, .x = section.s, .y = values, .markers = false};
      if (name == "u")
        above.series.insert(above.series.begin(), series);
      else if (name.starts_with("lower") || name.starts_with("upper"))
      {
        for (double &bound : series.y) // what is far away would flatten everything else
          if (bound > u->max + range || bound < u->min - range)
            bound = std::nan("");
        series.dashed = true;
        above.series.push_back(series);
      }
      else if (name.starts_with("contact_pressure"))
        below.series.push_back(series);
    }
    const std::string upper_svg = to_svg(above), lower_svg = to_svg(below);
    return svg_head(720, 520, scene.dimension == 1 ? "The solution against its bounds, and the contact pressure" : "A section",
                    standalone) +
           nested(upper_svg, 0) + nested(lower_svg, 290) + "</svg>\n";
  }

  std::string picture_svg(const Scene &scene, const std::string &title, const PictureOptions &options)
  {
    if (scene.empty() || scene.fields.empty())
      return "";
    if (scene.dimension == 1)
      return section_svg(scene, options.standalone);
    const Scene::Field &field = field_for(scene, options.field);
    const Placed        shown = placed(scene);
    const double        image_width = options.width - 2 * margin - scale_width, image_height = options.height - 2 * margin - 24;
    Image               image(unsigned(2 * image_width), unsigned(2 * image_height), shown.flat ? Image::View::top : Image::View::oblique,
                              scene.upward_axis);
    Image::Points       all = shown.points;
    for (const auto &sheet : shown.bounds)
      for (std::size_t i = 0; i < sheet.points.size(); ++i)
        if (!sheet.hidden[i])
          all.push_back(sheet.points[i]);
    all.insert(all.end(), shown.obstacle.begin(), shown.obstacle.end());
    if (shown.flat)
      all.insert(all.end(), scene.points.begin(), scene.points.end());
    image.fit(all);
    const auto outline = feature_edges(scene.points, scene.triangles);
    if (shown.flat)
      image.draw_lines(scene.points, outline, 1.5, {150, 150, 150});
    image.draw(shown.points, scene.triangles, sizes_of(field), field.min, field.max, field.name.starts_with("contact_pressure"));
    for (const auto &sheet : shown.bounds)
      image.draw_translucent(sheet, scene.triangles);
    image.draw_lines(shown.points, outline, 2, {40, 40, 40});
    image.draw_dots(shown.obstacle, shown.flat ? 6 : 4, {190, 60, 20});
    std::string svg = svg_head(options.width, options.height, title, options.standalone);
    svg += fmt::format("<image x=\"{:.0f}\" y=\"{:.0f}\" width=\"{:.0f}\" height=\"{:.0f}\" href=\"data:image/png;base64,{}\"/>\n", margin,
                       margin, image_width, image_height,
                       [&]
                       {
                         const std::string png = image.png();
                         return base64(png.data(), png.size());
                       }());
    svg += colour_scale(field, options.width - margin - scale_width + 18, margin + 40, image_height - 80);
    if (!shown.note.empty())
      svg += fmt::format("<text class=\"label\" x=\"{:.0f}\" y=\"{:.0f}\">{}</text>\n", margin, options.height - margin + 2.,
                         escaped(shown.note));
    return svg + "</svg>\n";
  }

  std::string png_of_svg(const std::string &svg)
  {
    const ScratchFolder folder;
    const std::string   from = folder.path + "/picture.svg", to = folder.path + "/picture.png";
    std::ofstream(from, std::ios::binary) << svg;
    std::string           program = "rsvg-convert", output = "--output=" + to, unlimited = "--unlimited", input = from;
    std::array<char *, 5> arguments = {program.data(), unlimited.data(), output.data(), input.data(), nullptr};
    pid_t                 child = 0;
    int                   status = 0;
    if (posix_spawnp(&child, program.c_str(), nullptr, nullptr, arguments.data(), environ) != 0)
      throw std::runtime_error("PNG needs the program rsvg-convert (Debian: librsvg2-bin); SVG does not: -o picture.svg");
    if (waitpid(child, &status, 0) != child || !WIFEXITED(status) || WEXITSTATUS(status) != 0)
      throw std::runtime_error("rsvg-convert could not make a PNG of the picture; try -o picture.svg");
    std::ifstream      in(to, std::ios::binary);
    std::ostringstream png;
    png << in.rdbuf();
    return std::move(png).str();
  }
} // namespace unilateral
