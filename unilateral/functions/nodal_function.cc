#include "unilateral/functions/nodal_function.h"

#include <deal.II/base/tensor.h>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <utility>

namespace unilateral
{
  namespace
  {
    using Coordinates = std::array<double, 3>;

    /// A point may lie outside of the mesh by this much of a cell: nodes on a boundary are computed with round-off.
    constexpr double outside_tolerance = 1e-6;

    /// The shape functions of a cell at a point of its reference cell, and their derivatives there.
    struct Shapes
    {
      std::array<double, 8>      values{};
      std::array<Coordinates, 8> slopes{};
    };

    Shapes shapes_at(const Coordinates &xi, const unsigned dim, const bool simplex)
    {
      Shapes shapes;
      if (simplex)
      {
        shapes.values[0] = 1;
        for (unsigned d = 0; d < dim; ++d)
        {
          shapes.values[0] -= xi[d];
          shapes.values[d + 1] = xi[d];
          shapes.slopes[0][d] = -1;
          shapes.slopes[d + 1][d] = 1;
        }
        return shapes;
      }
      for (unsigned k = 0; k < (1u << dim); ++k)
      {
        shapes.values[k] = 1;
        shapes.slopes[k].fill(1);
        for (unsigned d = 0; d < dim; ++d)
        {
          const bool   far = k >> d & 1;
          const double factor = far ? xi[d] : 1 - xi[d];
          shapes.values[k] *= factor;
          for (unsigned e = 0; e < dim; ++e)
            shapes.slopes[k][e] *= e == d ? (far ? 1 : -1) : factor;
        }
      }
      return shapes;
    }

    /// Finds the cell at a point by a grid of boxes, each with the cells that reach into it.
    class CellFinder
    {
    public:
      explicit CellFinder(const NodalMesh &mesh) : mesh(mesh)
      {
        lower.fill(std::numeric_limits<double>::max());
        Coordinates upper;
        upper.fill(-std::numeric_limits<double>::max());
        for (const Coordinates &x : mesh.points)
          for (unsigned d = 0; d < mesh.dim; ++d)
          {
            lower[d] = std::min(lower[d], x[d]);
            upper[d] = std::max(upper[d], x[d]);
          }
        const double n = std::ceil(std::pow(double(mesh.cells.size()), 1. / mesh.dim));
        for (unsigned d = 0; d < mesh.dim; ++d)
        {
          n_boxes[d] = std::size_t(std::clamp(n, 1., 1000.));
          size[d] = std::max((upper[d] - lower[d]) / double(n_boxes[d]), std::numeric_limits<double>::min());
        }
        cells.resize(n_boxes[0] * n_boxes[1] * n_boxes[2]);
        for (unsigned c = 0; c < mesh.cells.size(); ++c)
          for_each_box(mesh.cells[c], [&](const std::size_t box) { cells[box].push_back(c); });
      }

      /// Those that may contain @p x.
      const std::vector<unsigned> &near(const Coordinates &x) const
      {
        std::array<std::size_t, 3> box{};
        for (unsigned d = 0; d < mesh.dim; ++d)
          box[d] = index(x[d], d);
        return cells[(box[2] * n_boxes[1] + box[1]) * n_boxes[0] + box[0]];
      }

    private:
      std::size_t index(const double x, const unsigned d) const
      {
        return std::size_t(std::clamp((x - lower[d]) / size[d], 0., double(n_boxes[d] - 1)));
      }

      template <typename Action>
      void for_each_box(const std::vector<unsigned> &cell, const Action &action) const
      {
        std::array<std::size_t, 3> first{}, last{};
        for (unsigned d = 0; d < mesh.dim; ++d)
        {
          double least = std::numeric_limits<double>::max(), most = -least;
          for (const unsigned v : cell)
          {
            least = std::min(least, mesh.points[v][d]);
            most = std::max(most, mesh.points[v][d]);
          }
          const double margin = 1e-5 * (most - least);
          first[d] = index(least - margin, d);
          last[d] = index(most + margin, d);
        }
        for (std::size_t z = first[2]; z <= last[2]; ++z)
          for (std::size_t y = first[1]; y <= last[1]; ++y)
            for (std::size_t x = first[0]; x <= last[0]; ++x)
              action((z * n_boxes[1] + y) * n_boxes[0] + x);
      }

      const NodalMesh                   &mesh;
      Coordinates                        lower{}, size{};
      std::array<std::size_t, 3>         n_boxes = {1, 1, 1};
      std::vector<std::vector<unsigned>> cells;
    };

    class NodalSource : public FieldFunction::Source
    {
    public:
      NodalSource(std::shared_ptr<const NodalMesh> nodes, std::vector<double> at_nodes)
        : mesh(std::move(nodes)), nodal_values(std::move(at_nodes)), finder(*mesh)
      {
      }

      double value(const double x, const double y, const double z) const override
      {
        double result = 0;
        if (!evaluate({x, y, z}, result, nullptr))
          throw std::domain_error("outside of the mesh of the nodal values");
        return result;
      }

      bool values(const std::span<const Coordinates> points,
                  const std::span<double>            values,
                  const std::span<Coordinates>       gradients) const override
      {
        for (std::size_t i = 0; i < points.size(); ++i)
          if (!evaluate(points[i], values[i], gradients.empty() ? nullptr : &gradients[i]))
            values[i] = std::numeric_limits<double>::quiet_NaN();
        return true;
      }

      std::string explanation() const override { return "nodal values"; }

    private:
      bool evaluate(const Coordinates &x, double &value, Coordinates *const gradient) const
      {
        // The cell that contains the point best: one where it lies inside, else the one that it is least outside of.
        double      least = outside_tolerance;
        unsigned    best = 0;
        Coordinates at_best{};
        bool        found = false;
        for (const unsigned c : finder.near(x))
        {
          Coordinates  xi{};
          const double outside = map_back(x, mesh->cells[c], xi);
          if (outside > least)
            continue;
          found = true;
          least = outside;
          best = c;
          at_best = xi;
          if (outside <= 0)
            break;
        }
        if (!found)
          return false;
        const auto  &cell = mesh->cells[best];
        const Shapes shapes = shapes_at(at_best, mesh->dim, simplex(cell));
        value = 0;
        for (std::size_t k = 0; k < cell.size(); ++k)
          value += nodal_values[cell[k]] * shapes.values[k];
        if (gradient)
          *gradient = slope(cell, shapes);
        return true;
      }

      bool simplex(const std::vector<unsigned> &cell) const { return cell.size() == mesh->dim + 1 && mesh->dim > 1; }

      dealii::Tensor<2, 3> jacobian(const std::vector<unsigned> &cell, const Shapes &shapes) const
      {
        dealii::Tensor<2, 3> J;
        for (unsigned d = 0; d < 3; ++d)
          for (unsigned e = 0; e < 3; ++e)
          {
            J[d][e] = d >= mesh->dim && d == e ? 1 : 0;
            if (d < mesh->dim && e < mesh->dim)
              for (std::size_t k = 0; k < cell.size(); ++k)
                J[d][e] += mesh->points[cell[k]][d] * shapes.slopes[k][e];
          }
        return J;
      }

      Coordinates slope(const std::vector<unsigned> &cell, const Shapes &shapes) const
      {
        dealii::Tensor<1, 3> on_reference_cell;
        for (std::size_t k = 0; k < cell.size(); ++k)
          for (unsigned e = 0; e < mesh->dim; ++e)
            on_reference_cell[e] += nodal_values[cell[k]] * shapes.slopes[k][e];
        const dealii::Tensor<1, 3> gradient = dealii::transpose(dealii::invert(jacobian(cell, shapes))) * on_reference_cell;
        return {gradient[0], gradient[1], gradient[2]};
      }

      /// The place @p xi of @p x on the reference cell, by Newton's method; how far it is outside of that, at most 0 inside.
      double map_back(const Coordinates &x, const std::vector<unsigned> &cell, Coordinates &xi) const
      {
        const unsigned dim = mesh->dim;
        const bool     straight = simplex(cell);
        for (unsigned d = 0; d < dim; ++d)
          xi[d] = straight ? 1. / (dim + 1) : 0.5;
        for (unsigned step = 0; step < (straight || dim == 1 ? 1u : 20u); ++step)
        {
          const Shapes         shapes = shapes_at(xi, dim, straight);
          dealii::Tensor<1, 3> residual;
          for (unsigned d = 0; d < dim; ++d)
          {
            residual[d] = x[d];
            for (std::size_t k = 0; k < cell.size(); ++k)
              residual[d] -= mesh->points[cell[k]][d] * shapes.values[k];
          }
          const dealii::Tensor<1, 3> change = dealii::invert(jacobian(cell, shapes)) * residual;
          for (unsigned d = 0; d < dim; ++d)
            xi[d] += change[d];
          if (!(change.norm() < 1e3))
            return std::numeric_limits<double>::max();
          if (change.norm() < 1e-12)
            break;
        }
        double outside = -1, sum = 0;
        for (unsigned d = 0; d < dim; ++d)
        {
          outside = std::max({outside, -xi[d], straight ? -1. : xi[d] - 1});
          sum += xi[d];
        }
        return straight ? std::max(outside, sum - 1) : outside;
      }

      const std::shared_ptr<const NodalMesh> mesh;
      const std::vector<double>              nodal_values;
      const CellFinder                       finder;
    };
  } // namespace

  std::shared_ptr<const FieldFunction::Source> nodal_function(std::shared_ptr<const NodalMesh> mesh, std::vector<double> values)
  {
    if (values.size() != mesh->points.size())
      throw std::runtime_error(fmt::format("{} values, but the mesh has {} points", values.size(), mesh->points.size()));
    return std::make_shared<NodalSource>(std::move(mesh), std::move(values));
  }
} // namespace unilateral
