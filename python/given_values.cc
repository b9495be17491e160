#include "python/given_values.h"

#include "python/mesh_arrays.h"

#include "unilateral/functions/raster.h"
#include "unilateral/functions/sampled_field.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <limits>
#include <optional>
#include <string>
#include <unordered_map>
#include <utility>
#include <vector>

namespace py = pybind11;

namespace unilateral
{
  namespace
  {
    using Coordinates = std::array<double, 3>;
    using Doubles = py::array_t<double, py::array::c_style | py::array::forcecast>;

    /// Values that are remembered at most: 64 bytes each.
    constexpr std::size_t max_known_values = 1u << 23;

    struct HashOfPoint
    {
      std::size_t operator()(const Coordinates &x) const
      {
        std::size_t hash = 0;
        for (const double coordinate : x)
          // + 0. makes one zero of both.
          hash = (hash ^ std::bit_cast<std::uint64_t>(coordinate + 0.)) * 0x9E3779B97F4A7C15u + (hash >> 29);
        return hash;
      }
    };

    std::string shape_text(const py::array &array)
    {
      return py::str(py::tuple(array.attr("shape")));
    }

    /// f(points). An object of Python that may be destroyed by any thread.
    class Callable
    {
    public:
      explicit Callable(py::object function)
        : function(new py::object(std::move(function)),
                   [](py::object *const owned)
                   {
                     const py::gil_scoped_acquire lock;
                     delete owned;
                   }),
          called(py::getattr(*this->function, "__name__", py::type::handle_of(*this->function).attr("__name__")).cast<std::string>())
      {
      }

      const std::string &name() const { return called; }

      /// One call for all @p points; throws what the function raises.
      void evaluate(const std::span<const Coordinates> points, const unsigned dim, const std::span<double> values) const
      {
        const py::gil_scoped_acquire lock;
        const auto                   n = py::ssize_t(points.size());
        py::array_t<double>          x({n, py::ssize_t(dim)});
        auto                         coordinates = x.mutable_unchecked<2>();
        for (py::ssize_t i = 0; i < n; ++i)
          for (unsigned d = 0; d < dim; ++d)
            coordinates(i, d) = points[i][d];
        const py::object returned = (*function)(x);
        // NumPy would make nan of None, and leave out a part of complex numbers.
        const py::array array = returned.is_none() ? py::array() : py::array::ensure(returned);
        const bool      real = !returned.is_none() && (!array || array.dtype().kind() != 'c');
        const Doubles   result = real ? Doubles::ensure(returned) : Doubles();
        if (!real || !result)
        {
          PyErr_Clear();
          throw py::type_error(fmt::format("'{}' must return an array of real numbers, one for each point, not {}", called,
                                           py::str(py::type::handle_of(returned).attr("__name__")).cast<std::string>()));
        }
        if (result.size() == 1 && (result.ndim() == 0 || n == 1))
          std::fill(values.begin(), values.end(), *result.data());
        else if (result.size() == n && (result.ndim() == 1 || (result.ndim() == 2 && result.shape(1) == 1)))
          std::copy_n(result.data(), n, values.begin());
        else
          throw py::value_error(fmt::format("'{}' must return an array of {} numbers for points of shape ({}, {}), not one of shape {}",
                                            called, n, n, dim, shape_text(result)));
      }

    private:
      std::shared_ptr<const py::object> function;
      std::string                       called;
    };

    class CallableSource : public FieldFunction::Source
    {
    public:
      CallableSource(Callable function, const unsigned dim) : function(std::move(function)), dim(dim) {}

      double value(const double x, const double y, const double z) const override
      {
        const Coordinates at = {x, y, z};
        double            result = 0;
        look_up({&at, 1}, {&result, 1});
        return result;
      }

      /// Gradients are central differences, all of them by one call.
      bool values(const std::span<const Coordinates> points,
                  const std::span<double>            values,
                  const std::span<Coordinates>       gradients) const override
      {
        if (points.empty())
          return false; // second derivatives are differences of values
        look_up(points, values);
        if (gradients.empty())
          return true;
        std::vector<Coordinates> around;
        std::vector<double>      steps;
        for (const Coordinates &x : points)
        {
          steps.push_back(6e-6 * std::max(1., std::hypot(x[0], x[1], x[2])));
          for (unsigned d = 0; d < dim; ++d)
            for (const double side : {1., -1.})
            {
              around.push_back(x);
              around.back()[d] += side * steps.back();
            }
        }
        std::vector<double> at(around.size());
        function.evaluate(around, dim, at);
        for (std::size_t i = 0; i < points.size(); ++i)
          for (unsigned d = 0; d < 3; ++d)
          {
            const std::size_t k = 2 * (i * dim + d);
            gradients[i][d] = d < dim ? (at[k] - at[k + 1]) / (around[k][d] - around[k + 1][d]) : 0;
          }
        return true;
      }

      std::string explanation() const override { return fmt::format("the Python function '{}'", function.name()); }
      bool        dear_to_call() const override { return true; }
      void        prepare(const std::span<const Coordinates> points) const override
      {
        std::vector<double> forgotten(points.size());
        look_up(points, forgotten);
      }

    private:
      void look_up(const std::span<const Coordinates> points, const std::span<double> values) const
      {
        std::vector<Coordinates> unknown;
        std::vector<std::size_t> places;
        for (std::size_t i = 0; i < points.size(); ++i)
          if (const auto found = known.find(points[i]); found != known.end())
            values[i] = found->second;
          else
          {
            unknown.push_back(points[i]);
            places.push_back(i);
          }
        if (unknown.empty())
          return;
        std::vector<double> found(unknown.size());
        function.evaluate(unknown, dim, found);
        if (known.size() + found.size() > max_known_values)
          known.clear();
        for (std::size_t k = 0; k < unknown.size(); ++k)
        {
          values[places[k]] = found[k];
          known.emplace(unknown[k], found[k]);
        }
      }

      const Callable                                               function;
      const unsigned                                               dim;
      mutable std::unordered_map<Coordinates, double, HashOfPoint> known;
    };

    class GivenCallable : public GivenFunction
    {
    public:
      explicit GivenCallable(py::object f) : function(std::move(f)) {}
      std::shared_ptr<const FieldFunction::Source> in_dimension(const unsigned dim) const override
      {
        return std::make_shared<CallableSource>(function, dim);
      }
      std::string name() const override { return function.name(); }

    private:
      const Callable function;
    };

    /// Samples or nodal values: the same source whatever the mesh is.
    class GivenArray : public GivenFunction
    {
    public:
      GivenArray(std::shared_ptr<const FieldFunction::Source> source, const unsigned least_dim, const unsigned most_dim)
        : source(std::move(source)), least_dim(least_dim), most_dim(most_dim)
      {
      }
      std::shared_ptr<const FieldFunction::Source> in_dimension(const unsigned dim) const override
      {
        if (dim < least_dim || dim > most_dim)
          throw std::runtime_error(fmt::format("it is a function in {}-D, the mesh is {}-D", least_dim, dim));
        return source;
      }
      std::string name() const override { return "array"; }

    private:
      const std::shared_ptr<const FieldFunction::Source> source;
      const unsigned                                     least_dim, most_dim;
    };

    Doubles numbers(const py::handle &value, const char *const name)
    {
      Doubles array = Doubles::ensure(value);
      if (!array)
      {
        PyErr_Clear();
        throw py::type_error(fmt::format("'{}' must be an array of numbers", name));
      }
      return array;
    }

    double number_or(const py::dict &content, const char *const key, const double otherwise)
    {
      return content.contains(key) ? content[key].cast<double>() : otherwise;
    }

    void refuse_other_keys(const py::dict &content, const std::vector<std::string> &known)
    {
      for (const auto &[key, value] : content)
        if (std::find(known.begin(), known.end(), py::str(key).cast<std::string>()) == known.end())
          throw py::value_error(fmt::format("a function by an array has no key '{}'{}", py::str(key).cast<std::string>(),
                                            suggestion(py::str(key).cast<std::string>(), known)));
    }

    std::shared_ptr<const GivenFunction> function_of_grid(const py::dict &content)
    {
      refuse_other_keys(content, {"array", "extent", "scale", "offset", "nodata"});
      const Doubles samples = numbers(content["array"], "array");
      if ((samples.ndim() != 1 && samples.ndim() != 2) || samples.size() == 0)
        throw py::value_error(
          fmt::format("'array' must have one or two dimensions and hold numbers, its shape is {}", shape_text(samples)));
      const bool flat = samples.ndim() == 1;
      if (!content.contains("extent"))
        throw py::value_error("'array' needs 'extent', the corners of its grid: [[x0, y0], [x1, y1]], in 1-D [[x0], [x1]]");
      const Doubles  corners = numbers(content["extent"], "extent");
      Raster::Extent extent = {{{0, -1}, {0, 1}}};
      if (corners.size() != (flat ? 2 : 4))
        throw py::value_error(flat ? "'extent' of an array of one dimension must be [[x0], [x1]]"
                                   : "'extent' of an array of two dimensions must be [[x0, y0], [x1, y1]]");
      for (unsigned k = 0; k < 2; ++k)
        for (unsigned d = 0; d < (flat ? 1 : 2); ++d)
          extent[k][d] = corners.data()[flat ? k : 2 * k + d];
      for (unsigned d = 0; d < 2; ++d)
        if (!(extent[0][d] < extent[1][d]))
          throw py::value_error("'extent' must be [[x0, y0], [x1, y1]] with x0 < x1 and y0 < y1");
      std::vector<double> copy(samples.data(), samples.data() + samples.size());
      Raster     raster(std::size_t(samples.shape(flat ? 0 : 1)), flat ? 1 : std::size_t(samples.shape(0)), std::move(copy), extent);
      const auto nodata = content.contains("nodata") ? std::optional(content["nodata"].cast<double>()) : std::nullopt;
      return std::make_shared<GivenArray>(
        raster_source(std::move(raster), number_or(content, "scale", 1), number_or(content, "offset", 0), nodata), flat ? 1 : 2,
        flat ? 1 : 3);
    }

    std::shared_ptr<const GivenFunction> function_of_nodes(const py::dict &content, std::shared_ptr<const NodalMesh> mesh)
    {
      refuse_other_keys(content, {"values", "points", "cells"});
      if (content.contains("points") != content.contains("cells"))
        throw py::value_error("'values' on a mesh of their own need both 'points' and 'cells'");
      if (content.contains("points"))
        mesh = mesh_of_arrays(content).nodes;
      if (!mesh)
        throw py::value_error("'values' are those at the points of a mesh by arrays, and this case has none; give 'points' and 'cells' "
                              "with them, or {'array': .., 'extent': ..} for a regular grid");
      const Doubles values = numbers(content["values"], "values");
      if (values.ndim() != 1 || std::size_t(values.size()) != mesh->points.size())
        throw py::value_error(fmt::format("'values' must hold {} numbers, one for each point of the mesh, its shape is {}",
                                          mesh->points.size(), shape_text(values)));
      const unsigned dim = mesh->dim;
      return std::make_shared<GivenArray>(
        nodal_function(std::move(mesh), std::vector<double>(values.data(), values.data() + values.size())), dim, dim);
    }
  } // namespace

  bool is_given_value(const py::handle &value)
  {
    if (py::isinstance<py::dict>(value))
      return value.contains("array") || value.contains("values");
    return PyCallable_Check(value.ptr()) != 0;
  }

  std::shared_ptr<const GivenFunction> given_value(const py::handle &value, const std::shared_ptr<const NodalMesh> &mesh)
  {
    if (!py::isinstance<py::dict>(value))
      return std::make_shared<GivenCallable>(py::reinterpret_borrow<py::object>(value));
    const auto content = py::reinterpret_borrow<py::dict>(value);
    return content.contains("array") ? function_of_grid(content) : function_of_nodes(content, mesh);
  }
} // namespace unilateral
