#include "unilateral/case/read_coefficients.h"

#include "unilateral/case/read_field.h"

#include <fmt/format.h>

namespace unilateral
{
  namespace
  {
    /// One method for each kind.
    struct CoefficientReader
    {
      /// stiffness, velocity, reaction, load
      CoefficientSpecs read_membrane_coefficients(TableReader &table)
      {
        CoefficientSpecs coefficients;
        const unsigned   dim = request.dimension;
        if (const TomlValue *value = table.find("stiffness"))
        {
          if (value->kind == TomlValue::Kind::array)
          {
            const std::size_t n = value->elements.size();
            if (dim > 0 && n != dim * (dim + 1) / 2)
              diagnostics.error(value->where,
                                dim == 1 ? std::string("'stiffness' is one number or expression in 1-D")
                                         : fmt::format("'stiffness' as a tensor has {} entries in {}-D, {}; it has {} here",
                                                       dim * (dim + 1) / 2, dim, dim == 2 ? "xx, xy, yy" : "xx, xy, xz, yy, yz, zz", n),
                                MessageName("wrong-type"));
            else
              coefficients.stiffness = read_fields(*value, "stiffness", folder, diagnostics);
          }
          else if (auto scalar = read_field(*value, "stiffness", folder, diagnostics))
            coefficients.stiffness = std::vector<FieldSpec>{std::move(*scalar)};
        }
        if (const TomlValue *value = table.find("velocity"))
        {
          if (value->kind != TomlValue::Kind::array && dim != 1)
            diagnostics.error(value->where,
                              fmt::format("'velocity' must be a list of {} numbers or expressions, not {}",
                                          dim > 0 ? std::to_string(dim) : "as many", value->kind_name()),
                              MessageName("wrong-type"));
          else if (value->kind != TomlValue::Kind::array)
          {
            if (auto scalar = read_field(*value, "velocity", folder, diagnostics))
              coefficients.velocity = std::vector<FieldSpec>{std::move(*scalar)};
          }
          else if (dim > 0 && value->elements.size() != dim)
            diagnostics.error(value->where, fmt::format("'velocity' has {} entries in {}-D, {} here", dim, dim, value->elements.size()),
                              MessageName("wrong-length"));
          else
            coefficients.velocity = read_fields(*value, "velocity", folder, diagnostics);
        }
        coefficients.reaction = field(table, "reaction");
        if (const TomlValue *value = table.find("load"); value && value->kind == TomlValue::Kind::array)
          diagnostics.error(value->where, "'load' of a membrane is one number or expression, not a list", MessageName("wrong-type"));
        else if (auto load = field(table, "load"))
          coefficients.load = std::vector<FieldSpec>{std::move(*load)};
        return coefficients;
      }

      /// rigidity, or young, poisson, thickness; reaction, load
      CoefficientSpecs read_bending_coefficients(TableReader &table)
      {
        CoefficientSpecs coefficients;
        if (auto rigidity = field(table, "rigidity"))
          coefficients.stiffness = std::vector<FieldSpec>{std::move(*rigidity)};
        if (plate())
        {
          coefficients.young = field(table, "young");
          coefficients.poisson = field(table, "poisson");
          coefficients.thickness = field(table, "thickness");
          if (coefficients.stiffness && (coefficients.young || coefficients.thickness))
            diagnostics.error(table.find("rigidity")->where, "'rigidity' is D itself; give either it or young and thickness",
                              MessageName("contradiction"));
          if (coefficients.young.has_value() != coefficients.thickness.has_value())
            diagnostics.error(table.where, "a plate has either 'rigidity' or both 'young' and 'thickness': D = E t^3/(12 (1 - nu^2))",
                              MessageName("contradiction"));
        }
        else
          for (const char *const key : {"young", "poisson", "thickness"})
            table.refuse(key, "belongs to plates; a beam has rigidity = EI");
        coefficients.reaction = field(table, "reaction");
        if (auto load = field(table, "load"))
          coefficients.load = std::vector<FieldSpec>{std::move(*load)};
        for (const char *const key : {"stiffness", "velocity"})
          table.refuse(key, "belongs to kind = \"membrane\"; beams and plates have rigidity, reaction, load");
        for (const char *const key : {"assumption", "integration"})
          table.refuse(key, "belongs to kind = \"elasticity\"");
        return coefficients;
      }

      /// stiffness, load
      CoefficientSpecs read_projection_coefficients(TableReader &table)
      {
        CoefficientSpecs coefficients;
        if (auto alpha = field(table, "stiffness"))
          coefficients.stiffness = std::vector<FieldSpec>{std::move(*alpha)};
        if (auto load = field(table, "load"))
          coefficients.load = std::vector<FieldSpec>{std::move(*load)};
        for (const char *const key : {"velocity", "reaction"})
          table.refuse(key, "belongs to kind = \"membrane\"; a projection has stiffness, load");
        for (const char *const key : {"young", "poisson", "assumption", "integration"})
          table.refuse(key, "belongs to kind = \"elasticity\"; a projection has stiffness, load");
        for (const char *const key : {"rigidity", "thickness"})
          table.refuse(key, "belongs to plates and beams; a projection has stiffness, load");
        return coefficients;
      }

      /// young, poisson, load
      CoefficientSpecs read_elastic_coefficients(TableReader &table)
      {
        CoefficientSpecs coefficients;
        coefficients.young = field(table, "young");
        coefficients.poisson = field(table, "poisson");
        if (const TomlValue *load = table.find("load"))
          coefficients.load = components(*load, "load");
        for (const char *const key : {"stiffness", "velocity", "reaction"})
          table.refuse(key, "belongs to kind = \"membrane\"; an elastic body has young, poisson, load");
        for (const char *const key : {"rigidity", "thickness"})
          table.refuse(key, "belongs to plates and beams; an elastic body has young, poisson, load");
        return coefficients;
      }

      void refuse_other_kinds(TableReader &table)
      {
        for (const char *const key : {"young", "poisson", "assumption", "integration"})
          table.refuse(key, "belongs to kind = \"elasticity\"; a membrane has stiffness, velocity, reaction, load");
        for (const char *const key : {"rigidity", "thickness"})
          table.refuse(key, "belongs to plates and beams; a membrane has stiffness, velocity, reaction, load");
      }

      bool plate() const { return request.model.kind == ModelSpec::Kind::plate; }

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

  CoefficientSpecs read_coefficients(TableReader &table, const Case &request, const std::string &folder, Diagnostics &diagnostics)
  {
    CoefficientReader reader{request, folder, diagnostics};
    switch (request.model.kind)
    {
    case ModelSpec::Kind::elasticity:
      return reader.read_elastic_coefficients(table);
    case ModelSpec::Kind::projection:
      return reader.read_projection_coefficients(table);
    case ModelSpec::Kind::beam:
    case ModelSpec::Kind::plate:
      return reader.read_bending_coefficients(table);
    case ModelSpec::Kind::membrane:
      break;
    }
    const CoefficientSpecs coefficients = reader.read_membrane_coefficients(table);
    reader.refuse_other_kinds(table);
    return coefficients;
  }
} // namespace unilateral
