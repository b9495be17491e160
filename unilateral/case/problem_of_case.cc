#include "unilateral/case/problem_of_case.h"

#include "unilateral/case/load_steps.h"
#include "unilateral/evaluation/solution_quantities.h"
#include "unilateral/functions/compile_field.h"
#include "unilateral/functions/expression.h"
#include "unilateral/functions/integrand.h"

#include <fmt/format.h>

#include <map>
#include <stdexcept>
#include <string>
#include <utility>

namespace unilateral
{
  namespace
  {
    /// Compiles the functions of a case; what is wrong with them goes to the diagnostics.
    class FieldCompiler
    {
    public:
      FieldCompiler(const std::vector<Parameter> &parameters, const unsigned dim, StepFields &fields, Diagnostics &diagnostics)
        : parameters(parameters), dim(dim), fields(fields), diagnostics(diagnostics)
      {
        Diagnostics in_parameters;
        check_parameters(parameters, dim, in_parameters);
        if (!in_parameters.has_errors())
          compiled_parameters =
            std::make_shared<CompiledParameters>(parameters, dim, [this](const FieldSpec &spec) { return remembered(spec); });
        diagnostics.add_errors(in_parameters.all());
        // What is wrong with a file is said once, not for every use.
        const std::size_t n_before = diagnostics.all().size();
        for (const Parameter &parameter : parameters)
          if (is_sampled(parameter.value))
            (*this)(parameter.value);
        if (diagnostics.all().size() > n_before)
          compiled_parameters.reset();
      }
      FieldCompiler(const FieldCompiler &) = delete;
      FieldCompiler &operator=(const FieldCompiler &) = delete;

      FieldFunction operator()(const FieldSpec &spec)
      {
        if (spec.kind == FieldSpec::Kind::raster && dim == 1)
          diagnostics.error(spec.where, "a raster is a function of x and y; a 1-D mesh takes { profile = \"file.csv\" }",
                            MessageName("kind-does-not-fit"));
        else if (spec.kind == FieldSpec::Kind::profile && dim > 1)
          diagnostics.error(spec.where, "a profile is a function of x on a 1-D mesh; elsewhere take { raster = \"file\" }",
                            MessageName("kind-does-not-fit"));
        else if (spec.kind == FieldSpec::Kind::given)
          return given_function(spec);
        else if (spec.kind == FieldSpec::Kind::expression && !compiled_parameters)
          // What is wrong with the parameters has been said; compiling would say it again for every use.
          parse_expression(spec, parameters, dim, diagnostics);
        else
          try
          {
            return remembered(spec);
          }
          catch (const InputError &e)
          {
            diagnostics.add_errors(e.diagnostics);
          }
        return {0., spec.where};
      }

      std::optional<FieldFunction> operator()(const std::optional<FieldSpec> &spec)
      {
        if (!spec)
          return {};
        return (*this)(*spec);
      }

      template <typename Spec>
      auto operator()(const std::vector<Spec> &specs)
      {
        std::vector<decltype((*this)(specs[0]))> functions;
        for (const Spec &spec : specs)
          functions.push_back((*this)(spec));
        return functions;
      }

      std::optional<std::vector<FieldFunction>> operator()(const std::optional<std::vector<FieldSpec>> &specs)
      {
        if (!specs)
          return {};
        return (*this)(*specs);
      }

      /// What was compiled is known to the next step, what was not is forgotten.
      void remember() { fields.compiled = std::move(now); }

      RefinedMeshOf<FieldFunction> operator()(const MeshSpec &mesh)
      {
        RefinedMeshOf<FieldFunction> result{mesh, mesh.refine, mesh.compared_with_finer, {}, mesh.adapt, {}};
        for (const auto &refinement : mesh.local)
          result.local.push_back({(*this)(refinement.where), refinement.times});
        for (const auto &part : mesh.parts)
          result.parts.push_back({part.name, (*this)(part.where)});
        return result;
      }

      Coefficients operator()(const CoefficientSpecs &c)
      {
        return {.stiffness = (*this)(c.stiffness),
                .velocity = (*this)(c.velocity),
                .reaction = (*this)(c.reaction),
                .young = (*this)(c.young),
                .poisson = (*this)(c.poisson),
                .thickness = (*this)(c.thickness),
                .load = (*this)(c.load)};
      }

      Model operator()(const ModelSpec &model)
      {
        return {{},          model.kind,         model.assumption, model.integration, model.element, (*this)(model.coefficients),
                model.where, model.element_where};
      }

      Material operator()(const MaterialSpec &material) { return {material.region, (*this)(material.coefficients), material.where}; }

      BoundaryCondition operator()(const BoundarySpec &condition)
      {
        return {.part = condition.part,
                .value = (*this)(condition.value),
                .flux = (*this)(condition.flux),
                .spring = (*this)(condition.spring),
                .components = (*this)(condition.components),
                .symmetry = condition.symmetry,
                .traction = (*this)(condition.traction),
                .traction_is_total = condition.traction_is_total,
                .moments = (*this)(condition.moments),
                .about = condition.about,
                .pressure = (*this)(condition.pressure),
                .springs = (*this)(condition.springs),
                .rigid = condition.rigid,
                .rotations = (*this)(condition.rotations),
                .slope = (*this)(condition.slope),
                .moment = (*this)(condition.moment),
                .slope_spring = (*this)(condition.slope_spring),
                .where = condition.where};
      }

      PeriodicParts operator()(const PeriodicSpec &parts)
      {
        return {parts.first, parts.second, (*this)(parts.jump), parts.where, parts.first_where, parts.second_where};
      }

      InnerSupport operator()(const SupportSpec &support)
      {
        return {support.at, (*this)(support.value), (*this)(support.slope), (*this)(support.spring), support.where};
      }

      UnilateralBound operator()(const ConstraintSpec &constraint)
      {
        return {.lower = (*this)(constraint.lower),
                .upper = (*this)(constraint.upper),
                .gap = (*this)(constraint.gap),
                .surface = constraint.surface,
                .direction = constraint.direction,
                .on = constraint.on,
                .quadrature = constraint.quadrature,
                .where = constraint.where,
                .on_where = constraint.on_where,
                .quadrature_where = constraint.quadrature_where};
      }

      Functional operator()(const FunctionalOf<FieldSpec> &functional, const std::vector<std::string> &quantities)
      {
        const FieldSpec &spec = functional.integrand;
        Functional       result{functional.name, {}, functional.on, functional.region, functional.where};
        if (spec.kind == FieldSpec::Kind::expression && !compiled_parameters)
          parse_expression(spec, parameters, dim, diagnostics, quantities);
        else
          try
          {
            result.integrand = compile_integrand(spec, compiled_parameters, quantities);
          }
          catch (const InputError &e)
          {
            diagnostics.add_errors(e.diagnostics);
          }
        return result;
      }

    private:
      FieldFunction given_function(const FieldSpec &spec)
      {
        try
        {
          return {spec.given->in_dimension(dim), spec.where};
        }
        catch (const std::runtime_error &e)
        {
          diagnostics.error(spec.where, fmt::format("{}: {}", spec.given->name(), e.what()), MessageName("given-by-program"));
        }
        return {0., spec.where};
      }

      /// As the step before has it, where nothing that it is made of has changed.
      FieldFunction remembered(const FieldSpec &spec)
      {
        if (spec.kind == FieldSpec::Kind::given)
          return given_function(spec);
        if (spec.kind == FieldSpec::Kind::constant || depends_on_previous(spec, parameters))
          return compiled(spec);
        const std::string identity = identity_of(spec, parameters);
        if (const auto known = now.find(identity); known != now.end())
          return known->second;
        const auto before = fields.compiled.find(identity);
        return now.emplace(identity, before != fields.compiled.end() ? before->second : compiled(spec)).first->second;
      }

      FieldFunction compiled(const FieldSpec &spec)
      {
        if (spec.kind == FieldSpec::Kind::previous && fields.has_steps && !fields.previous)
          return before_the_first_step(spec);
        if (spec.kind == FieldSpec::Kind::run || spec.kind == FieldSpec::Kind::previous)
          return solution_field(spec, dim, fields);
        return compile_field_sharing(compiled_parameters, spec);
      }

      FieldFunction before_the_first_step(const FieldSpec &spec)
      {
        const FieldFunction initial = spec.initial ? compiled(*spec.initial) : FieldFunction(0., spec.where);
        if (spec.scale == 1 && spec.offset == 0)
          return initial;
        if (initial.is_constant())
          return {spec.scale * initial.value(dealii::Point<1>()) + spec.offset, spec.where};
        return dim == 1 ? scaled<1>(initial, spec) : dim == 2 ? scaled<2>(initial, spec) : scaled<3>(initial, spec);
      }

      template <int d>
      static FieldFunction scaled(const FieldFunction &f, const FieldSpec &spec)
      {
        return [f, scale = spec.scale, offset = spec.offset](const dealii::Point<d> &x) { return scale * f.value(x) + offset; };
      }

      const std::vector<Parameter>        &parameters;
      const unsigned                       dim;
      StepFields                          &fields;
      std::map<std::string, FieldFunction> now; ///< the functions of this step
      Diagnostics                         &diagnostics;
      std::shared_ptr<CompiledParameters>  compiled_parameters; ///< none: they are wrong
    };
    /// m
    unsigned order_of(const Case &request)
    {
      return request.bending() ? 2 : request.model.kind == ModelSpec::Kind::projection ? 0 : 1;
    }
  } // namespace

  ProblemStatement problem_of(const Case &request, Diagnostics &diagnostics, StepFields &fields)
  {
    // Without a mesh every coordinate may exist.
    const unsigned          dim = request.dimension > 0 ? request.dimension : 3;
    FieldCompiler           compile(request.parameters, dim, fields, diagnostics);
    std::vector<Functional> functionals;
    for (const auto &functional : request.functionals)
      functionals.push_back(compile(functional, names_of(solution_quantities(request.elastic() ? dim : 1, order_of(request), dim))));
    ProblemStatement problem = {.mesh = compile(request.mesh),
                                .model = compile(request.model),
                                .materials = compile(request.materials),
                                .boundary = compile(request.boundary),
                                .periodic = compile(request.periodic),
                                .supports = compile(request.supports),
                                .point_loads = request.point_loads,
                                .constraints = compile(request.constraints),
                                .method = request.method,
                                .exact = {compile(request.exact.u), compile(request.exact.pressure)},
                                .output = request.output,
                                .functionals = std::move(functionals),
                                .own_form = {}};
    compile.remember();
    return problem;
  }

  ProblemStatement problem_of(const Case &request, Diagnostics &diagnostics)
  {
    StepFields fields;
    return problem_of(request, diagnostics, fields);
  }

  ProblemStatement problem_of(const Case &request)
  {
    Diagnostics diagnostics;
    StepFields  fields;
    fields.has_steps = !request.steps.empty();
    ProblemStatement problem =
      request.steps.empty() ? problem_of(request, diagnostics, fields) : problem_of(case_of_step(request, 0), diagnostics, fields);
    diagnostics.throw_if_errors();
    return problem;
  }
} // namespace unilateral
