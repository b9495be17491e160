#include "unilateral/mesh/drawn_cells.h"

#include <deal.II/base/tensor.h>

#include <algorithm>
#include <utility>

namespace unilateral
{
  using namespace dealii;

  std::vector<std::array<unsigned, 3>> equidistant_points(const bool simplex, const unsigned dim, const unsigned degree)
  {
    std::vector<std::array<unsigned, 3>> points;
    for (unsigned k = 0; k <= (dim > 2 ? degree : 0); ++k)
      for (unsigned j = 0; j <= (dim > 1 ? degree : 0); ++j)
        for (unsigned i = 0; i <= degree; ++i)
          if (!simplex || i + j + k <= degree)
            points.push_back({i, j, k});
    return points;
  }

  template <int dim>
  DrawnCells<dim>::DrawnCells(const bool simplex, const unsigned degree)
    : simplex(simplex), degree(degree), lattice(equidistant_points(simplex, dim, degree))
  {
  }

  template <int dim>
  void DrawnCells<dim>::add(const unsigned coarse_cell, const Corners &corners, std::vector<Point<dim>> nodes)
  {
    cells[coarse_cell] = {corners, std::move(nodes)};
  }

  template <int dim>
  double DrawnCells<dim>::shape(const std::array<unsigned, 3> &i, const Point<dim> &unit) const
  {
    double value = 1;
    if (simplex)
    {
      // prod_c prod_{k < i_c} (g lambda_c - k) / (k + 1), with lambda_0 = 1 - sum lambda_c.
      const auto factors = [&](const unsigned power, const double lambda)
      {
        for (unsigned k = 0; k < power; ++k)
          value *= (degree * lambda - k) / (k + 1);
      };
      unsigned rest = degree;
      double   lambda_0 = 1;
      for (unsigned d = 0; d < dim; ++d)
      {
        factors(i[d], unit[d]);
        rest -= i[d];
        lambda_0 -= unit[d];
      }
      factors(rest, lambda_0);
      return value;
    }
    for (unsigned d = 0; d < dim; ++d)
      for (unsigned k = 0; k <= degree; ++k)
        if (k != i[d])
          value *= (degree * unit[d] - k) / (double(i[d]) - k);
    return value;
  }

  template <int dim>
  Point<dim> DrawnCells<dim>::position(const Cell &cell, const Point<dim> &unit) const
  {
    Point<dim> x;
    for (std::size_t n = 0; n < lattice.size(); ++n)
      x += shape(lattice[n], unit) * cell.nodes[n];
    return x;
  }

  template <int dim>
  Point<dim> DrawnCells<dim>::position(const unsigned coarse_cell, const Point<dim> &unit) const
  {
    const Cell &cell = cells.at(coarse_cell);
    Point<dim>  there = cell.corners[0];
    for (unsigned d = 0; d < dim; ++d)
      there += unit[d] * (cell.corners[d + 1] - cell.corners[0]);
    return position(cell, there);
  }

  template <int dim>
  std::vector<unsigned> DrawnCells<dim>::folded_cells() const
  {
    const double step = 1e-4; // F is smooth, and its size that of the cell: differences have six digits
    const auto   jacobian = [&](const unsigned cell, const Point<dim> &unit)
    {
      Tensor<2, dim> J;
      for (unsigned d = 0; d < dim; ++d)
      {
        const Tensor<1, dim> half_step = step * Point<dim>::unit_vector(d);
        const Tensor<1, dim> slope = (position(cell, unit + half_step) - position(cell, unit - half_step)) / (2 * step);
        for (unsigned c = 0; c < dim; ++c)
          J[c][d] = slope[c];
      }
      return J;
    };
    std::vector<unsigned> folded;
    for (const auto &[index, cell] : cells)
      for (const auto &i : lattice)
      {
        Point<dim> unit;
        for (unsigned d = 0; d < dim; ++d)
          unit[d] = double(i[d]) / degree;
        if (determinant(jacobian(index, unit)) > 0)
          continue;
        folded.push_back(index);
        break;
      }
    return folded;
  }

  template class DrawnCells<1>;
  template class DrawnCells<2>;
  template class DrawnCells<3>;
} // namespace unilateral
