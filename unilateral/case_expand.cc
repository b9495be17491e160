// Case -> TOML, every default written.

#include "unilateral/case_file.h"
#include "unilateral/quadrature_rule.h"

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

    std::string list(const std::vector<double> &values)
    {
      return fmt::format("[{}]", fmt::join(values, ", "));
    }

    /// A basic string of TOML.
    std::string quoted(const std::string &text)
    {
      std::string result = "\"";
      for (const char c : text)
        switch (c)
        {
        case '"':
          result += "\\\"";
          break;
        case '\\':
          result += "\\\\";
          break;
        case '\n':
          result += "\\n";
          break;
        case '\t':
          result += "\\t";
          break;
        case '\r':
          result += "\\r";
          break;
        default:
          if (static_cast<unsigned char>(c) < 0x20 || c == 0x7f)
            result += fmt::format("\\u{:04X}", static_cast<unsigned>(c));
          else
            result += c;
        }
      return result + "\"";
    }

    /// A key, bare where TOML allows it.
    std::string key(const std::string &name)
    {
      const bool bare = !name.empty() && std::all_of(name.begin(), name.end(),
                                                     [](const char c) {
                                                       return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') ||
                                                              c == '_' || c == '-';
                                                     });
      return bare ? name : quoted(name);
    }

    std::string field(const FieldSpec &spec)
    {
      switch (spec.kind)
      {
      case FieldSpec::Kind::constant:
        return number(spec.value);
      case FieldSpec::Kind::expression:
        return quoted(spec.text);
      case FieldSpec::Kind::raster:
      case FieldSpec::Kind::profile:
      {
        std::string text = fmt::format("{{ {} = {}, scale = {}, offset = {}", spec.kind == FieldSpec::Kind::raster ? "raster" : "profile",
                                       quoted(spec.file), spec.scale, spec.offset);
        if (spec.extent)
          text += fmt::format(", extent = [[{}, {}], [{}, {}]]", (*spec.extent)[0][0], (*spec.extent)[0][1], (*spec.extent)[1][0],
                              (*spec.extent)[1][1]);
        if (spec.nodata)
          text += fmt::format(", nodata = {}", *spec.nodata);
        return text + " }";
      }
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

      void coefficients(const Coefficients &c)
      {
        if (c.stiffness)
          line("stiffness", c.stiffness->size() == 1 ? field(c.stiffness->front()) : fields(*c.stiffness));
        if (c.velocity)
          line("velocity", fields(*c.velocity));
        line("reaction", c.reaction);
        line("load", c.load);
      }

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
        out.line("box", fmt::format("[{}, {}]", list(mesh.box_lower), list(mesh.box_upper)));
        out.line("cells", fmt::format("[{}]", fmt::join(mesh.cells, ", ")));
        break;
      case MeshSpec::Source::ball:
        out.line("ball", fmt::format("{{ center = {}, radius = {} }}", list(mesh.center), mesh.radius));
        break;
      case MeshSpec::Source::shell:
        out.line("shell", fmt::format("{{ center = {}, inner = {}, outer = {} }}", list(mesh.center), mesh.inner, mesh.outer));
        break;
      case MeshSpec::Source::file:
        out.line("file", quoted(mesh.file));
        if (mesh.size > 0)
          out.line("size", number(mesh.size));
        break;
      }
      out.line("refine", std::to_string(mesh.refine));
    }

    void write_model(const Case &request, Text &out)
    {
      out.section("[model]");
      out.line("kind", quoted("membrane"));
      out.line("element", quoted(request.model.element.name()));
      Coefficients coefficients = request.model.coefficients;
      if (!coefficients.stiffness)
        coefficients.stiffness = {FieldSpec::constant(1)};
      if (!coefficients.velocity)
        coefficients.velocity = std::vector<FieldSpec>(request.dimension, FieldSpec::constant(0));
      if (!coefficients.reaction)
        coefficients.reaction = FieldSpec::constant(0);
      if (!coefficients.load)
        coefficients.load = FieldSpec::constant(0);
      out.coefficients(coefficients);

      for (const MaterialSpec &material : request.materials)
      {
        out.section("[[material]]");
        out.line("region", quoted(material.region));
        Coefficients own = material.coefficients;
        own.stiffness = own.stiffness ? own.stiffness : coefficients.stiffness;
        own.velocity = own.velocity ? own.velocity : coefficients.velocity;
        own.reaction = own.reaction ? own.reaction : coefficients.reaction;
        own.load = own.load ? own.load : coefficients.load;
        out.coefficients(own);
      }
    }

    void write_boundary(const std::vector<BoundarySpec> &boundary, Text &out)
    {
      out.section("[boundary]");
      for (const BoundarySpec &condition : boundary)
      {
        std::string value = "\"free\"";
        if (condition.value)
          value = field(*condition.value);
        else if (condition.flux || condition.spring)
          value = fmt::format("{{ flux = {}, spring = {} }}", condition.flux ? field(*condition.flux) : "0",
                              condition.spring ? field(*condition.spring) : "0");
        out.line(key(condition.part), value);
      }
      if (std::none_of(boundary.begin(), boundary.end(), [](const BoundarySpec &condition) { return condition.part == "all"; }))
        out.line("all", quoted("free"));
    }

    void write_constraints(const Case &request, Text &out)
    {
      for (const ConstraintSpec &constraint : request.constraints)
      {
        out.section("[[constraint]]");
        out.line("lower", constraint.lower);
        out.line("upper", constraint.upper);
        if (!constraint.on.empty())
          out.line("on", quoted(constraint.on));
        const unsigned dim = request.dimension - (constraint.on.empty() ? 0 : 1);
        out.line("quadrature",
                 quoted(constraint.quadrature.empty() ? default_rule(request.model.element, dim).name() : constraint.quadrature));
      }
    }

    void write_method(const MethodSpec &method, Text &out)
    {
      out.section("[method]");
      out.line("formulation", quoted(method.formulation == MethodSpec::Formulation::mixed ? "mixed" : "penalty"));
      out.line("epsilon", method.epsilon ? number(*method.epsilon) : quoted("auto"));
      if (method.penalty_tolerance)
        out.line("penalty_tolerance", number(*method.penalty_tolerance));
      out.line("tolerance", number(method.tolerance));
      out.line("solver", quoted(method.solver));
      out.line("max_iterations", std::to_string(method.max_iterations));
    }

    void write_expectations(const std::vector<Expectation> &expectations, Text &out)
    {
      for (const Expectation &expectation : expectations)
      {
        out.section("[[expect]]");
        out.line("quantity", quoted(expectation.quantity));
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
    out.line("title", quoted(request.title));
    if (!request.parameters.empty())
    {
      out.section("[parameters]");
      for (const Parameter &parameter : request.parameters)
        out.line(key(parameter.name), field(parameter.value));
    }
    write_mesh(request.mesh, out);
    write_model(request, out);
    write_boundary(request.boundary, out);
    write_constraints(request, out);
    write_method(request.method, out);
    if (request.exact.u || request.exact.pressure)
    {
      out.section("[exact]");
      out.line("u", request.exact.u);
      out.line("pressure", request.exact.pressure);
    }
    out.section("[output]");
    std::vector<std::string> probes;
    for (const std::vector<double> &point : request.output.probes)
      probes.push_back(list(point));
    out.line("probes", fmt::format("[{}]", fmt::join(probes, ", ")));
    write_expectations(request.expect, out);
    return out.text;
  }
} // namespace unilateral
