// Case -> TOML, every default written.

#include "unilateral/case/write_case.h"
#include "unilateral/case/read_surface.h"
#include "unilateral/case/toml_document.h"
#include "unilateral/constraints/rule_name.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

namespace unilateral
{
  namespace
  {
    std::string number(const double value)
    {
      return fmt::format("{}", value);
    }

    std::string field(const FieldSpec &spec)
    {
      switch (spec.kind)
      {
      case FieldSpec::Kind::constant:
        return number(spec.value);
      case FieldSpec::Kind::given:
        return fmt::format("{{ given = {}, name = {} }}", spec.given_number, toml_quoted(spec.given->name()));
      case FieldSpec::Kind::expression:
        return toml_quoted(spec.text);
      case FieldSpec::Kind::raster:
      case FieldSpec::Kind::profile:
      {
        std::string text = fmt::format("{{ {} = {}, scale = {}, offset = {}", spec.kind == FieldSpec::Kind::raster ? "raster" : "profile",
                                       toml_quoted(spec.file), spec.scale, spec.offset);
        if (spec.extent)
          text += fmt::format(", extent = [[{}, {}], [{}, {}]]", (*spec.extent)[0][0], (*spec.extent)[0][1], (*spec.extent)[1][0],
                              (*spec.extent)[1][1]);
        if (spec.nodata)
          text += fmt::format(", nodata = {}", *spec.nodata);
        return text + " }";
      }
      case FieldSpec::Kind::run:
        return fmt::format("{{ run = {}, quantity = {}, scale = {}, offset = {} }}", toml_quoted(spec.file), toml_quoted(spec.quantity),
                           spec.scale, spec.offset);
      case FieldSpec::Kind::previous:
        return fmt::format("{{ previous = {}, initial = {}, scale = {}, offset = {} }}", toml_quoted(spec.quantity),
                           spec.initial ? field(*spec.initial) : "0", spec.scale, spec.offset);
      }
      return "";
    }

    std::string fields(const std::vector<FieldSpec> &specs)
    {
      std::vector<std::string> texts;
      for (const FieldSpec &spec : specs)
        texts.push_back(field(spec));
      return fmt::format("[{}]", fmt::join(texts, ", "));
    }

    /// Appends `key = value` lines.
    class Text
    {
    public:
      void line(const std::string &name, const std::string &value) { text += name + " = " + value + "\n"; }
      void line(const std::string &name, const std::optional<FieldSpec> &value)
      {
        if (value)
          line(name, field(*value));
      }
      void line(const std::string &name, const std::optional<double> &value)
      {
        if (value)
          line(name, number(*value));
      }
      void section(const std::string &header) { text += (text.empty() ? "" : "\n") + header + "\n"; }

      void coefficients(const CoefficientSpecs &c)
      {
        if (c.stiffness)
          line(bending ? "rigidity" : "stiffness", c.stiffness->size() == 1 ? field(c.stiffness->front()) : fields(*c.stiffness));
        if (c.velocity)
          line("velocity", fields(*c.velocity));
        line("reaction", c.reaction);
        line("young", c.young);
        line("poisson", c.poisson);
        line("thickness", c.thickness);
        if (c.load)
          line("load", elastic ? fields(*c.load) : field(c.load->front()));
      }

      bool        elastic = false, bending = false;
      std::string text;
    };

    void write_mesh(const MeshSpec &mesh, Text &out)
    {
      out.section("[mesh]");
      switch (mesh.source)
      {
      case MeshSpec::Source::none:
        break;
      case MeshSpec::Source::box:
        out.line("box", fmt::format("[{}, {}]", toml_list(mesh.box_lower), toml_list(mesh.box_upper)));
        out.line("cells", fmt::format("[{}]", fmt::join(mesh.cells, ", ")));
        break;
      case MeshSpec::Source::ball:
        out.line("ball", fmt::format("{{ center = {}, radius = {} }}", toml_list(mesh.center), mesh.radius));
        break;
      case MeshSpec::Source::shell:
        out.line("shell", fmt::format("{{ center = {}, inner = {}, outer = {} }}", toml_list(mesh.center), mesh.inner, mesh.outer));
        break;
      case MeshSpec::Source::file:
        out.line("file", toml_quoted(mesh.file));
        if (mesh.size > 0)
          out.line("size", number(mesh.size));
        break;
      case MeshSpec::Source::cells:
        out.line("given", "0");
        break;
      }
      out.line("refine", std::to_string(mesh.refine));
      if (mesh.adapt)
        out.line("adapt", fmt::format("{{ tolerance = {}, max_unknowns = {}, goal = {} }}", number(mesh.adapt->tolerance),
                                      mesh.adapt->max_unknowns, toml_quoted(mesh.adapt->goal.name)));
      for (const auto &[where, times] : mesh.local)
      {
        out.section("[[mesh.local]]");
        out.line("where", field(where));
        out.line("times", std::to_string(times));
      }
      for (const auto &part : mesh.parts)
      {
        out.section("[[part]]");
        out.line("name", toml_quoted(part.name));
        out.line("where", field(part.where));
      }
    }

    void write_model(const Case &request, Text &out)
    {
      out.section("[model]");
      const ModelSpec &model = request.model;
      out.elastic = model.kind == ModelSpec::Kind::elasticity;
      out.bending = request.bending();
      const bool projection = model.kind == ModelSpec::Kind::projection;
      out.line("kind", toml_quoted(out.elastic   ? "elasticity"
                                   : projection  ? "projection"
                                   : out.bending ? (request.dimension == 1 ? "beam" : "plate")
                                                 : "membrane"));
      out.line("element", toml_quoted(model.element.name()));
      CoefficientSpecs coefficients = model.coefficients;
      if (out.elastic)
      {
        using Assumption = ModelSpec::Assumption;
        using Integration = ModelSpec::Integration;
        if (request.dimension == 2)
          out.line("assumption", toml_quoted(model.assumption == Assumption::plane_strain   ? "plane strain"
                                             : model.assumption == Assumption::plane_stress ? "plane stress"
                                                                                            : "axisymmetric"));
        out.line("integration", toml_quoted(model.integration == Integration::automatic ? "auto"
                                            : model.integration == Integration::full    ? "full"
                                                                                        : "reduced"));
      }
      else
      {
        if (!coefficients.stiffness && !coefficients.young)
          coefficients.stiffness = {FieldSpec::constant(1)};
        if (!coefficients.velocity && !projection && !out.bending)
          coefficients.velocity = std::vector<FieldSpec>(request.dimension, FieldSpec::constant(0));
        if (!coefficients.reaction && !projection)
          coefficients.reaction = FieldSpec::constant(0);
      }
      if (!coefficients.load)
        coefficients.load = std::vector<FieldSpec>(out.elastic ? request.dimension : 1, FieldSpec::constant(0));
      out.coefficients(coefficients);

      for (const MaterialSpec &material : request.materials)
      {
        out.section("[[material]]");
        out.line("region", toml_quoted(material.region));
        CoefficientSpecs own = material.coefficients;
        own.stiffness = own.stiffness ? own.stiffness : coefficients.stiffness;
        own.velocity = own.velocity ? own.velocity : coefficients.velocity;
        own.reaction = own.reaction ? own.reaction : coefficients.reaction;
        own.young = own.young ? own.young : coefficients.young;
        own.poisson = own.poisson ? own.poisson : coefficients.poisson;
        own.thickness = own.thickness ? own.thickness : coefficients.thickness;
        own.load = own.load ? own.load : coefficients.load;
        out.coefficients(own);
      }
    }

    /// [ux, uy], "symmetry", "free", or what holds besides.
    std::string elastic_condition(const BoundarySpec &condition)
    {
      if (condition.symmetry)
        return toml_quoted("symmetry");
      std::vector<std::string> entries;
      for (std::size_t c = 0; c < condition.components.size(); ++c)
        if (condition.components[c])
          entries.push_back(fmt::format("{} = {}", "xyz"[c], field(*condition.components[c])));
      if (!condition.traction.empty())
        entries.push_back((condition.traction_is_total ? "force = " : "traction = ") + fields(condition.traction));
      if (!condition.moments.empty())
        entries.push_back("moment = " + (condition.moments.size() == 1 ? field(condition.moments[0]) : fields(condition.moments)));
      if (!condition.about.empty())
        entries.push_back("about = " + toml_list(condition.about));
      if (condition.pressure)
        entries.push_back("pressure = " + field(*condition.pressure));
      if (!condition.springs.empty())
        entries.push_back("spring = " + (condition.springs.size() == 1 ? field(condition.springs[0]) : fields(condition.springs)));
      if (condition.rigid)
        entries.push_back("rigid = true");
      if (condition.rigid && condition.rotations.size() == 1 && condition.rotations[0])
        entries.push_back("rotation = " + field(*condition.rotations[0]));
      if (condition.rigid && condition.rotations.size() == 3)
      {
        std::vector<std::string> angles;
        for (unsigned a = 0; a < 3; ++a)
          if (condition.rotations[a])
            angles.push_back(fmt::format("{} = {}", "xyz"[a], field(*condition.rotations[a])));
        if (!angles.empty())
          entries.push_back(fmt::format("rotation = {{ {} }}", fmt::join(angles, ", ")));
      }
      return entries.empty() ? toml_quoted("free") : fmt::format("{{ {} }}", fmt::join(entries, ", "));
    }

    void write_periodic(const std::vector<PeriodicSpec> &periodic, Text &out)
    {
      for (const PeriodicSpec &pair : periodic)
      {
        out.section("[[periodic]]");
        out.line("parts", fmt::format("[{}, {}]", toml_quoted(pair.first), toml_quoted(pair.second)));
        if (!pair.jump.empty())
          out.line("jump", out.elastic ? fields(pair.jump) : field(pair.jump[0]));
      }
    }

    std::string bending_condition(const BoundarySpec &condition)
    {
      if (condition.symmetry)
        return toml_quoted("symmetry");
      std::vector<std::string> entries;
      const auto               add = [&](const char *const name, const std::optional<FieldSpec> &value)
      {
        if (value)
          entries.push_back(fmt::format("{} = {}", name, field(*value)));
      };
      add("value", condition.value);
      add("slope", condition.slope);
      add("spring", condition.spring);
      add("slope_spring", condition.slope_spring);
      add("force", condition.flux);
      add("moment", condition.moment);
      return entries.empty() ? toml_quoted("free") : fmt::format("{{ {} }}", fmt::join(entries, ", "));
    }

    void write_supports_and_loads(const Case &request, Text &out)
    {
      for (const SupportSpec &support : request.supports)
      {
        out.section("[[support]]");
        out.line("at", toml_list(support.at));
        out.line("value", support.value);
        out.line("slope", support.slope);
        out.line("spring", support.spring);
      }
      for (const PointLoad &load : request.point_loads)
      {
        out.section("[[point_load]]");
        out.line("at", toml_list(load.at));
        out.line("force", number(load.force));
        if (request.model.kind == ModelSpec::Kind::beam)
          out.line("moment", number(load.moment));
      }
    }

    void write_boundary(const std::vector<BoundarySpec> &boundary, Text &out)
    {
      out.section("[boundary]");
      for (const BoundarySpec &condition : boundary)
      {
        std::string value = "\"free\"";
        if (out.elastic)
          value = elastic_condition(condition);
        else if (out.bending)
          value = bending_condition(condition);
        else if (condition.value)
          value = field(*condition.value);
        else if (condition.flux || condition.spring)
          value = fmt::format("{{ flux = {}, spring = {} }}", condition.flux ? field(*condition.flux) : "0",
                              condition.spring ? field(*condition.spring) : "0");
        out.line(toml_key(condition.part), value);
      }
      if (std::none_of(boundary.begin(), boundary.end(), [](const BoundarySpec &condition) { return condition.part == "all"; }))
        out.line("all", toml_quoted("free"));
    }

    void write_constraints(const Case &request, Text &out)
    {
      for (const ConstraintSpec &constraint : request.constraints)
      {
        out.section("[[constraint]]");
        out.line("lower", constraint.lower);
        out.line("upper", constraint.upper);
        out.line("gap", constraint.gap);
        if (constraint.surface)
          out.line("gap", surface_text(*constraint.surface));
        if (!constraint.direction.empty())
          out.line("direction", toml_list(constraint.direction));
        if (!constraint.on.empty())
          out.line("on", toml_quoted(constraint.on));
        const unsigned dim = request.dimension - (constraint.on.empty() ? 0 : 1);
        out.line("quadrature", toml_quoted(constraint.quadrature.value_or(default_rule(request.model.element, dim)).name()));
      }
    }

    void write_method(const Method &method, Text &out)
    {
      out.section("[method]");
      out.line("formulation", toml_quoted(method.formulation == Method::Formulation::mixed ? "mixed" : "penalty"));
      out.line("epsilon", method.epsilon ? number(*method.epsilon) : toml_quoted("auto"));
      if (method.penalty_tolerance)
        out.line("penalty_tolerance", number(*method.penalty_tolerance));
      out.line("tolerance", number(method.tolerance));
      out.line("solver", toml_quoted(name_of(method.solver)));
      out.line("max_iterations", std::to_string(method.max_iterations));
    }

    void write_steps(const Case &request, Text &out)
    {
      for (const LoadStep &step : request.steps)
      {
        out.section("[[step]]");
        std::vector<std::string> others;
        for (const StepSetting &setting : step.settings)
          if (setting.key.starts_with("parameters.") && setting.key != "parameters.set")
            out.line(toml_key(setting.key.substr(setting.key.find('.') + 1)), setting.value);
          else
            others.push_back(fmt::format("{} = {}", toml_key(setting.key), setting.value));
        if (!others.empty())
          out.line("set", fmt::format("{{ {} }}", fmt::join(others, ", ")));
      }
    }

    void write_functionals(const Case &request, Text &out)
    {
      for (const auto &functional : request.functionals)
      {
        out.section("[[functional]]");
        out.line("name", toml_quoted(functional.name));
        out.line("integrand", field(functional.integrand));
        out.line("on", toml_quoted(functional.on));
        if (!functional.region.empty())
          out.line("region", toml_quoted(functional.region));
      }
    }

    void write_expectations(const std::vector<Expectation> &expectations, Text &out)
    {
      for (const Expectation &expectation : expectations)
      {
        out.section("[[expect]]");
        out.line("quantity", toml_quoted(expectation.quantity));
        if (expectation.value)
        {
          out.line("value", number(*expectation.value));
          out.line("rtol", number(expectation.rtol));
          out.line("atol", number(expectation.atol));
        }
        out.line("min", expectation.min);
        out.line("max", expectation.max);
      }
    }
  } // namespace

  std::string expand(const Case &request)
  {
    Text out;
    out.line("title", toml_quoted(request.title));
    if (!request.parameters.empty())
    {
      out.section("[parameters]");
      for (const Parameter &parameter : request.parameters)
        out.line(toml_key(parameter.name), field(parameter.value));
    }
    write_steps(request, out);
    write_mesh(request.mesh, out);
    write_model(request, out);
    write_boundary(request.boundary, out);
    write_periodic(request.periodic, out);
    write_supports_and_loads(request, out);
    write_constraints(request, out);
    write_method(request.method, out);
    if (!request.exact.u.empty() || request.exact.pressure)
    {
      out.section("[exact]");
      if (!request.exact.u.empty())
        out.line("u", out.elastic ? fields(request.exact.u) : field(request.exact.u.front()));
      out.line("pressure", request.exact.pressure);
    }
    out.section("[output]");
    std::vector<std::string> probes;
    for (const std::vector<double> &point : request.output.probes)
      probes.push_back(toml_list(point));
    out.line("vtu", request.files.vtu ? "true" : "false");
    out.line("csv", request.files.csv ? "true" : "false");
    out.line("report", request.files.report ? "true" : "false");
    if (!request.steps.empty())
      out.line("every", std::to_string(request.files.every));
    out.line("probes", fmt::format("[{}]", fmt::join(probes, ", ")));
    write_functionals(request, out);
    write_expectations(request.expect, out);
    return out.text;
  }
} // namespace unilateral
