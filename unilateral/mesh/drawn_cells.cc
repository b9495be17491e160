#include "unilateral/mesh/drawn_cells.h"

#include <deal.II/base/tensor.h>

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
    : simplex(simplex), g(degree), lattice(equidistant_points(simplex, dim, degree))
  {
    for (const auto &i : lattice)
    {
      at.emplace_back();
      for (unsigned d = 0; d < dim; ++d)
        at.back()[d] = double(i[d]) / degree;
    }
  }

  template <int dim>
  std::vector<double> DrawnCells<dim>::shape_functions(const Point<dim> &unit) const
  {
    // Products of one factor for each coordinate, on simplices for each barycentric one.
    std::array<std::vector<double>, dim + 1> factors;
    double                                   first_barycentric = 1;
    for (unsigned d = 0; d < dim; ++d)
      first_barycentric -= unit[d];
    for (unsigned c = 0; c < dim + (simplex ? 1 : 0); ++c)
    {
      const double x = g * (c < dim ? unit[c] : first_barycentric);
      for (unsigned i = 0; i <= g; ++i)
      {
        double factor = 1;
        for (unsigned k = 0; k < (simplex ? i : g + 1); ++k) // simplices: Silvester's form
          if (k != i)
            factor *= (x - k) / (double(i) - k);
        factors[c].push_back(factor);
      }
    }
    std::vector<double> values;
    values.reserve(lattice.size());
    for (const auto &i : lattice)
    {
      double   value = 1;
      unsigned rest = g;
      for (unsigned d = 0; d < dim; ++d)
      {
        value *= factors[d][i[d]];
        rest -= simplex ? i[d] : 0;
      }
      values.push_back(simplex ? value * factors[dim][rest] : value);
    }
    return values;
  }

  template <int dim>
  Point<dim> DrawnCells<dim>::position(const unsigned coarse_cell, const Point<dim> &unit) const
  {
    const std::vector<Point<dim>> &nodes = nodes_of_cell.at(coarse_cell);
    const std::vector<double>      shapes = shape_functions(unit);
    Point<dim>                     x;
    for (std::size_t n = 0; n < nodes.size(); ++n)
      x += shapes[n] * nodes[n];
    return x;
  }

  template <int dim>
  std::vector<unsigned> DrawnCells<dim>::folded_cells() const
  {
    // Derivatives of polynomials of a low degree: central differences have eight digits.
    const double                                      step = 1e-4;
    std::vector<std::array<std::vector<double>, dim>> slopes(at.size());
    for (std::size_t q = 0; q < at.size(); ++q)
      for (unsigned d = 0; d < dim; ++d)
      {
        const Tensor<1, dim> change = step * Point<dim>::unit_vector(d);
        slopes[q][d] = shape_functions(at[q] + change);
        const std::vector<double> before = shape_functions(at[q] - change);
        for (std::size_t n = 0; n < before.size(); ++n)
          slopes[q][d][n] = (slopes[q][d][n] - before[n]) / (2 * step);
      }
    std::vector<unsigned> folded;
    for (const auto &[index, nodes] : nodes_of_cell)
      for (std::size_t q = 0; q < at.size(); ++q)
      {
        Tensor<2, dim> J;
        for (std::size_t n = 0; n < nodes.size(); ++n)
          for (unsigned c = 0; c < dim; ++c)
            for (unsigned d = 0; d < dim; ++d)
              J[c][d] += (nodes[n][c] - nodes[0][c]) * slopes[q][d][n];
        if (determinant(J) > 0)
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
