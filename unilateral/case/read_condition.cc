#include "unilateral/case/read_condition.h"

#include "unilateral/case/read_field.h"

#include <fmt/format.h>

#include <algorithm>

namespace unilateral
{
  namespace
  {
    /// One method for each kind.
    struct ConditionReader
    {
      void read_membrane_condition(const TomlValue &value, BoundarySpec &condition)
      {
        const std::string &part = condition.part;
        if (value.kind == TomlValue::Kind::string)
        {
          if (value.string == "free")
            return;
          for (const char *const word : {"clamped", "simply supported", "symmetry"})
            if (value.string == word)
            {
              diagnostics.error(
                value.where,
                fmt::format("\"{}\" is not a condition of a membrane; give the value of u, \"free\", or {{ flux = .., spring = .. }}",
                            word),
                MessageName("unknown-choice"));
              return;
            }
        }
        const bool is_condition =
          value.kind == TomlValue::Kind::table &&
          std::none_of(value.entries.begin(), value.entries.end(),
                       [](const TomlEntry &e)
                       { return e.key == "raster" || e.key == "profile" || e.key == "plane" || e.key == "sphere" || e.key == "stl"; });
        if (value.kind == TomlValue::Kind::array)
          diagnostics.error(value.where, fmt::format("the value of a membrane on '{}' is one number or expression, not a list", part),
                            MessageName("wrong-type"));
        else if (!is_condition)
          condition.value = read_field(value, part, folder, diagnostics);
        else
        {
          TableReader table(value, fmt::format("[boundary] {}", part), diagnostics);
          condition.value = field(table, "value");
          condition.flux = field(table, "flux");
          condition.spring = field(table, "spring");
          for (const char *const key : {"traction", "pressure", "x", "y", "z"})
            table.refuse(key, "belongs to kind = \"elasticity\"");
          table.refuse("slope", "belongs to plates and beams");
          if (value.entries.empty())
            diagnostics.error(value.where, fmt::format("no condition on '{}'; write \"free\", or flux or spring", part),
                              MessageName("does-nothing"));
          else if (table.find("value") && (table.find("flux") || table.find("spring")))
            diagnostics.error(value.where, fmt::format("'value' fixes u on '{}', flux and spring have no say there", part),
                              MessageName("contradiction"));
          table.finish();
        }
      }

      void read_elastic_condition(const TomlValue &value, BoundarySpec &condition)
      {
        const std::string &part = condition.part;
        const unsigned     dim = request.dimension > 0 ? request.dimension : 3;
        if (value.kind == TomlValue::Kind::string)
        {
          if (value.string == "symmetry")
            condition.symmetry = true;
          else if (value.string == "clamped")
            condition.components.assign(dim, FieldSpec::constant(0));
          else if (value.string != "free")
            diagnostics.error(value.where,
                              fmt::format("\"{}\" is not a condition of an elastic body; give the displacement [ux, uy{}], "
                                          "\"clamped\", \"symmetry\", \"free\", or {{ x = 0 }}, {{ traction = [..] }}, "
                                          "{{ force = [..] }}, {{ pressure = .. }}, {{ spring = .. }}",
                                          value.string, dim == 3 ? ", uz" : ""),
                              MessageName("unknown-choice"));
          return;
        }
        if (value.kind != TomlValue::Kind::table)
        {
          if (const auto displacement = components(value, part))
            condition.components.assign(displacement->begin(), displacement->end());
          return;
        }
        TableReader table(value, fmt::format("[boundary] {}", part), diagnostics);
        for (unsigned c = 0; c < 3; ++c)
        {
          const std::string key(1, "xyz"[c]);
          if (c >= dim)
            table.refuse(key, fmt::format("the mesh is {}-D", dim));
          else if (auto component = field(table, key))
          {
            condition.components.resize(dim);
            condition.components[c] = std::move(*component);
          }
        }
        if (const TomlValue *traction = table.find("traction"))
          condition.traction = components(*traction, "traction").value_or(std::vector<FieldSpec>());
        if (const TomlValue *force = table.find("force"))
        {
          if (!condition.traction.empty())
            diagnostics.error(force->where, fmt::format("'force' is the total of 'traction' on '{}': give one of them", part),
                              MessageName("contradiction"));
          condition.traction = components(*force, "force").value_or(std::vector<FieldSpec>());
          condition.traction_is_total = true;
        }
        condition.pressure = field(table, "pressure");
        if (const TomlValue *spring = table.find("spring"))
        {
          if (spring->kind == TomlValue::Kind::array)
            condition.springs = components(*spring, "spring").value_or(std::vector<FieldSpec>());
          else if (auto scalar = read_field(*spring, "spring", folder, diagnostics))
            condition.springs = {std::move(*scalar)};
        }
        for (const char *const key : {"value", "flux"})
          table.refuse(key, "belongs to kind = \"membrane\"; an elastic body has x, y, z, traction, force, pressure, spring");
        table.refuse("slope", "belongs to plates and beams");
        if (value.entries.empty())
          diagnostics.error(value.where,
                            fmt::format("no condition on '{}'; write \"free\", or x, y, z, traction, force, pressure, spring", part),
                            MessageName("does-nothing"));
        table.finish();
      }

      void read_bending_condition(const TomlValue &value, BoundarySpec &condition)
      {
        const std::string &part = condition.part;
        if (value.kind == TomlValue::Kind::string)
        {
          if (value.string == "clamped" || value.string == "simply supported")
            condition.value = FieldSpec::constant(0);
          if (value.string == "clamped")
            condition.slope = FieldSpec::constant(0);
          condition.symmetry = value.string == "symmetry";
          if (condition.value || condition.symmetry || value.string == "free")
            return;
        }
        if (value.kind == TomlValue::Kind::array)
        {
          diagnostics.error(value.where,
                            fmt::format("the condition on '{}' is \"clamped\", \"simply supported\", \"free\", \"symmetry\" or a "
                                        "table like {{ value = 0, slope = 0.1 }}, not a list",
                                        part),
                            MessageName("wrong-type"));
          return;
        }
        if (value.kind != TomlValue::Kind::table)
        {
          if (value.kind == TomlValue::Kind::string && value.string.find_first_of(" 0123456789xyz(") == std::string::npos)
            diagnostics.error(value.where,
                              fmt::format("\"{}\" is not a condition of beams and plates; give \"clamped\", \"simply "
                                          "supported\", \"free\", \"symmetry\" or {{ value = .., slope = .., .. }}",
                                          value.string),
                              MessageName("unknown-choice"));
          else
            condition.value = read_field(value, part, folder, diagnostics);
          return;
        }
        TableReader table(value, fmt::format("[boundary] {}", part), diagnostics);
        condition.value = field(table, "value");
        condition.slope = field(table, "slope");
        condition.spring = field(table, "spring");
        condition.slope_spring = field(table, "slope_spring");
        condition.flux = field(table, "force");
        condition.moment = field(table, "moment");
        for (const char *const key : {"traction", "pressure", "x", "y", "z"})
          table.refuse(key, "belongs to kind = \"elasticity\"");
        table.refuse("flux", "belongs to kind = \"membrane\"; beams and plates have force and moment");
        if (value.entries.empty())
          diagnostics.error(value.where, fmt::format("no condition on '{}'; write \"free\", or value, slope, spring, force, ..", part),
                            MessageName("does-nothing"));
        else if (condition.value && (condition.spring || condition.flux))
          diagnostics.error(value.where, fmt::format("'value' fixes u on '{}', spring and force have no say there", part),
                            MessageName("contradiction"));
        else if (condition.slope && (condition.slope_spring || condition.moment))
          diagnostics.error(value.where, fmt::format("'slope' fixes the slope on '{}', slope_spring and moment have no say there", part),
                            MessageName("contradiction"));
        table.finish();
      }

      std::optional<FieldSpec> field(TableReader &table, const std::string &key)
      {
        const TomlValue *value = table.find(key);
        return value ? read_field(*value, key, folder, diagnostics) : std::nullopt;
      }

      std::optional<std::vector<FieldSpec>> components(const TomlValue &value, const std::string &key)
      {
        return read_components(value, key, request.dimension, folder, diagnostics);
      }

      const Case        &request;
      const std::string &folder;
      Diagnostics       &diagnostics;
    };
  } // namespace

  void
  read_condition(const TomlValue &value, const Case &request, const std::string &folder, BoundarySpec &condition, Diagnostics &diagnostics)
  {
    ConditionReader reader{request, folder, diagnostics};
    switch (request.model.kind)
    {
    case ModelSpec::Kind::elasticity:
      return reader.read_elastic_condition(value, condition);
    case ModelSpec::Kind::beam:
    case ModelSpec::Kind::plate:
      return reader.read_bending_condition(value, condition);
    case ModelSpec::Kind::projection:
      if (!(value.kind == TomlValue::Kind::string && value.string == "free"))
        diagnostics.error(condition.where, "a projection has no boundary conditions: m = 0, and its functions have no values there",
                          MessageName("kind-does-not-fit"));
      return;
    case ModelSpec::Kind::membrane:
      return reader.read_membrane_condition(value, condition);
    }
  }
} // namespace unilateral
