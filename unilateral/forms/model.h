// Which form a problem has, and its coefficients by region; `Function` is a FieldFunction, or the text of one in a case file.
#pragma once

#include "unilateral/base/diagnostics.h"
#include "unilateral/functions/field_function.h"
#include "unilateral/spaces/element.h"

#include <optional>
#include <string>
#include <vector>

namespace unilateral
{
  /// What a region is made of. Membrane: (k grad u, grad v) + (b . grad u, v) + (c u, v) = (f, v); absent ones fall back to those of the
  /// model, then to the defaults 1, 0, 0, 0. Elasticity: Young's modulus and Poisson's ratio, which have no default, and the body force.
  /// Beams and plates: `stiffness` is the rigidity EI or D, which young, poisson and thickness may give instead, `reaction` a Winkler
  /// foundation.
  template <typename Function>
  struct CoefficientsOf
  {
    /// 1 entry: scalar k; 3 (2-D) or 6 (3-D) entries: symmetric tensor xx, xy, yy resp. xx, xy, xz, yy, yz, zz.
    std::optional<std::vector<Function>> stiffness;
    std::optional<std::vector<Function>> velocity; ///< `dim` entries
    std::optional<Function>              reaction;
    std::optional<Function>              young, poisson, thickness;
    std::optional<std::vector<Function>> load; ///< an entry per component of u
  };

  /// Coefficients that hold in one region of the mesh.
  template <typename Function>
  struct MaterialOf
  {
    std::string              region;
    CoefficientsOf<Function> coefficients;
    SourceLocation           where; ///< of the region's name
  };

  /// The choices that a model has, apart from its coefficients.
  struct ModelChoices
  {
    enum class Kind
    {
      membrane,
      elasticity,
      plate,
      beam,
      projection
    };
    /// Of a 2-D elastic body.
    enum class Assumption
    {
      plane_strain,
      plane_stress,
      axisymmetric ///< x is the distance from the axis, y runs along it
    };
    /// How the volumetric part of the elastic energy is integrated.
    enum class Integration
    {
      automatic, ///< reduced on quadrilaterals and hexahedra of nearly incompressible regions, else full
      full,
      reduced ///< with one Gauss point a direction less: no volumetric locking
    };
  };

  /// The form, the element, and the coefficients that hold wherever no material has its own.
  template <typename Function>
  struct ModelOf : ModelChoices
  {
    Kind                     kind = Kind::membrane;
    Assumption               assumption = Assumption::plane_strain;
    Integration              integration = Integration::automatic;
    ElementName              element;
    CoefficientsOf<Function> coefficients;
    SourceLocation           where; ///< of `kind`
    SourceLocation           element_where;
  };

  /// The first of a list that is given, else @p otherwise.
  inline FieldFunction first_or(const std::optional<std::vector<FieldFunction>> &list, const double otherwise)
  {
    return list && !list->empty() ? list->front() : FieldFunction(otherwise);
  }

  using Coefficients = CoefficientsOf<FieldFunction>;
  using Material = MaterialOf<FieldFunction>;
  using Model = ModelOf<FieldFunction>;
} // namespace unilateral
