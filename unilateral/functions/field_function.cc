#include "unilateral/functions/field_function.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace unilateral
{
  namespace
  {
    class ConstantSource : public FieldFunction::Source
    {
    public:
      explicit ConstantSource(const double constant) : constant(constant) {}
      double                            value(double, double, double) const override { return constant; }
      bool                              is_constant() const override { return true; }
      std::optional<Interval>           range(const std::array<Interval, 3> &) const override { return Interval::of(constant); }
      std::optional<IntervalWithSlopes> range_and_slopes(const std::array<Interval, 3> &) const override
      {
        return IntervalWithSlopes{Interval::of(constant), {}};
      }

    private:
      const double constant;
    };

    template <int dim>
    std::string point_text(const dealii::Point<dim> &p)
    {
      std::string text = fmt::format("({}", p[0]);
      for (unsigned d = 1; d < dim; ++d)
        text += fmt::format(", {}", p[d]);
      return text + ")";
    }

    template <int dim>
    std::array<double, 3> coordinates(const dealii::Point<dim> &p)
    {
      std::array<double, 3> x = {0, 0, 0};
      for (unsigned d = 0; d < dim; ++d)
        x[d] = p[d];
      return x;
    }

    template <int dim>
    std::vector<std::array<double, 3>> coordinates(const std::vector<dealii::Point<dim>> &points)
    {
      std::vector<std::array<double, 3>> x(points.size());
      std::transform(points.begin(), points.end(), x.begin(), [](const dealii::Point<dim> &p) { return coordinates(p); });
      return x;
    }

    bool is_finite(const std::array<double, 3> &v)
    {
      return std::isfinite(v[0]) && std::isfinite(v[1]) && std::isfinite(v[2]);
    }

    template <int dim>
    dealii::Tensor<1, dim> to_tensor(const std::array<double, 3> &v)
    {
      dealii::Tensor<1, dim> result;
      for (unsigned d = 0; d < dim; ++d)
        result[d] = v[d];
      return result;
    }
  } // namespace

  FieldFunction::FieldFunction(const double constant, SourceLocation where)
    : source(std::make_shared<ConstantSource>(constant)), location(std::move(where))
  {
  }

  FieldFunction::FieldFunction(std::shared_ptr<const Source> source, SourceLocation where)
    : source(std::move(source)), location(std::move(where))
  {
  }

  template <int dim>
  double FieldFunction::value(const dealii::Point<dim> &p) const
  {
    double value = 0;
    try
    {
      const auto [x, y, z] = coordinates(p);
      value = source->value(x, y, z);
    }
    catch (const std::domain_error &e)
    {
      throw InputError(location, fmt::format("no value at {}: {}", point_text(p), e.what()), MessageName("no-value"));
    }
    if (!std::isfinite(value))
      throw InputError(location, fmt::format("the value at {} is not finite, it is {}: {}", point_text(p), value, source->explanation()),
                       MessageName("no-value"));
    return value;
  }

  template <int dim>
  void FieldFunction::values(const std::vector<dealii::Point<dim>> &points, std::vector<double> &values) const
  {
    if (is_constant())
    {
      values.assign(points.size(), points.empty() ? 0. : value(points.front()));
      return;
    }
    values.resize(points.size());
    const bool in_bulk = source->values(coordinates(points), values, {});
    for (std::size_t i = 0; i < points.size(); ++i)
      if (!in_bulk || !std::isfinite(values[i]))
        values[i] = value(points[i]);
  }

  template <int dim>
  void FieldFunction::values_and_gradients(const std::vector<dealii::Point<dim>> &points,
                                           std::vector<double>                   &values,
                                           std::vector<dealii::Tensor<1, dim>>   &gradients) const
  {
    if (is_constant())
    {
      this->values(points, values);
      gradients.assign(points.size(), dealii::Tensor<1, dim>());
      return;
    }
    values.resize(points.size());
    gradients.resize(points.size());
    std::vector<std::array<double, 3>> slopes(points.size());
    const bool                         in_bulk = source->values(coordinates(points), values, slopes);
    for (std::size_t i = 0; i < points.size(); ++i)
    {
      if (!in_bulk || !std::isfinite(values[i]))
        values[i] = value(points[i]);
      gradients[i] = in_bulk && is_finite(slopes[i]) ? to_tensor<dim>(slopes[i]) : gradient_by_differences(points[i]);
    }
  }

  template <int dim>
  dealii::Tensor<1, dim> FieldFunction::gradient(const dealii::Point<dim> &p) const
  {
    const std::array<double, 3> x = coordinates(p);
    std::array<double, 3>       slope = {0, 0, 0};
    double                      value = 0;
    if (source->values({&x, 1}, {&value, 1}, {&slope, 1}) && std::isfinite(value) && is_finite(slope))
      return to_tensor<dim>(slope);
    return gradient_by_differences(p);
  }

  template <int dim>
  dealii::Tensor<1, dim> FieldFunction::gradient_by_differences(const dealii::Point<dim> &p) const
  {
    dealii::Tensor<1, dim> gradient;
    if (is_constant())
      return gradient;
    // The step at which rounding and the h^2 term balance; samples are not worth looking across.
    double step = 6e-6 * std::max(1., p.norm());
    if (sample_spacing() > 0)
      step = std::min(step, sample_spacing() / 100);

    const auto defined = [&](const dealii::Point<dim> &q, double &value_there)
    {
      try
      {
        value_there = value(q);
        return true;
      }
      catch (const InputError &)
      {
        return false;
      }
    };
    for (unsigned d = 0; d < dim; ++d)
    {
      dealii::Point<dim> ahead = p, behind = p;
      ahead[d] += step;
      behind[d] -= step;
      double     value_ahead = 0, value_behind = 0;
      const bool has_ahead = defined(ahead, value_ahead), has_behind = defined(behind, value_behind);
      if (!has_ahead)
      {
        ahead = p;
        value_ahead = value(p);
      }
      if (!has_behind)
      {
        behind = p;
        value_behind = value(p);
      }
      if (!has_ahead && !has_behind)
        throw InputError(location, fmt::format("no gradient at {}: no value on either side", point_text(p)), MessageName("no-value"));
      gradient[d] = (value_ahead - value_behind) / (ahead[d] - behind[d]);
    }
    return gradient;
  }

  template <int dim>
  dealii::Tensor<2, dim> FieldFunction::hessian(const dealii::Point<dim> &p) const
  {
    dealii::Tensor<2, dim> result;
    if (is_constant())
      return result;
    if (source->values({}, {}, {}))
    {
      const double step = 6e-6 * std::max(1., p.norm());
      for (unsigned i = 0; i < dim; ++i)
      {
        dealii::Point<dim> ahead = p, behind = p;
        ahead[i] += step;
        behind[i] -= step;
        const dealii::Tensor<1, dim> column = (gradient(ahead) - gradient(behind)) / (ahead[i] - behind[i]);
        for (unsigned j = 0; j < dim; ++j)
        {
          result[i][j] += 0.5 * column[j];
          result[j][i] += 0.5 * column[j];
        }
      }
      return result;
    }
    const double step = 1e-4 * std::max(1., p.norm());
    const auto   at = [&](const unsigned i, const double a, const unsigned j, const double b)
    {
      dealii::Point<dim> q = p;
      q[i] += a * step;
      q[j] += b * step;
      return value(q);
    };
    const double centre = value(p);
    for (unsigned i = 0; i < dim; ++i)
    {
      result[i][i] = (at(i, 1, i, 0) - 2 * centre + at(i, -1, i, 0)) / (step * step);
      for (unsigned j = 0; j < i; ++j)
        result[i][j] = result[j][i] = (at(i, 1, j, 1) - at(i, 1, j, -1) - at(i, -1, j, 1) + at(i, -1, j, -1)) / (4 * step * step);
    }
    return result;
  }

  template <int dim>
  void FieldFunction::prepare(const std::vector<dealii::Point<dim>> &points) const
  {
    if (dear_to_call())
      source->prepare(coordinates(points));
  }

  bool FieldFunction::dear_to_call() const
  {
    return source->dear_to_call();
  }

  bool FieldFunction::is_constant() const
  {
    return source->is_constant();
  }

  bool FieldFunction::is_zero() const
  {
    return is_constant() && source->value(0, 0, 0) == 0;
  }

  bool FieldFunction::same_as(const FieldFunction &other) const
  {
    return source == other.source || (is_constant() && other.is_constant() && source->value(0, 0, 0) == other.source->value(0, 0, 0));
  }

  double FieldFunction::sample_spacing() const
  {
    return source->sample_spacing();
  }

  std::vector<FieldFunction> not_constant(std::vector<FieldFunction> functions)
  {
    std::erase_if(functions, [](const FieldFunction &f) { return f.is_constant(); });
    return functions;
  }

  template void                 FieldFunction::prepare(const std::vector<dealii::Point<1>> &) const;
  template void                 FieldFunction::prepare(const std::vector<dealii::Point<2>> &) const;
  template void                 FieldFunction::prepare(const std::vector<dealii::Point<3>> &) const;
  template dealii::Tensor<2, 1> FieldFunction::hessian(const dealii::Point<1> &) const;
  template dealii::Tensor<2, 2> FieldFunction::hessian(const dealii::Point<2> &) const;
  template dealii::Tensor<2, 3> FieldFunction::hessian(const dealii::Point<3> &) const;
  template double               FieldFunction::value(const dealii::Point<1> &) const;
  template double               FieldFunction::value(const dealii::Point<2> &) const;
  template double               FieldFunction::value(const dealii::Point<3> &) const;
  template void                 FieldFunction::values(const std::vector<dealii::Point<1>> &, std::vector<double> &) const;
  template void                 FieldFunction::values_and_gradients(const std::vector<dealii::Point<1>> &,
                                                                    std::vector<double> &,
                                                                    std::vector<dealii::Tensor<1, 1>> &) const;
  template void                 FieldFunction::values(const std::vector<dealii::Point<2>> &, std::vector<double> &) const;
  template void                 FieldFunction::values_and_gradients(const std::vector<dealii::Point<2>> &,
                                                                    std::vector<double> &,
                                                                    std::vector<dealii::Tensor<1, 2>> &) const;
  template void                 FieldFunction::values(const std::vector<dealii::Point<3>> &, std::vector<double> &) const;
  template void                 FieldFunction::values_and_gradients(const std::vector<dealii::Point<3>> &,
                                                                    std::vector<double> &,
                                                                    std::vector<dealii::Tensor<1, 3>> &) const;
  template dealii::Tensor<1, 1> FieldFunction::gradient(const dealii::Point<1> &) const;
  template dealii::Tensor<1, 2> FieldFunction::gradient(const dealii::Point<2> &) const;
  template dealii::Tensor<1, 3> FieldFunction::gradient(const dealii::Point<3> &) const;
} // namespace unilateral
