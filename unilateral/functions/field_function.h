// Scalar functions of position: expressions (muParser), rasters (GDAL), profiles (CSV).
#pragma once

#include "unilateral/case/case.h"

#include <deal.II/base/point.h>
#include <deal.II/base/tensor.h>

#include <memory>
#include <string>
#include <vector>

namespace unilateral
{
  /// f(x, y, z) as the user gave it. Cheap to copy (shared, immutable source); not thread-safe.
  class FieldFunction
  {
  public:
    /// What a FieldFunction evaluates; one subclass per FieldSpec::Kind.
    class Source
    {
    public:
      virtual ~Source() = default;
      /// Throws std::domain_error with the reason where the function has no value.
      virtual double value(double x, double y, double z) const = 0;
      /// What to say of a value that is not finite.
      virtual std::string explanation() const { return ""; }
      /// Distance between samples, or 0 where there is no such thing; for the warning "raster much finer than the mesh".
      virtual double sample_spacing() const { return 0; }
    };

    FieldFunction(double constant = 0);

    /// Reads the file or compiles the expression, in which the first @p dim of x, y, z are known.
    /// Throws InputError at the true position of the fault: unknown name, syntax, file missing, not a raster, too few rows.
    FieldFunction(const FieldSpec &spec, const std::vector<Parameter> &parameters, unsigned dim = 3);

    /// Value at @p p; coordinates beyond dim are 0.
    /// Throws InputError (at spec.where, naming the point) when the value is not finite or a raster has no data there.
    template <int dim>
    double value(const dealii::Point<dim> &p) const;

    /// Gradient by central differences of step ~6e-6 (scale of p), one-sided where the other side is not finite.
    template <int dim>
    dealii::Tensor<1, dim> gradient(const dealii::Point<dim> &p) const;

    /// Second derivatives by central differences of the values with step ~1e-4 (scale of p): about eight digits less than the values.
    template <int dim>
    dealii::Tensor<2, dim> hessian(const dealii::Point<dim> &p) const;

    bool                  is_constant() const; ///< the same everywhere, expressions without x, y, z included
    bool                  is_zero() const;     ///< constant 0
    double                sample_spacing() const;
    const SourceLocation &where() const { return location; }

  private:
    std::shared_ptr<const Source> source;
    SourceLocation                location;
  };

  /// Compiles every expression of the case (parameters included) and opens every file, without evaluating them on a mesh;
  /// adds what is wrong to @p diagnostics. Cycles among parameters are found here.
  void check_functions(const Case &request, Diagnostics &diagnostics);
} // namespace unilateral
