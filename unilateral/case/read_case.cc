#include "unilateral/case/read_case.h"
#include "unilateral/case/problem_of_case.h"

#include "unilateral/base/sha256.h"
#include "unilateral/case/box_sides.h"
#include "unilateral/case/case_check.h"
#include "unilateral/case/expectations.h"
#include "unilateral/case/given_data.h"
#include "unilateral/case/read_coefficients.h"
#include "unilateral/case/read_condition.h"
#include "unilateral/case/read_field.h"
#include "unilateral/case/read_mesh.h"
#include "unilateral/case/read_output.h"
#include "unilateral/case/read_periodic.h"
#include "unilateral/case/read_steps.h"
#include "unilateral/case/read_surface.h"
#include "unilateral/discretisation/regions_and_parts.h"
#include "unilateral/functions/field_function.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cerrno>
#include <cmath>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <limits>
#include <sstream>

namespace unilateral
{
  namespace
  {
    constexpr std::uintmax_t max_bytes = 16u << 20;
    constexpr std::size_t    max_parameters = 1000;

    const TomlValue &empty_table()
    {
      static const TomlValue table;
      return table;
    }

    /// Reads the sections into a Case, in the order in which they need each other.
    class CaseReader
    {
    public:
      /// @p file is the path as the user typed it, for messages. @p mesh_known: @p request has what [mesh] and [[part]] say.
      CaseReader(const TomlValue &document, const std::string &file, Case &request, Diagnostics &diagnostics, const bool mesh_known = false)
        : top(document, "the case file", diagnostics), request(request), file(file), mesh_known(mesh_known),
          folder(std::filesystem::path(request.path).parent_path().string()), diagnostics(diagnostics)
      {
      }

      void read()
      {
        request.title = top.string("title").value_or("");
        read_parameters();
        if (!mesh_known)
        {
          read_mesh_section();
          read_parts();
        }
        read_model();
        read_boundary();
        read_materials();
        if (const auto pairs = sections("periodic"); supported)
          read_periodic(pairs, folder, request, diagnostics);
        read_supports();
        read_point_loads();
        read_constraints();
        read_method();
        read_exact();
        read_output(section("output"), request, diagnostics);
        read_functionals(sections("functional"), folder, request, diagnostics);
        read_expectations(sections("expect"), request, diagnostics);
        for (const char *const key : {"mesh", "part", "step", "steps"}) // read elsewhere, or before
          top.find(key);
        if (!top.has_or_misspells("mesh"))
          diagnostics.error({file, 1, 1}, "section [mesh] is missing; for example box = [[0, 0], [1, 1]]", MessageName("missing-key"));
        if (!top.has_or_misspells("model"))
          diagnostics.error({file, 1, 1}, "section [model] is missing; it names the kind: kind = \"membrane\"", MessageName("missing-key"));
        top.finish();
      }

    private:
      /// The table of a section that may appear once; an empty one when it is absent.
      const TomlValue &section(const std::string &name)
      {
        const TomlValue *value = top.find(name);
        if (value == nullptr)
          return empty_table();
        if (value->kind == TomlValue::Kind::table)
          return *value;
        if (value->kind == TomlValue::Kind::array)
          diagnostics.error(value->where, fmt::format("[{0}] may appear only once; write [{0}], not [[{0}]]", name),
                            MessageName("wrong-type"));
        else
          diagnostics.error(value->where, fmt::format("'{0}' must be a table [{0}], not {1}", name, value->kind_name()),
                            MessageName("wrong-type"));
        return empty_table();
      }

      std::vector<const TomlValue *> sections(const std::string &name)
      {
        const TomlValue *value = top.find(name);
        return value ? read_tables(*value, name, diagnostics) : std::vector<const TomlValue *>();
      }

      std::optional<FieldSpec> field(TableReader &table, const std::string &key)
      {
        const TomlValue *value = table.find(key);
        return value ? read_field(*value, key, folder, diagnostics) : std::nullopt;
      }

      void read_parameters()
      {
        const TomlValue &table = section("parameters");
        if (table.entries.size() > max_parameters)
        {
          diagnostics.error(table.where, fmt::format("more than {} parameters", max_parameters), MessageName("out-of-range"));
          return;
        }
        for (const TomlEntry &entry : table.entries)
        {
          Parameter  parameter{entry.key, {}, entry.where};
          const bool has_value = entry.value.kind == TomlValue::Kind::integer || entry.value.kind == TomlValue::Kind::real ||
                                 entry.value.kind == TomlValue::Kind::string || entry.value.kind == TomlValue::Kind::table;
          if (!has_value)
            diagnostics.error(
              entry.value.where,
              fmt::format("parameter '{}' must be a number, an expression in quotes, or a table with raster, profile, run or previous, not "
                          "{}",
                          entry.key, entry.value.kind_name()),
              MessageName("wrong-type"));
          else if (auto value = read_field(entry.value, entry.key, folder, diagnostics))
            parameter.value = std::move(*value);
          // Kept even without a value, or every use of the name would be an error more.
          request.parameters.push_back(std::move(parameter));
        }
      }

      void read_mesh_section()
      {
        if (const TomlValue &table = section("mesh"); &table != &empty_table())
        {
          MeshOutline outline = read_mesh(table, folder, request.given.mesh, request.mesh, diagnostics);
          request.dimension = outline.dimension;
          request.part_names = std::move(outline.part_names);
          request.region_names = std::move(outline.region_names);
        }
      }

      /// [[part]]: parts of the boundary by where they are.
      void read_parts()
      {
        for (const TomlValue *content : sections("part"))
        {
          TableReader            table(*content, "[[part]]", diagnostics);
          PartByPlace<FieldSpec> part;
          if (const auto name = table.string("name"))
          {
            part.name = *name;
            if (name->empty() || *name == "all" || *name == "domain")
              diagnostics.error(table.find("name")->where, fmt::format("a part cannot be called '{}'", *name), MessageName("out-of-range"));
          }
          const auto where = field(table, "where");
          for (const char *const key : {"name", "where"})
            if (!table.has_or_misspells(key))
              diagnostics.error(content->where,
                                fmt::format("'{}' is missing in [[part]]; for example name = \"foot\", where = \"y == 0 && x < 0.2\"", key),
                                MessageName("missing-key"));
          table.finish();
          if (part.name.empty() || !where)
            continue;
          part.where = *where;
          if (request.dimension > 0 &&
              std::find(request.part_names.begin(), request.part_names.end(), part.name) == request.part_names.end())
            request.part_names.push_back(part.name);
          request.mesh.parts.push_back(std::move(part));
        }
      }

      bool elastic() const { return request.model.kind == ModelSpec::Kind::elasticity; }
      bool bending() const { return request.bending(); }
      bool plate() const { return request.model.kind == ModelSpec::Kind::plate; }

      /// at = [..] of a support or point load.
      std::vector<double> read_place(TableReader &table, const TomlValue &content)
      {
        const TomlValue *value = table.find("at");
        if (value == nullptr)
        {
          if (!table.has_or_misspells("at"))
            diagnostics.error(content.where, fmt::format("'at' is missing in {}", table.section), MessageName("missing-key"));
          return {};
        }
        std::optional<std::vector<double>> at;
        if (value->kind != TomlValue::Kind::array && request.dimension == 1)
        {
          if (const auto x = read_number(*value, "at", diagnostics))
            at = std::vector<double>{*x};
        }
        else
          at = read_numbers(*value, "at", diagnostics);
        if (at && request.dimension > 0 && at->size() != request.dimension)
        {
          diagnostics.error(
            value->where, fmt::format("'at' has {} coordinates on a {}-D mesh, {} here", request.dimension, request.dimension, at->size()),
            MessageName("wrong-length"));
          return {};
        }
        return at.value_or(std::vector<double>());
      }

      void read_supports()
      {
        for (const TomlValue *content : sections("support"))
        {
          if (!supported)
            continue;
          TableReader table(*content, "[[support]]", diagnostics);
          SupportSpec support;
          support.where = content->where;
          support.at = read_place(table, *content);
          support.value = field(table, "value");
          support.slope = field(table, "slope");
          support.spring = field(table, "spring");
          table.finish();
          if (request.model.kind != ModelSpec::Kind::beam)
            diagnostics.error(content->where, "[[support]] is for kind = \"beam\"", MessageName("kind-does-not-fit"));
          else if (!support.value && !support.slope && !support.spring)
            diagnostics.error(content->where, "[[support]] holds nothing; give value, slope or spring", MessageName("does-nothing"));
          if (!support.at.empty())
            request.supports.push_back(std::move(support));
        }
      }

      void read_point_loads()
      {
        for (const TomlValue *content : sections("point_load"))
        {
          if (!supported)
            continue;
          TableReader table(*content, "[[point_load]]", diagnostics);
          PointLoad   load;
          load.where = content->where;
          load.at = read_place(table, *content);
          load.force = table.number("force").value_or(0);
          if (request.model.kind == ModelSpec::Kind::beam)
            load.moment = table.number("moment").value_or(0);
          else
            table.refuse("moment", "only beams have it");
          table.finish();
          if (!bending())
            diagnostics.error(content->where, "[[point_load]] is for beams and plates: elsewhere the solution would be infinite there",
                              MessageName("kind-does-not-fit"));
          else if (load.force == 0 && load.moment == 0)
            diagnostics.error(content->where, "[[point_load]] loads nothing; give force or moment", MessageName("does-nothing"));
          if (!load.at.empty())
            request.point_loads.push_back(std::move(load));
        }
      }

      bool projection() const { return request.model.kind == ModelSpec::Kind::projection; }

      void read_model()
      {
        const TomlValue *value = top.find("model");
        const TomlValue &content = section("model");
        TableReader      table(content, "[model]", diagnostics);
        auto             kind = table.choice("kind", kind_names());
        const bool       misspelt = !kind && table.find("kind");
        if (misspelt && table.find("kind")->kind == TomlValue::Kind::string)
          kind = did_you_mean(table.find("kind")->string, kind_names().available);
        if (misspelt && (!kind || kind->empty()))
          supported = false;
        if (kind && !kind->empty())
        {
          request.model.where = table.find("kind")->where;
          if (*kind == "elasticity")
            request.model.kind = ModelSpec::Kind::elasticity;
          using Kind = ModelSpec::Kind;
          for (const auto &[name, known] :
               {std::pair("projection", Kind::projection), std::pair("beam", Kind::beam), std::pair("plate", Kind::plate)})
            if (*kind == name)
              request.model.kind = known;
          supported = *kind == "membrane" || *kind == "projection" || bending() || elastic();
        }
        const bool kind_is_missing = table.find("kind") == nullptr && value && value->kind == TomlValue::Kind::table;
        // What follows depends on the kind. A misspelt one is read on as what was meant, a missing one as a membrane; of one that means
        // nothing no more is said.
        if (!supported)
          return;
        if (bending())
          request.model.element = {ElementName::Family::hermite, 3};
        if (projection())
          request.model.element = {ElementName::Family::discontinuous, 1};
        if (const auto element = table.string("element"))
        {
          request.model.element_where = table.find("element")->where;
          if (const auto known = parse_element(*element))
            request.model.element = *known;
          else
            diagnostics.error(request.model.element_where,
                              fmt::format("unknown element '{}'; known: {}", *element, element_names_text(request)),
                              MessageName("unknown-choice"));
        }
        request.model.coefficients = read_coefficients(table, request, folder, diagnostics);
        if (elastic())
          read_assumption(table);
        if (kind_is_missing && !table.has_or_misspells("kind"))
          diagnostics.error(content.where, "'kind' is missing in [model]; for example kind = \"membrane\"", MessageName("missing-key"));
        table.finish();
      }

      void read_assumption(TableReader &table)
      {
        using Assumption = ModelSpec::Assumption;
        if (const auto assumption = table.choice("assumption", {{"plane strain", "plane stress", "axisymmetric"}, {}}))
        {
          request.model.assumption = *assumption == "plane stress"   ? Assumption::plane_stress
                                     : *assumption == "axisymmetric" ? Assumption::axisymmetric
                                                                     : Assumption::plane_strain;
          if (request.dimension != 0 && request.dimension != 2)
            diagnostics.error(table.find("assumption")->where,
                              fmt::format("'assumption' is for 2-D meshes, this one is {}-D", request.dimension),
                              MessageName("kind-does-not-fit"));
        }
        using Integration = ModelSpec::Integration;
        if (const auto integration = table.choice("integration", {{"auto", "full", "reduced"}, {}}))
        {
          request.model.integration = *integration == "full"      ? Integration::full
                                      : *integration == "reduced" ? Integration::reduced
                                                                  : Integration::automatic;
          if (*integration == "reduced" && request.model.element.simplex() && request.model.element.degree > 2)
            diagnostics.error(table.find("integration")->where, "reduced integration is for degree 1 and 2 on triangles and tetrahedra",
                              MessageName("element-does-not-fit"));
        }
      }

      void read_materials()
      {
        for (const TomlValue *content : sections("material"))
        {
          if (!supported)
            continue;
          TableReader  table(*content, "[[material]]", diagnostics);
          MaterialSpec material;
          material.where = content->where;
          if (const auto region = table.string("region"))
          {
            material.region = *region;
            material.where = table.find("region")->where;
            for (const MaterialSpec &other : request.materials)
              if (other.region == material.region)
                diagnostics.error(material.where,
                                  fmt::format("region '{}' has a [[material]] already, in line {}", *region, other.where.line),
                                  MessageName("contradiction"));
          }
          material.coefficients = read_coefficients(table, request, folder, diagnostics);
          if (!table.has_or_misspells("region"))
            diagnostics.error(content->where, "'region' is missing in [[material]]; it names the part of the mesh that is made of it",
                              MessageName("missing-key"));
          table.finish();
          request.materials.push_back(std::move(material));
        }
      }

      void read_boundary()
      {
        const TomlValue &content = section("boundary");
        if (!supported)
          return;
        for (const TomlEntry &entry : content.entries)
        {
          BoundarySpec condition;
          condition.part = entry.key;
          condition.where = entry.where;
          read_condition(entry.value, request, folder, condition, diagnostics);
          request.boundary.push_back(std::move(condition));
        }
      }

      /// gap and direction of [constraint]
      void read_gap(TableReader &table, const TomlValue &content, ConstraintSpec &constraint)
      {
        if (const TomlValue *gap = table.find("gap"))
        {
          if (is_surface(*gap))
            constraint.surface = read_surface(*gap, "gap", request.dimension, folder, diagnostics);
          else
            constraint.gap = read_field(*gap, "gap", folder, diagnostics);
        }
        if (const TomlValue *value = table.find("direction"))
          if (const auto direction = read_numbers(*value, "direction", diagnostics))
          {
            if (request.dimension > 0 && direction->size() != request.dimension)
              diagnostics.error(
                value->where,
                fmt::format("'direction' has {} entries in {}-D, {} here", request.dimension, request.dimension, direction->size()),
                MessageName("wrong-length"));
            else if (std::all_of(direction->begin(), direction->end(), [](const double d) { return d == 0; }))
              diagnostics.error(value->where, "'direction' must not be zero", MessageName("out-of-range"));
            else
              constraint.direction = *direction;
          }
        for (const char *const key : {"lower", "upper"})
          table.refuse(key, "belongs to kind = \"membrane\"; an elastic body has a gap: u.n <= gap");
        if (!table.has_or_misspells("gap") && std::none_of(content.entries.begin(), content.entries.end(),
                                                           [](const TomlEntry &e) { return e.key == "lower" || e.key == "upper"; }))
          diagnostics.error(content.where,
                            "'gap' is missing in [constraint]; for example gap = 0, \"x^2/2\" or { plane = { point = .., "
                            "normal = .. } }",
                            MessageName("missing-key"));
        if (!table.has_or_misspells("on"))
          diagnostics.error(content.where, "'on' is missing in [constraint]; it names the part of the boundary that may touch",
                            MessageName("missing-key"));
      }

      void read_constraints()
      {
        for (const TomlValue *content : sections("constraint"))
        {
          if (!supported)
            continue;
          TableReader    table(*content, "[constraint]", diagnostics);
          ConstraintSpec constraint;
          constraint.where = content->where;
          if (!elastic())
          {
            constraint.lower = field(table, "lower");
            constraint.upper = field(table, "upper");
          }
          if (const auto on = table.string("on"))
          {
            constraint.on = *on;
            constraint.on_where = table.find("on")->where;
            if (bending())
              diagnostics.error(constraint.on_where, "beams and plates are bounded in the domain, not on a part of the boundary",
                                MessageName("kind-does-not-fit"));
            else if (projection())
              diagnostics.error(constraint.on_where, "a projection is bounded in the domain, not on a part of its boundary",
                                MessageName("kind-does-not-fit"));
            else if (on->empty())
              diagnostics.error(constraint.on_where, "'on' must be the name of a part of the boundary; leave it out for the whole domain",
                                MessageName("wrong-type"));
          }
          if (const auto quadrature = table.string("quadrature"))
          {
            constraint.quadrature = parse_rule(*quadrature);
            constraint.quadrature_where = table.find("quadrature")->where;
            if (!constraint.quadrature)
              diagnostics.error(constraint.quadrature_where, why_no_rule(*quadrature), MessageName("unknown-choice"));
          }
          if (elastic())
            read_gap(table, *content, constraint);
          else
            for (const char *const key : {"gap", "direction"})
              table.refuse(key, "belongs to kind = \"elasticity\"; a membrane has lower and upper");
          if (!elastic() && !table.has_or_misspells("lower") && !table.has_or_misspells("upper") &&
              std::none_of(content->entries.begin(), content->entries.end(), [](const TomlEntry &e) { return e.key == "gap"; }))
            diagnostics.error(content->where, "[constraint] bounds nothing; give lower or upper or both", MessageName("does-nothing"));
          table.finish();
          request.constraints.push_back(std::move(constraint));
        }
      }

      void read_method()
      {
        TableReader table(section("method"), "[method]", diagnostics);
        Method     &method = request.method;
        if (const auto formulation = table.choice("formulation", {{"penalty", "mixed"}, {}}))
          method.formulation = *formulation == "mixed" ? Method::Formulation::mixed : Method::Formulation::penalty;
        if (const TomlValue *epsilon = table.find("epsilon"))
        {
          if (epsilon->kind == TomlValue::Kind::string && epsilon->string == "auto")
            ;
          else if (epsilon->kind == TomlValue::Kind::string)
            diagnostics.error(epsilon->where, "'epsilon' must be a positive number or \"auto\"", MessageName("wrong-type"));
          else if (const auto number = read_number(*epsilon, "epsilon", diagnostics))
          {
            if (*number > 0)
              method.epsilon = *number;
            else
              diagnostics.error(epsilon->where, fmt::format("'epsilon' must be positive, it is {}; \"auto\" chooses it", *number),
                                MessageName("out-of-range"));
          }
        }
        if (const auto tolerance = table.number("penalty_tolerance"))
        {
          if (*tolerance > 0 && *tolerance < 1)
            method.penalty_tolerance = *tolerance;
          else
            diagnostics.error(table.find("penalty_tolerance")->where,
                              fmt::format("'penalty_tolerance' must lie between 0 and 1, it is {}", *tolerance),
                              MessageName("out-of-range"));
        }
        if (const auto tolerance = table.number("tolerance"))
        {
          if (*tolerance > 0 && *tolerance < 1)
            method.tolerance = *tolerance;
          else
            diagnostics.error(table.find("tolerance")->where, fmt::format("'tolerance' must lie between 0 and 1, it is {}", *tolerance),
                              MessageName("out-of-range"));
        }
        if (const auto solver = table.choice("solver", solver_names()))
        {
          method.solver = solver_called(*solver).value_or(method.solver);
          method.solver_where = table.find("solver")->where;
        }
        if (const auto n = table.whole_number("max_iterations", 1, 1'000'000))
          method.max_iterations = *n;
        table.finish();
      }

      void read_exact()
      {
        TableReader table(section("exact"), "[exact]", diagnostics);
        if (!supported)
          return;
        if (const TomlValue *u = table.find("u"))
        {
          if (elastic())
            request.exact.u = read_components(*u, "u", request.dimension, folder, diagnostics).value_or(std::vector<FieldSpec>());
          else if (auto scalar = read_field(*u, "u", folder, diagnostics))
            request.exact.u = {std::move(*scalar)};
        }
        request.exact.pressure = field(table, "pressure");
        table.finish();
      }

      TableReader       top;
      Case             &request;
      std::string       file;
      const bool        mesh_known;
      const std::string folder;
      Diagnostics      &diagnostics;
      bool              supported = true; ///< whether the sections that depend on the kind can be read
    };

    /// @p name stands in @p text, not only as a part of a longer name.
    bool has_word(const std::string &text, const std::string &name)
    {
      const auto in_name = [](const char c) { return std::isalnum(static_cast<unsigned char>(c)) || c == '_'; };
      for (std::size_t at = text.find(name); at != std::string::npos; at = text.find(name, at + 1))
        if ((at == 0 || !in_name(text[at - 1])) && (at + name.size() == text.size() || !in_name(text[at + name.size()])))
          return true;
      return false;
    }

    /// What stands beside a case and may use its parameters: the values of overrides, expressions of the program.
    std::vector<std::string> texts_beside(const std::vector<Override> &overrides, const GivenData &given)
    {
      std::vector<std::string> texts = given.expressions;
      for (const auto &[key, value] : overrides)
        texts.push_back(value);
      return texts;
    }

    bool one_has_word(const std::vector<std::string> &texts, const std::string &name)
    {
      return std::any_of(texts.begin(), texts.end(), [&](const std::string &text) { return has_word(text, name); });
    }

    /// Warns of [parameters] that neither the rest of the case nor a text beside it has as a word.
    void warn_about_unused_parameters(const TomlValue &document, const std::vector<std::string> &beside, Diagnostics &diagnostics)
    {
      const TomlValue *const parameters = document.find("parameters");
      if (!parameters || parameters->kind != TomlValue::Kind::table)
        return;
      for (const TomlEntry &parameter : parameters->entries)
      {
        if (parameter.where.file.starts_with("--set"))
          continue; // see warn_about_unused_overrides()
        TomlValue rest = document;
        std::erase_if(rest.find("parameters")->entries, [&](const TomlEntry &entry) { return entry.key == parameter.key; });
        const std::string text = to_toml(rest);
        if (!has_word(text, parameter.key) && !one_has_word(beside, parameter.key))
          diagnostics.warning(parameter.where, fmt::format("nothing in the case uses the parameter '{}'", parameter.key),
                              MessageName("does-nothing"));
      }
    }

    /// Warns of --set parameters.NAME where [parameters] has no NAME and neither the case nor a text beside it has this word.
    void warn_about_unused_overrides(const TomlValue                &document,
                                     const std::vector<Override>    &overrides,
                                     const std::vector<std::string> &beside,
                                     Diagnostics                    &diagnostics)
    {
      const TomlValue *const   parameters = document.find("parameters");
      std::vector<std::string> known;
      for (const TomlEntry &entry : parameters ? parameters->entries : std::vector<TomlEntry>())
        known.push_back(entry.key);
      const std::string text = to_toml(document);
      for (const auto &[key, value] : overrides)
      {
        const std::vector<std::string> words = split_path(key);
        if (words.size() < 2 || words[0] != "parameters" || std::find(known.begin(), known.end(), words[1]) != known.end())
          continue;
        if (has_word(text, words[1]) || one_has_word(beside, words[1]))
          continue;
        diagnostics.warning({"--set " + key, 0, 0},
                            fmt::format("[parameters] has no '{}', and nothing uses it{}", words[1], suggestion(words[1], known)),
                            MessageName("does-nothing"));
      }
    }
  } // namespace

  Case parse_case(const std::string           &text,
                  const std::string           &path,
                  const std::vector<Override> &overrides,
                  Diagnostics                 &diagnostics,
                  const GivenData             &given)
  {
    Case request;
    request.given = given;
    request.path = std::filesystem::absolute(path).lexically_normal().string();
    request.name = std::filesystem::path(request.path).stem().string();
    request.sha256 = sha256(text);
    for (const auto &[key, value] : overrides)
      request.settings.push_back(fmt::format("{}={}", key, value));

    TomlValue                      document = parse_toml(text, path);
    Diagnostics                    found;
    const std::vector<std::string> beside = texts_beside(overrides, given);
    warn_about_unused_overrides(document, overrides, beside, found);
    for (const Override &assignment : overrides)
      set_value(document, assignment, found);
    insert_given_functions(document, given, found);
    CaseReader(document, path, request, found).read();
    use_names_of_mesh(request, found);
    check_case(request, found);
    StepFields fields;
    fields.has_steps = document.find("step") || document.find("steps");
    check_couplings(problem_of(request, found, fields), found);
    const StepReader read_step = [&](const TomlValue &other, Diagnostics &in_step)
    {
      Case step;
      static_cast<CaseSource &>(step) = request;
      step.given = request.given;
      step.name = request.name;
      step.mesh = request.mesh;
      step.dimension = request.dimension;
      step.part_names = request.part_names;
      step.region_names = request.region_names;
      CaseReader(other, path, step, in_step, /*mesh_known=*/true).read();
      use_names_of_mesh(step, in_step);
      return step;
    };
    read_steps(document, std::filesystem::path(request.path).parent_path().string(), read_step, request, found);
    warn_about_overrides_in_steps(request, overrides, found);
    check_expectations(request, found);
    found.throw_if_errors();
    warn_about_unused_parameters(document, beside, found);
    for (const Diagnostic &message : sorted_by_place(found.all()))
      diagnostics.warning(message.where, message.message, message.name);
    return request;
  }

  Case read_case(const std::string &path, const std::vector<Override> &overrides, Diagnostics &diagnostics, const GivenData &given)
  {
    std::error_code failure;
    const auto      status = std::filesystem::status(path, failure);
    if (path == "-" && !std::filesystem::exists(status))
      throw InputError(
        {path, 0, 0},
        "a case is not read from standard input: files that it names lie relative to its own place; write it to a file first, "
        "... > case.toml",
        MessageName("file-not-found"));
    if (!std::filesystem::exists(status))
      throw InputError({path, 0, 0}, "there is no such file", MessageName("file-not-found"));
    if (std::filesystem::is_directory(status))
      throw InputError({path, 0, 0}, "this is a folder, not a case file", MessageName("file-not-found"));
    // A pipe would be waited for, a device may never end.
    if (!std::filesystem::is_regular_file(status))
      throw InputError({path, 0, 0}, "this is no ordinary file but a pipe or a device; write the case to a file first",
                       MessageName("file-not-found"));
    const std::string ending = std::filesystem::path(path).extension().string();
    if (const auto meshes = {".msh", ".geo", ".step", ".stp", ".brep"}; std::find(meshes.begin(), meshes.end(), ending) != meshes.end())
      throw InputError({path, 0, 0}, "this is a mesh, not a case; write a case about it with: unilateral init KIND --mesh FILE",
                       MessageName("toml-syntax"));
    std::ifstream in(path, std::ios::binary);
    if (!in)
      throw InputError({path, 0, 0}, fmt::format("the file cannot be opened: {}", std::strerror(errno)), MessageName("file-not-found"));
    std::string text;
    text.resize(max_bytes + 1);
    in.read(text.data(), static_cast<std::streamsize>(text.size()));
    text.resize(static_cast<std::size_t>(in.gcount()));
    if (text.size() > max_bytes)
      throw InputError({path, 0, 0}, fmt::format("the file is larger than {} MB, it is no case file", max_bytes >> 20),
                       MessageName("file-too-large"));
    return parse_case(text, path, overrides, diagnostics, given);
  }
} // namespace unilateral
