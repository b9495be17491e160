#include "unilateral/case/read_field.h"

#include <fmt/format.h>

#include <filesystem>

namespace unilateral
{
  namespace
  {
    std::optional<FieldSpec::Kind> kind_of_table(TableReader &table, const TomlValue *raster, const TomlValue *profile)
    {
      for (const char *const surface : {"plane", "sphere", "cylinder", "stl"})
        table.refuse(surface, "only the gap of an elastic body is measured to a surface; here it can be written as an expression");
      if ((raster != nullptr) == (profile != nullptr))
      {
        for (const char *const surface : {"plane", "sphere", "cylinder", "stl"})
          if (table.where_key(surface).column != table.where.column || table.where_key(surface).line != table.where.line)
            return {};
        table.diagnostics.error(table.where, fmt::format("{} must hold either raster = \"file\" or profile = \"file\"", table.section),
                                MessageName("wrong-type"));
        return {};
      }
      return raster ? FieldSpec::Kind::raster : FieldSpec::Kind::profile;
    }

    std::optional<FieldSpec>
    read_samples(const TomlValue &value, const std::string &name, const std::string &folder, Diagnostics &diagnostics)
    {
      TableReader      table(value, "'" + name + "'", diagnostics);
      const TomlValue *raster = table.find("raster"), *profile = table.find("profile");
      FieldSpec        spec;
      const auto       kind = kind_of_table(table, raster, profile);
      bool             complete = kind.has_value();
      if (kind)
      {
        spec.kind = *kind;
        const std::string key = raster ? "raster" : "profile";
        spec.where = (raster ? raster : profile)->where;
        const auto file = table.string(key);
        if (file && file->empty())
          diagnostics.error(spec.where, fmt::format("'{}' must be the name of a file", key), MessageName("wrong-type"));
        if (file && !file->empty())
          spec.file = absolute_path(*file, folder);
        complete = !spec.file.empty();
      }
      spec.scale = table.number("scale").value_or(1);
      spec.offset = table.number("offset").value_or(0);
      if (profile && !raster)
      {
        table.refuse("extent", "only rasters have it; a profile has its own x");
        table.refuse("nodata", "only rasters have it");
      }
      else
      {
        spec.nodata = table.number("nodata");
        if (const TomlValue *extent = table.find("extent"))
        {
          const std::size_t   n_before = diagnostics.all().size();
          std::vector<double> corners;
          if (extent->kind == TomlValue::Kind::array && extent->elements.size() == 2)
            for (const TomlValue &corner : extent->elements)
              if (const auto numbers = read_numbers(corner, "extent", diagnostics))
                corners.insert(corners.end(), numbers->begin(), numbers->end());
          if (corners.size() == 4 && corners[0] < corners[2] && corners[1] < corners[3])
            spec.extent = {{{corners[0], corners[1]}, {corners[2], corners[3]}}};
          else if (diagnostics.all().size() == n_before)
            diagnostics.error(extent->where, "'extent' must be [[x0, y0], [x1, y1]] with x0 < x1 and y0 < y1", MessageName("wrong-type"));
        }
      }
      table.finish();
      return complete ? std::optional(spec) : std::nullopt;
    }
  } // namespace

  std::string absolute_path(const std::string &file, const std::string &folder)
  {
    return (std::filesystem::path(folder) / file).lexically_normal().string();
  }

  std::optional<FieldSpec> read_field(const TomlValue &value, const std::string &name, const std::string &folder, Diagnostics &diagnostics)
  {
    switch (value.kind)
    {
    case TomlValue::Kind::integer:
    case TomlValue::Kind::real:
      if (const auto number = read_number(value, name, diagnostics))
      {
        FieldSpec spec = FieldSpec::constant(*number);
        spec.where = value.where;
        return spec;
      }
      return {};
    case TomlValue::Kind::string:
    {
      FieldSpec spec = FieldSpec::expression(value.string);
      spec.where = value.inside;
      spec.places = value.places;
      return spec;
    }
    case TomlValue::Kind::given:
    {
      FieldSpec spec;
      spec.kind = FieldSpec::Kind::given;
      spec.given = value.given;
      spec.given_number = std::size_t(value.integer);
      spec.where = value.where;
      return spec;
    }
    case TomlValue::Kind::table:
      return read_samples(value, name, folder, diagnostics);
    default:
      diagnostics.error(value.where,
                        fmt::format("'{}' must be a number, an expression in quotes, {{ raster = \"file\" }} or {{ profile = "
                                    "\"file\" }}, not {}",
                                    name, value.kind_name()),
                        MessageName("wrong-type"));
      return {};
    }
  }

  std::optional<std::vector<FieldSpec>>
  read_fields(const TomlValue &value, const std::string &name, const std::string &folder, Diagnostics &diagnostics)
  {
    std::vector<FieldSpec> fields;
    bool                   complete = true;
    for (const TomlValue &element : value.elements)
      if (auto field = read_field(element, name, folder, diagnostics))
        fields.push_back(std::move(*field));
      else
        complete = false;
    return complete ? std::optional(fields) : std::nullopt;
  }

  std::optional<std::vector<FieldSpec>>
  read_components(const TomlValue &value, const std::string &key, const unsigned dim, const std::string &folder, Diagnostics &diagnostics)
  {
    if (value.kind != TomlValue::Kind::array)
    {
      // In 1-D a number is a vector.
      if (dim == 1)
        if (auto scalar = read_field(value, key, folder, diagnostics))
          return std::vector<FieldSpec>{std::move(*scalar)};
      if (dim != 1)
        diagnostics.error(value.where,
                          fmt::format("'{}' of an elastic body must be a list of {} numbers or expressions, not {}", key,
                                      dim > 0 ? std::to_string(dim) : "as many as the mesh has dimensions", value.kind_name()),
                          MessageName("wrong-type"));
      return {};
    }
    if (dim > 0 && value.elements.size() != dim)
    {
      diagnostics.error(value.where, fmt::format("'{}' has {} entries in {}-D, {} here", key, dim, dim, value.elements.size()),
                        MessageName("wrong-length"));
      return {};
    }
    return read_fields(value, key, folder, diagnostics);
  }
} // namespace unilateral
