// The rigid body modes as six numbers, or three.
#pragma once

#include <deal.II/base/point.h>
#include <deal.II/base/tensor.h>

#include <array>

namespace unilateral
{
  /// Translations along the axes, then rotations about a centre, (x - centre)/size turned by a right angle: all of about the same size on a
  /// body of that size.
  template <int dim>
  struct RigidMotions
  {
    static constexpr unsigned n = dim * (dim + 1) / 2;

    std::array<dealii::Tensor<1, dim>, n> at(const dealii::Point<dim> &x) const
    {
      std::array<dealii::Tensor<1, dim>, n> modes;
      for (unsigned c = 0; c < dim; ++c)
        modes[c][c] = 1;
      const dealii::Tensor<1, dim> r = (x - centre) / size;
      for (unsigned a = 0, m = dim; a < dim; ++a)
        for (unsigned b = a + 1; b < dim; ++b, ++m)
        {
          modes[m][a] = -r[b];
          modes[m][b] = r[a];
        }
      return modes;
    }

    dealii::Point<dim> centre;
    double             size = 1;
  };
} // namespace unilateral
