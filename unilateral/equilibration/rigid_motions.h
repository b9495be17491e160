// The rigid body modes as six numbers, or three.
#pragma once

#include <deal.II/base/point.h>
#include <deal.II/base/tensor.h>

#include <Eigen/Core>

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

  /// The modes @p others, of another centre and size, in terms of @p modes: column k has the coefficients of others.at()[k].
  template <int dim>
  Eigen::Matrix<double, int(RigidMotions<dim>::n), int(RigidMotions<dim>::n)> in_terms_of(const RigidMotions<dim> &modes,
                                                                                          const RigidMotions<dim> &others)
  {
    constexpr int               n = RigidMotions<dim>::n;
    Eigen::Matrix<double, n, n> result = Eigen::Matrix<double, n, n>::Zero();
    const auto                  at_centre = others.at(modes.centre);
    for (int k = 0; k < n; ++k)
    {
      for (int d = 0; d < dim; ++d)
        result(d, k) = at_centre[k][d];
      if (k >= dim)
        result(k, k) = modes.size / others.size;
    }
    return result;
  }
} // namespace unilateral
