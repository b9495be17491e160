// What holds on the boundary, and inside at single nodes; `Function` is a FieldFunction, or the text of one in a case file. All members
// have initialisers: a program may name those that it sets, {.part = "left", .value = 0.}, and no compiler warns of the others.
#pragma once

#include "unilateral/base/diagnostics.h"
#include "unilateral/functions/field_function.h"

#include <optional>
#include <string>
#include <vector>

namespace unilateral
{
  /// On one part of the boundary.
  template <typename Function>
  struct BoundaryConditionOf
  {
    std::string             part;       ///< a name of the mesh, or "all": every part not named
    std::optional<Function> value = {}; ///< Dirichlet: u = value
    std::optional<Function> flux = {};  ///< Neumann: k du/dn = flux - spring * u
    std::optional<Function> spring = {};

    // Elasticity. The stress vector is traction - pressure n - springs u.
    std::vector<std::optional<Function>> components = {};           ///< of u that are prescribed: none, or an entry per component
    bool                                 symmetry = false;          ///< u.n = 0, no friction
    std::vector<Function>                traction = {};             ///< none, or an entry per component
    bool                                 traction_is_total = false; ///< it is the resultant force on the part, spread evenly over it
    std::vector<Function>                moments = {};              ///< of that load about `about`: none, or 1 in 2-D, 3 in 3-D
    std::vector<double>                  about = {};                ///< a point; none: the centroid of the part
    std::optional<Function>              pressure = {};
    std::vector<Function>                springs = {}; ///< none, one for all directions, or an entry per component

    /// Bonded to a rigid platen: u(x) = t + theta x (x - x_0) on the part, x_0 = `about`. Then `components` are those of t that are
    /// prescribed, constants.
    bool                                 rigid = false;
    std::vector<std::optional<Function>> rotations = {}; ///< of theta, in radians, that are prescribed: none, or 1 in 2-D, 3 in 3-D

    // Beams and plates, n the outer normal. The bending moment is M_nn = moment - slope_spring du/dn, the force flux - spring u.
    std::optional<Function> slope = {}; ///< du/dn = slope; symmetry means 0
    std::optional<Function> moment = {};
    std::optional<Function> slope_spring = {};
    SourceLocation          where = {}; ///< of the key
  };

  /// What holds a beam at a node inside.
  template <typename Function>
  struct InnerSupportOf
  {
    std::vector<double>     at = {}; ///< 1 number
    std::optional<Function> value = {}, slope = {}, spring = {};
    SourceLocation          where = {};
  };

  /// Two parts of the boundary, the second a shift of the first: u(x + shift) = u(x) + jump for x on the first.
  template <typename Function>
  struct PeriodicPartsOf
  {
    std::string           first, second;
    std::vector<Function> jump = {}; ///< constants: none, or an entry per component
    SourceLocation        where = {}, first_where = {}, second_where = {};
  };

  using BoundaryCondition = BoundaryConditionOf<FieldFunction>;
  using InnerSupport = InnerSupportOf<FieldFunction>;
  using PeriodicParts = PeriodicPartsOf<FieldFunction>;

  /// What holds on a part of the boundary of a mesh.
  struct PartCondition : BoundaryCondition
  {
    bool named = false; ///< by a condition of its own, not by one for `all`
  };
} // namespace unilateral
