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
        const bool is_condition = value.kind == TomlValue::Kind::table &&
                                  std::none_of(value.entries.begin(), value.entries.end(),
                                               [](const TomlEntry &e)
                                               {
                                                 static const std::vector<std::string> of_fields = {"raster", "profile", "run", "previous",
                                                                                                    "plane",  "sphere",  "stl"};
                                                 return std::find(of_fields.begin(), of_fields.end(), e.key) != of_fields.end();
                                               });
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
                                          "{{ force = [..] }}, {{ moment = .. }}, {{ pressure = .. }}, {{ spring = .. }}, "
                                          "{{ rigid = true }}",
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
        read_resultants(table, dim, condition);
        read_platen(table, dim, condition);
        condition.pressure = field(table, "pressure");
        if (const TomlValue *spring = table.find("spring"))
        {
          if (spring->kind == TomlValue::Kind::array)
            condition.springs = components(*spring, "spring").value_or(std::vector<FieldSpec>());
          else if (auto scalar = read_field(*spring, "spring", folder, diagnostics))
            condition.springs = {std::move(*scalar)};
        }
        for (const char *const key : {"value", "flux"})
          table.refuse(key,
                       "belongs to kind = \"membrane\"; an elastic body has x, y, z, traction, force, moment, pressure, spring, rigid");
        table.refuse("slope", "belongs to plates and beams");
        if (value.entries.empty())
          diagnostics.error(
            value.where,
            fmt::format("no condition on '{}'; write \"free\", or x, y, z, traction, force, moment, pressure, spring, rigid", part),
            MessageName("does-nothing"));
        table.finish();
      }

      /// traction, or force and moment by their totals.
      void read_resultants(TableReader &table, const unsigned dim, BoundarySpec &condition)
      {
        const std::string &part = condition.part;
        if (const TomlValue *traction = table.find("traction"))
        {
          condition.traction = components(*traction, "traction").value_or(std::vector<FieldSpec>());
          for (const char *const key : {"force", "moment"})
            if (const TomlValue *total = table.find(key))
              diagnostics.error(total->where,
                                fmt::format("'{}' is {} 'traction' on '{}': give one of them", key,
                                            key == std::string("force") ? "the total of" : "a total like force and excludes", part),
                                MessageName("contradiction"));
        }
        if (const TomlValue *force = table.find("force"))
        {
          condition.traction = components(*force, "force").value_or(std::vector<FieldSpec>());
          condition.traction_is_total = true;
        }
        if (const TomlValue *moment = table.find("moment"))
        {
          if (dim == 3 || moment->kind == TomlValue::Kind::array)
            condition.moments = read_fields(*moment, "moment", folder, diagnostics).value_or(std::vector<FieldSpec>());
          else if (auto number = read_field(*moment, "moment", folder, diagnostics))
            condition.moments = {std::move(*number)};
          if (request.dimension > 0 && !condition.moments.empty() && condition.moments.size() != (dim == 3 ? 3 : 1))
          {
            diagnostics.error(moment->where,
                              fmt::format("'moment' is {}, {} entries are given",
                                          dim == 3 ? "a list [Mx, My, Mz] in 3-D" : "one number in 2-D, positive counter-clockwise",
                                          condition.moments.size()),
                              MessageName("wrong-length"));
            condition.moments.clear();
          }
        }
        if (const TomlValue *about = table.find("about"))
        {
          condition.about = read_numbers(*about, "about", diagnostics).value_or(std::vector<double>());
          if (request.dimension > 0 && !condition.about.empty() && condition.about.size() != dim)
          {
            diagnostics.error(about->where,
                              fmt::format("'about' is a point, {} coordinates on a {}-D mesh, {} here", dim, dim, condition.about.size()),
                              MessageName("wrong-length"));
            condition.about.clear();
          }
          if (!table.find("force") && !table.find("moment") && !table.find("rigid"))
            diagnostics.error(
              about->where,
              fmt::format("'about' on '{}' is the point of a force, a moment or a rigid part, and none of them is given", part),
              MessageName("does-nothing"));
        }
      }

      /// rigid and rotation
      void read_platen(TableReader &table, const unsigned dim, BoundarySpec &condition)
      {
        const TomlValue *rigid = table.find("rigid"), *rotation = table.find("rotation");
        const unsigned   n_rotations = dim == 3 ? 3 : dim == 2 ? 1 : 0;
        if (rotation && !rigid)
          diagnostics.error(rotation->where, fmt::format("'rotation' on '{}' is that of a rigid part; add rigid = true", condition.part),
                            MessageName("does-nothing"));
        if (!rigid)
          return;
        const bool translation = rigid->kind == TomlValue::Kind::string && rigid->string == "translation";
        if (!translation && rigid->kind != TomlValue::Kind::boolean)
        {
          diagnostics.error(rigid->where, "'rigid' is true, false or \"translation\" (the platen does not turn)",
                            MessageName("unknown-choice"));
          return;
        }
        condition.rigid = translation || rigid->boolean;
        if (translation)
          condition.rotations.assign(n_rotations, FieldSpec::constant(0));
        if (!rotation)
          return;
        if (translation)
          diagnostics.error(rotation->where,
                            fmt::format("rigid = \"translation\" says that '{}' does not turn; with 'rotation' it is "
                                        "rigid = true",
                                        condition.part),
                            MessageName("contradiction"));
        if (!condition.rigid || request.model.assumption == ModelSpec::Assumption::axisymmetric)
          diagnostics.error(rotation->where,
                            condition.rigid ? "an axisymmetric platen does not turn"
                                            : fmt::format("'{}' is not rigid and has no rotation of its own", condition.part),
                            MessageName("kind-does-not-fit"));
        read_rotation(*rotation, n_rotations, condition);
      }

      void read_rotation(const TomlValue &rotation, const unsigned n_rotations, BoundarySpec &condition)
      {
        condition.rotations.assign(n_rotations, std::nullopt);
        if (n_rotations == 3 && rotation.kind == TomlValue::Kind::table)
        {
          TableReader axes(rotation, fmt::format("[boundary] {} rotation", condition.part), diagnostics);
          for (unsigned a = 0; a < 3; ++a)
            condition.rotations[a] = field(axes, std::string(1, "xyz"[a]));
          axes.finish();
          return;
        }
        std::vector<FieldSpec> angles;
        if (rotation.kind == TomlValue::Kind::array)
          angles = read_fields(rotation, "rotation", folder, diagnostics).value_or(std::vector<FieldSpec>());
        else if (auto angle = read_field(rotation, "rotation", folder, diagnostics))
          angles = {std::move(*angle)};
        if (angles.size() == n_rotations)
          condition.rotations.assign(angles.begin(), angles.end());
        else if (request.dimension > 0 && !angles.empty())
          diagnostics.error(rotation.where,
                            n_rotations == 3 ? "'rotation' is a list of three angles in radians, or those that are prescribed: { z = 0.1 }"
                                             : "'rotation' is one angle in radians, positive counter-clockwise",
                            MessageName("wrong-length"));
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
