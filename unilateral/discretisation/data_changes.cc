#include "unilateral/discretisation/data_changes.h"

#include <algorithm>

namespace unilateral
{
  namespace
  {
    bool same(const FieldFunction &a, const FieldFunction &b)
    {
      return a.same_as(b);
    }

    template <typename T>
    bool same(const std::optional<T> &a, const std::optional<T> &b);

    template <typename T>
    bool same(const std::vector<T> &a, const std::vector<T> &b)
    {
      return std::equal(a.begin(), a.end(), b.begin(), b.end(), [](const T &x, const T &y) { return same(x, y); });
    }

    template <typename T>
    bool same(const std::optional<T> &a, const std::optional<T> &b)
    {
      return a.has_value() == b.has_value() && (!a || same(*a, *b));
    }

    bool same_stiffness(const Coefficients &a, const Coefficients &b)
    {
      return same(a.stiffness, b.stiffness) && same(a.velocity, b.velocity) && same(a.reaction, b.reaction) && same(a.young, b.young) &&
             same(a.poisson, b.poisson) && same(a.thickness, b.thickness);
    }

    bool same_model(const Model &a, const Model &b)
    {
      return a.kind == b.kind && a.assumption == b.assumption && a.integration == b.integration && a.element.name() == b.element.name() &&
             same_stiffness(a.coefficients, b.coefficients);
    }

    /// Springs are equal; of what is prescribed, so that forms may have terms for it, the same is.
    bool same_springs(const BoundaryCondition &a, const BoundaryCondition &b)
    {
      const auto both = [](const auto &x, const auto &y) { return x.has_value() == y.has_value(); };
      return a.part == b.part && same(a.spring, b.spring) && same(a.springs, b.springs) && same(a.slope_spring, b.slope_spring) &&
             both(a.value, b.value) && both(a.slope, b.slope) && both(a.moment, b.moment) && a.symmetry == b.symmetry &&
             std::equal(a.components.begin(), a.components.end(), b.components.begin(), b.components.end(), both);
    }

    /// A projection is integrated by the rule of its bound.
    bool same_rules(const ProblemStatement &a, const ProblemStatement &b)
    {
      const auto rule = [](const ProblemStatement &problem)
      {
        const auto &bounds = problem.constraints;
        return bounds.empty() || !bounds[0].quadrature ? std::string() : bounds[0].quadrature->name();
      };
      return a.model.kind != ModelChoices::Kind::projection || rule(a) == rule(b);
    }

    template <typename T, typename Same>
    bool all_same(const std::vector<T> &a, const std::vector<T> &b, const Same &same)
    {
      return std::equal(a.begin(), a.end(), b.begin(), b.end(), same);
    }
  } // namespace

  bool same_form(const ProblemStatement &a, const ProblemStatement &b)
  {
    return !a.own_form && !b.own_form && same_model(a.model, b.model) && same_rules(a, b) &&
           all_same(a.materials, b.materials,
                    [](const Material &x, const Material &y)
                    { return x.region == y.region && same_stiffness(x.coefficients, y.coefficients); }) &&
           all_same(a.boundary, b.boundary, same_springs) &&
           all_same(a.supports, b.supports,
                    [](const InnerSupport &x, const InnerSupport &y)
                    {
                      return x.at == y.at && same(x.spring, y.spring) && x.value.has_value() == y.value.has_value() &&
                             x.slope.has_value() == y.slope.has_value();
                    });
  }
} // namespace unilateral
