// A problem as a plain value: mesh, form, boundary conditions, bounds, method, and what is asked of the solution.
#pragma once

#include "unilateral/constraints/unilateral_bound.h"
#include "unilateral/forms/model.h"
#include "unilateral/forms/own_form.h"
#include "unilateral/functions/integrand.h"
#include "unilateral/inequality/method.h"
#include "unilateral/mesh/mesh_description.h"
#include "unilateral/spaces/boundary_condition.h"

#include <algorithm>
#include <optional>
#include <string>
#include <type_traits>
#include <vector>

namespace unilateral
{
  /// A force or moment on a beam or plate.
  struct PointLoad
  {
    std::vector<double> at;         ///< `dim` numbers
    double              force = 0;  ///< in the direction of u
    double              moment = 0; ///< beams: conjugate to u'
    SourceLocation      where;
  };

  /// The exact solution, where it is known: errors are measured against it.
  template <typename Function>
  struct ExactSolutionOf
  {
    std::vector<Function>   u; ///< none, or an entry per component
    std::optional<Function> pressure;
  };

  /// An integral of an expression of the solution, see functional_values().
  template <typename Function>
  struct FunctionalOf
  {
    std::string                                                                      name;
    std::conditional_t<std::is_same_v<Function, FieldFunction>, Integrand, Function> integrand;     ///< a case file has its text
    std::string                                                                      on = "domain"; ///< or a part of the boundary
    std::string                                                                      region;        ///< empty: all of the domain
    SourceLocation                                                                   where;
  };
  using Functional = FunctionalOf<FieldFunction>;

  /// What is asked of the solution beside itself.
  struct OutputRequest
  {
    std::vector<std::vector<double>> probes;
    std::vector<SourceLocation>      probes_where;
  };

  /// What solve() solves. `Function` is FieldFunction; a case file has the same problem with the texts of its functions.
  template <typename Function>
  struct ProblemStatementOf
  {
    RefinedMeshOf<Function>                    mesh;
    ModelOf<Function>                          model;
    std::vector<MaterialOf<Function>>          materials;
    std::vector<BoundaryConditionOf<Function>> boundary;
    std::vector<PeriodicPartsOf<Function>>     periodic;
    std::vector<InnerSupportOf<Function>>      supports;
    std::vector<PointLoad>                     point_loads;
    std::vector<UnilateralBoundOf<Function>>   constraints;
    Method                                     method;
    ExactSolutionOf<Function>                  exact;
    OutputRequest                              output;
    std::vector<FunctionalOf<Function>>        functionals;
    OwnForm                                    own_form; ///< in place of the model's; no case file has one
    bool                                       check_motions =
      true; ///< throw where nothing stops a rigid body mode; false: a study of some of the constraints, which solves nothing

    /// A bound acts on a part of the boundary.
    bool constrains_boundary() const
    {
      return std::any_of(constraints.begin(), constraints.end(), [](const auto &constraint) { return !constraint.on.empty(); });
    }
    bool elastic() const { return model.kind == ModelChoices::Kind::elasticity; }
    bool bending() const { return model.kind == ModelChoices::Kind::beam || model.kind == ModelChoices::Kind::plate; } ///< m = 2
  };

  using ProblemStatement = ProblemStatementOf<FieldFunction>;
} // namespace unilateral
