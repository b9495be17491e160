#include "unilateral/case/read_field.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <iterator>
#include <memory>

namespace unilateral
{
  namespace
  {
    constexpr const char *sources[] = {"raster", "profile", "run", "previous"};
    constexpr const char *surfaces[] = {"plane", "sphere", "cylinder", "stl"};

    /// Which of the sources the table names: exactly one, or nullptr with an error.
    const char *source_of(TableReader &table)
    {
      for (const char *const surface : surfaces)
        table.refuse(surface, "only the gap of an elastic body is measured to a surface; here it can be written as an expression");
      std::vector<const char *> found;
      for (const char *const source : sources)
        if (table.find(source))
          found.push_back(source);
      if (found.size() == 1)
        return found[0];
      const auto is_there = [&](const char *const key)
      { return table.where_key(key).column != table.where.column || table.where_key(key).line != table.where.line; };
      if (std::none_of(std::begin(surfaces), std::end(surfaces), is_there))
        table.diagnostics.error(table.where,
                                fmt::format("{} must hold one of raster = \"file\", profile = \"file\", run = \"folder\" and "
                                            "previous = \"u\"",
                                            table.section),
                                MessageName("wrong-type"));
      return nullptr;
    }

    void read_extent(TableReader &table, FieldSpec &spec)
    {
      const TomlValue *const extent = table.find("extent");
      if (!extent)
        return;
      const std::size_t   n_before = table.diagnostics.all().size();
      std::vector<double> corners;
      if (extent->kind == TomlValue::Kind::array && extent->elements.size() == 2)
        for (const TomlValue &corner : extent->elements)
          if (const auto numbers = read_numbers(corner, "extent", table.diagnostics))
            corners.insert(corners.end(), numbers->begin(), numbers->end());
      if (corners.size() == 4 && corners[0] < corners[2] && corners[1] < corners[3])
        spec.extent = {{{corners[0], corners[1]}, {corners[2], corners[3]}}};
      else if (table.diagnostics.all().size() == n_before)
        table.diagnostics.error(extent->where, "'extent' must be [[x0, y0], [x1, y1]] with x0 < x1 and y0 < y1", MessageName("wrong-type"));
    }

    /// What a quantity of the step before can be.
    void read_previous(TableReader &table, const std::string &folder, FieldSpec &spec)
    {
      spec.kind = FieldSpec::Kind::previous;
      spec.quantity = table.string("previous").value_or("");
      static const std::vector<std::string> known = {"u", "ux", "uy", "uz"};
      if (table.find("previous")->kind == TomlValue::Kind::string && std::find(known.begin(), known.end(), spec.quantity) == known.end())
        table.diagnostics.error(spec.where,
                                fmt::format("'{}' is no quantity of the step before; it has u, of a body ux, uy and uz", spec.quantity),
                                MessageName("unknown-choice"));
      if (const TomlValue *const initial = table.find("initial"))
        if (auto before = read_field(*initial, "initial", folder, table.diagnostics))
        {
          if (before->kind == FieldSpec::Kind::previous)
            table.diagnostics.error(initial->where,
                                    "before the first step there is no previous one: 'initial' is a number, an expression, "
                                    "a raster, a profile or a run",
                                    MessageName("contradiction"));
          spec.initial = std::make_shared<FieldSpec>(std::move(*before));
        }
    }

    void read_file(TableReader &table, const std::string &source, const std::string &folder, FieldSpec &spec)
    {
      spec.kind = source == "raster" ? FieldSpec::Kind::raster : source == "profile" ? FieldSpec::Kind::profile : FieldSpec::Kind::run;
      const auto file = table.string(source);
      if (file && file->empty())
        table.diagnostics.error(spec.where, fmt::format("'{}' must be the name of a {}", source, source == "run" ? "folder" : "file"),
                                MessageName("wrong-type"));
      if (file && !file->empty())
        spec.file = absolute_path(*file, folder);
      if (source == "run")
        spec.quantity = table.string("quantity").value_or("u");
    }

    /// A field that is given by its values elsewhere.
    std::optional<FieldSpec>
    read_samples(const TomlValue &value, const std::string &name, const std::string &folder, Diagnostics &diagnostics)
    {
      TableReader       table(value, "'" + name + "'", diagnostics);
      FieldSpec         spec;
      const char *const source = source_of(table);
      const std::string key = source ? source : "";
      if (source)
      {
        spec.where = table.find(key)->where;
        key == "previous" ? read_previous(table, folder, spec) : read_file(table, key, folder, spec);
      }
      spec.scale = table.number("scale").value_or(1);
      spec.offset = table.number("offset").value_or(0);
      const auto belongs_to = [&](const char *const owner, const std::vector<const char *> &keys, const char *const reason)
      {
        if (!key.empty() && key != owner)
          for (const char *const other : keys)
            table.refuse(other, reason);
      };
      belongs_to("raster", {"extent", "nodata"}, "only rasters have it");
      belongs_to("run", {"quantity"}, "only the solution of a run has it");
      belongs_to("previous", {"initial"}, "only the solution of the step before has it");
      if (key.empty() || key == "raster")
      {
        spec.nodata = table.number("nodata");
        read_extent(table, spec);
      }
      table.finish();
      const bool complete = !key.empty() && !(key == "previous" ? spec.quantity : spec.file).empty();
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
                        fmt::format("'{}' must be a number, an expression in quotes, or a table with raster, profile, run or previous, "
                                    "not {}",
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
