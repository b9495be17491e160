// The outward normal on a boundary: of the geometry where it is known, and one for each flat side where faces meet.
#pragma once

#include <deal.II/base/point.h>
#include <deal.II/base/tensor.h>
#include <deal.II/fe/fe_values.h>

#include <vector>

namespace unilateral
{
  /// The normal at a quadrature point of a face: that of the geometry where the mesh knows it (ball, shell), else that of the
  /// mapped cell.
  template <int dim>
  dealii::Tensor<1, dim> boundary_normal(const dealii::FEFaceValues<dim> &values, unsigned q);

  /// The normals of the faces that meet at a node. Faces of one smooth side, up to 50 degrees apart, share the mean of their normals,
  /// weighted with their share of the surface; a sharper edge has two sides or more, each with a normal of its own.
  template <int dim>
  class NodeNormals
  {
  public:
    struct Side
    {
      dealii::Tensor<1, dim> sum;        ///< of weight times normal
      double                 weight = 0; ///< its share of the surface

      dealii::Tensor<1, dim> normal() const { return sum / sum.norm(); }
    };

    void                     add(const dealii::Tensor<1, dim> &normal, double weight);
    const std::vector<Side> &sides() const { return all; }

  private:
    std::vector<Side> all;
  };
} // namespace unilateral
