#include "unilateral/case/read_surface.h"
#include "unilateral/case/case.h"
#include "unilateral/case/read_field.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>

namespace unilateral
{
  namespace
  {
    const std::array<std::string, 4> kinds = {"plane", "sphere", "cylinder", "stl"};

    /// Reads the table of one surface. Its messages are what tells whether the surface that it returns is complete.
    class SurfaceReader
    {
    public:
      SurfaceReader(
        const TomlValue &value, const std::string &name, const unsigned dim, const std::string &folder, Diagnostics &diagnostics)
        : table(value, "'" + name + "'", diagnostics), dim(dim), folder(folder), diagnostics(diagnostics)
      {
      }

      SurfaceDescription read()
      {
        std::vector<std::string> present;
        for (const std::string &kind : kinds)
          if (table.find(kind))
            present.push_back(kind);
        if (present.size() == 1)
          read_kind(present.front());
        else if (present.size() > 1)
          diagnostics.error(table.where_key(present[1]), fmt::format("{} can hold only one of {}", table.section, fmt::join(kinds, ", ")),
                            MessageName("wrong-type"));
        else if (std::none_of(kinds.begin(), kinds.end(), [this](const std::string &kind) { return table.has_or_misspells(kind); }))
          diagnostics.error(table.where, fmt::format("{} must hold one of {}", table.section, fmt::join(kinds, ", ")),
                            MessageName("wrong-type"));

        const bool is_file = std::find(present.begin(), present.end(), "stl") != present.end();
        for (const char *const key : {"point", "normal", "center", "axis", "radius", "inside"})
          table.refuse(key, is_file ? "an STL file has its own points and normals"
                                    : fmt::format("belongs into the braces of the shape, {} = {{ {} = .. }}",
                                                  present.empty() ? "sphere" : present.front(), key));
        if (!is_file)
          for (const char *const key : {"scale", "shift"})
            table.refuse(key, "only STL files have it");
        table.finish();
        return spec;
      }

    private:
      void read_kind(const std::string &kind)
      {
        const TomlValue &shape = *table.find(kind);
        spec.where = shape.where;
        if (kind == "plane")
          read_plane(shape);
        else if (kind == "sphere")
          read_sphere(shape);
        else if (kind == "cylinder")
          read_cylinder(shape);
        else
          read_stl(shape);
      }

      void read_plane(const TomlValue &value)
      {
        spec.kind = SurfaceDescription::Kind::plane;
        if (!is_table(value, "plane", "{ point = [0, 0], normal = [0, 1] }"))
          return;
        TableReader plane(value, "'plane'", diagnostics);
        spec.point = coordinates(plane, "point", dim);
        spec.direction = direction(plane, "normal", dim, "; it points out of the obstacle");
        plane.refuse("inside", "a plane has no inside; turn its normal round to have the obstacle on the other side");
        finish(plane, {{"point", "any point of the plane"}, {"normal", "it points out of the obstacle"}});
      }

      void read_sphere(const TomlValue &value)
      {
        spec.kind = SurfaceDescription::Kind::sphere;
        if (!is_table(value, "sphere", "{ center = [0, 0], radius = 1 }"))
          return;
        TableReader sphere(value, "'sphere'", diagnostics);
        spec.point = coordinates(sphere, "center", dim);
        read_radius(sphere);
        finish(sphere, {{"center", "for example center = [0, 0], in 3-D [0, 0, 0]"}});
      }

      void read_cylinder(const TomlValue &value)
      {
        spec.kind = SurfaceDescription::Kind::cylinder;
        if (dim > 0 && dim != 3)
        {
          diagnostics.error(
            table.where_key("cylinder"),
            fmt::format("a cylinder has three dimensions; in {}-D its section is a circle, sphere = {{ center = [0, 0], radius = 1 }}",
                        dim),
            MessageName("kind-does-not-fit"));
          return;
        }
        if (!is_table(value, "cylinder", "{ point = [0, 0, 0], axis = [0, 0, 1], radius = 1 }"))
          return;
        TableReader cylinder(value, "'cylinder'", diagnostics);
        spec.point = coordinates(cylinder, "point", dim);
        spec.direction = direction(cylinder, "axis", dim, "");
        read_radius(cylinder);
        finish(cylinder, {{"point", "any point of the axis"}, {"axis", "the direction of the axis"}});
      }

      void read_stl(const TomlValue &value)
      {
        spec.kind = SurfaceDescription::Kind::stl;
        if (dim > 0 && dim != 3)
          diagnostics.error(table.where_key("stl"),
                            fmt::format("an STL file has three dimensions; in {}-D use plane, or sphere for a circle", dim),
                            MessageName("kind-does-not-fit"));
        const auto file = table.string("stl");
        if (file && file->empty())
          diagnostics.error(value.where, "'stl' must be the name of a file", MessageName("wrong-type"));
        if (file && !file->empty())
          spec.file = absolute_path(*file, folder);
        spec.scale = positive(table, "scale");
        spec.shift = coordinates(table, "shift", 3);
      }

      /// What sphere and cylinder share.
      void read_radius(TableReader &shape)
      {
        spec.radius = positive(shape, "radius");
        const TomlValue *inside = shape.find("inside");
        if (inside && inside->kind != TomlValue::Kind::boolean)
          diagnostics.error(inside->where,
                            fmt::format("'inside' must be true (the body lies inside the surface) or false, not {}", inside->kind_name()),
                            MessageName("wrong-type"));
        spec.inside = inside && inside->boolean;
      }

      /// Reports what is missing of @p required, keys with what they are, and what is unknown.
      void finish(TableReader &shape, const std::vector<std::pair<std::string, std::string>> &required)
      {
        for (const auto &[key, meaning] : required)
          if (!shape.has_or_misspells(key))
            diagnostics.error(shape.where, fmt::format("'{}' is missing in {}; {}", key, shape.section, meaning),
                              MessageName("missing-key"));
        shape.finish();
      }

      bool is_table(const TomlValue &value, const std::string &kind, const std::string &example)
      {
        if (value.kind != TomlValue::Kind::table)
          diagnostics.error(value.where, fmt::format("'{}' must be {}, not {}", kind, example, value.kind_name()),
                            MessageName("wrong-type"));
        return value.kind == TomlValue::Kind::table;
      }

      /// A list of @p count numbers, of any length for 0.
      std::vector<double> coordinates(TableReader &shape, const std::string &key, const unsigned count)
      {
        const auto numbers = shape.numbers(key);
        if (numbers && count > 0 && numbers->size() != count)
          diagnostics.error(shape.find(key)->where,
                            fmt::format("'{}' must have {} numbers in {}-D, it has {}", key, count, count, numbers->size()),
                            MessageName("wrong-length"));
        return numbers.value_or(std::vector<double>());
      }

      std::vector<double> direction(TableReader &shape, const std::string &key, const unsigned count, const std::string &meaning)
      {
        auto numbers = coordinates(shape, key, count);
        if (!numbers.empty() && std::all_of(numbers.begin(), numbers.end(), [](const double number) { return number == 0; }))
          diagnostics.error(shape.find(key)->where, fmt::format("'{}' must not be zero{}", key, meaning), MessageName("out-of-range"));
        return numbers;
      }

      double positive(TableReader &shape, const std::string &key)
      {
        const auto number = shape.number(key);
        if (number && *number <= 0)
          diagnostics.error(shape.find(key)->where, fmt::format("'{}' must be positive, it is {}", key, *number),
                            MessageName("out-of-range"));
        return number.value_or(1);
      }

      TableReader        table;
      const unsigned     dim;
      const std::string &folder;
      Diagnostics       &diagnostics;
      SurfaceDescription spec;
    };
  } // namespace

  bool is_surface(const TomlValue &value)
  {
    return value.kind == TomlValue::Kind::table &&
           std::any_of(value.entries.begin(), value.entries.end(),
                       [](const TomlEntry &entry) { return std::find(kinds.begin(), kinds.end(), entry.key) != kinds.end(); });
  }

  std::optional<SurfaceDescription>
  read_surface(const TomlValue &value, const std::string &name, const unsigned dim, const std::string &folder, Diagnostics &diagnostics)
  {
    if (value.kind != TomlValue::Kind::table)
    {
      diagnostics.error(value.where,
                        fmt::format("'{}' must be {{ plane = .. }}, {{ sphere = .. }}, {{ cylinder = .. }} or {{ stl = \"file\" }}, not {}",
                                    name, value.kind_name()),
                        MessageName("wrong-type"));
      return {};
    }
    const std::size_t        n_before = diagnostics.all().size();
    const SurfaceDescription spec = SurfaceReader(value, name, dim, folder, diagnostics).read();
    return diagnostics.all().size() == n_before ? std::optional(spec) : std::nullopt;
  }

  std::string surface_text(const SurfaceDescription &spec)
  {
    switch (spec.kind)
    {
    case SurfaceDescription::Kind::plane:
      return fmt::format("{{ plane = {{ point = {}, normal = {} }} }}", toml_list(spec.point), toml_list(spec.direction));
    case SurfaceDescription::Kind::sphere:
      return fmt::format("{{ sphere = {{ center = {}, radius = {}, inside = {} }} }}", toml_list(spec.point), spec.radius, spec.inside);
    case SurfaceDescription::Kind::cylinder:
      return fmt::format("{{ cylinder = {{ point = {}, axis = {}, radius = {}, inside = {} }} }}", toml_list(spec.point),
                         toml_list(spec.direction), spec.radius, spec.inside);
    case SurfaceDescription::Kind::stl:
      return fmt::format("{{ stl = {}, scale = {}, shift = {} }}", toml_quoted(spec.file), spec.scale,
                         toml_list(spec.shift.empty() ? std::vector<double>(3, 0.) : spec.shift));
    }
    return "";
  }
} // namespace unilateral
