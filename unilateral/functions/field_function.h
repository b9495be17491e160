// Scalar functions of position, whatever they are made of: numbers, lambdas, expressions, rasters, profiles.
#pragma once

#include "unilateral/base/diagnostics.h"
#include "unilateral/functions/interval_with_slopes.h"

#include <deal.II/base/point.h>
#include <deal.II/base/tensor.h>

#include <array>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

namespace unilateral
{
  /// A number for each point in `dim` dimensions.
  template <typename F, int dim>
  concept FunctionOfPoint = requires(const F &f, const dealii::Point<dim> &x)
  {
    double(f(x));
  };

  /// f(x, y, z). Cheap to copy (shared, immutable source); not thread-safe.
  class FieldFunction
  {
  public:
    /// What a FieldFunction evaluates; see compile_field.h for those that a case file can name.
    class Source
    {
    public:
      virtual ~Source() = default;
      /// Throws std::domain_error with the reason where the function has no value.
      virtual double value(double x, double y, double z) const = 0;
      /// The values at many points, and the gradients unless their span is empty; not finite where there is none. False: not offered.
      virtual bool values(std::span<const std::array<double, 3>> /*points*/,
                          std::span<double> /*values*/,
                          std::span<std::array<double, 3>> /*gradients*/) const
      {
        return false;
      }
      /// Contains every value in a box; none where that is not known.
      virtual std::optional<Interval> range(const std::array<Interval, 3> & /*box*/) const { return {}; }
      /// The same with slopes, see IntervalWithSlopes.
      virtual std::optional<IntervalWithSlopes> range_and_slopes(const std::array<Interval, 3> & /*box*/) const { return {}; }
      /// What to say of a value that is not finite.
      virtual std::string explanation() const { return ""; }
      /// Distance between samples, or 0 where there is no such thing; for the warning "raster much finer than the mesh".
      virtual double sample_spacing() const { return 0; }
      /// The same everywhere.
      virtual bool is_constant() const { return false; }
      /// Each call is dear, whatever the number of points: prepare() is worth its price.
      virtual bool dear_to_call() const { return false; }
      /// Computes the values at many points at once, so that value() and values() find them later.
      virtual void prepare(std::span<const std::array<double, 3>> /*points*/) const {}
    };

    FieldFunction(double constant = 0, SourceLocation where = {});

    /// @p where: what messages about its values point at.
    FieldFunction(std::shared_ptr<const Source> source, SourceLocation where);

    /// Any function of a point in 1-D, 2-D or 3-D: FieldFunction([](const dealii::Point<2> &p) { return p[0] * p[1]; }).
    template <FunctionOfPoint<1> F>
    FieldFunction(F f) : FieldFunction(std::make_shared<Callable<F, 1>>(std::move(f)), {})
    {
    }
    template <FunctionOfPoint<2> F>
    FieldFunction(F f) : FieldFunction(std::make_shared<Callable<F, 2>>(std::move(f)), {})
    {
    }
    template <FunctionOfPoint<3> F>
    FieldFunction(F f) : FieldFunction(std::make_shared<Callable<F, 3>>(std::move(f)), {})
    {
    }

    /// Value at @p p; coordinates beyond dim are 0.
    /// Throws InputError (at where(), naming the point) when the value is not finite or a raster has no data there.
    template <int dim>
    double value(const dealii::Point<dim> &p) const;

    /// The same at many points, which for an expression costs less than one after the other.
    template <int dim>
    void values(const std::vector<dealii::Point<dim>> &points, std::vector<double> &values) const;

    /// Gradient: of an expression by differentiation, of other functions by central differences of step ~6e-6 (scale of p), one-sided where
    /// the other side is not finite.
    template <int dim>
    dealii::Tensor<1, dim> gradient(const dealii::Point<dim> &p) const;

    /// values() and gradient() at many points.
    template <int dim>
    void values_and_gradients(const std::vector<dealii::Point<dim>> &points,
                              std::vector<double>                   &values,
                              std::vector<dealii::Tensor<1, dim>>   &gradients) const;

    /// Second derivatives: of an expression by central differences of the gradient with step ~6e-6 (scale of p), about five digits less
    /// than the values; of other functions by those of the values with step ~1e-4, about eight digits less.
    template <int dim>
    dealii::Tensor<2, dim> hessian(const dealii::Point<dim> &p) const;

    /// Where a call of the function is dear: its values at @p points in one call, for the single ones that follow. Else nothing.
    template <int dim>
    void prepare(const std::vector<dealii::Point<dim>> &points) const;

    /// Contains every value in a box, but for rounding; none where that is not known.
    std::optional<Interval>           range(const std::array<Interval, 3> &box) const { return source->range(box); }
    std::optional<IntervalWithSlopes> range_and_slopes(const std::array<Interval, 3> &box) const { return source->range_and_slopes(box); }

    bool                  dear_to_call() const;
    bool                  is_constant() const;                       ///< the same everywhere, expressions without x, y, z included
    bool                  is_zero() const;                           ///< constant 0
    bool                  same_as(const FieldFunction &other) const; ///< certainly: a copy of it, or the same number
    double                sample_spacing() const;
    const SourceLocation &where() const { return location; }

  private:
    template <typename F, int dim>
    class Callable : public Source
    {
    public:
      explicit Callable(F f) : f(std::move(f)) {}
      double value(const double x, const double y, const double z) const override
      {
        const std::array<double, 3> coordinates = {x, y, z};
        dealii::Point<dim>          p;
        for (unsigned d = 0; d < dim; ++d)
          p[d] = coordinates[d];
        return f(p);
      }

    private:
      F f;
    };

    template <int dim>
    dealii::Tensor<1, dim> gradient_by_differences(const dealii::Point<dim> &p) const;

    std::shared_ptr<const Source> source;
    SourceLocation                location;
  };

  /// Those that depend on the place.
  std::vector<FieldFunction> not_constant(std::vector<FieldFunction> functions);
} // namespace unilateral
