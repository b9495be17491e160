#include "unilateral/functions/expression.h"
#include "unilateral/functions/field_function.h"

#include <functional>

namespace unilateral
{
  namespace
  {
    void for_each_field(const Coefficients &coefficients, const std::function<void(const FieldSpec &)> &visit)
    {
      for (const auto *const list : {&coefficients.stiffness, &coefficients.velocity, &coefficients.load})
        if (*list)
          for (const FieldSpec &entry : **list)
            visit(entry);
      for (const auto *const field : {&coefficients.reaction, &coefficients.young, &coefficients.poisson, &coefficients.thickness})
        if (*field)
          visit(**field);
    }

    /// All functions of a case but the parameters.
    void for_each_field(const Case &request, const std::function<void(const FieldSpec &)> &visit)
    {
      const auto visit_optional = [&](const std::optional<FieldSpec> &field)
      {
        if (field)
          visit(*field);
      };
      for (const auto &refinement : request.mesh.local)
        visit(refinement.where);
      for_each_field(request.model.coefficients, visit);
      for (const MaterialSpec &material : request.materials)
        for_each_field(material.coefficients, visit);
      for (const BoundarySpec &condition : request.boundary)
      {
        visit_optional(condition.value);
        visit_optional(condition.flux);
        visit_optional(condition.spring);
        visit_optional(condition.pressure);
        visit_optional(condition.slope);
        visit_optional(condition.moment);
        visit_optional(condition.slope_spring);
        for (const auto &component : condition.components)
          visit_optional(component);
        for (const auto *const list : {&condition.traction, &condition.springs})
          for (const FieldSpec &entry : *list)
            visit(entry);
      }
      for (const SupportSpec &support : request.supports)
        for (const auto *const field : {&support.value, &support.slope, &support.spring})
          visit_optional(*field);
      for (const ConstraintSpec &constraint : request.constraints)
      {
        visit_optional(constraint.lower);
        visit_optional(constraint.upper);
        visit_optional(constraint.gap);
      }
      for (const FieldSpec &component : request.exact.u)
        visit(component);
      visit_optional(request.exact.pressure);
    }
  } // namespace

  void check_functions(const Case &request, Diagnostics &diagnostics)
  {
    // Without a mesh every coordinate may exist.
    const unsigned dim = request.dimension > 0 ? request.dimension : 3;

    Diagnostics in_parameters;
    check_parameters(request.parameters, dim, in_parameters);
    for (const Diagnostic &diagnostic : in_parameters.all())
      diagnostics.error(diagnostic.where, diagnostic.message);

    for_each_field(request,
                   [&](const FieldSpec &spec)
                   {
                     if (spec.kind == FieldSpec::Kind::raster && dim == 1)
                       diagnostics.error(spec.where, "a raster is a function of x and y; a 1-D mesh takes { profile = \"file.csv\" }");
                     else if (spec.kind == FieldSpec::Kind::profile && dim > 1)
                       diagnostics.error(spec.where, "a profile is a function of x on a 1-D mesh; elsewhere take { raster = \"file\" }");
                     else if (spec.kind == FieldSpec::Kind::expression && in_parameters.has_errors())
                       // What is wrong with the parameters has been said; compiling would say it again for every use.
                       check_expression(spec, request.parameters, dim, diagnostics);
                     else
                       try
                       {
                         FieldFunction(spec, request.parameters, dim);
                       }
                       catch (const InputError &e)
                       {
                         for (const Diagnostic &diagnostic : e.diagnostics)
                           diagnostics.error(diagnostic.where, diagnostic.message);
                       }
                   });
  }
} // namespace unilateral
