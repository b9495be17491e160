// A cell cut into simplices that meet in a point inside.
#pragma once

#include <deal.II/base/point.h>
#include <deal.II/base/quadrature.h>
#include <deal.II/base/tensor.h>

#include <array>
#include <vector>

namespace unilateral
{
  /// Part j of the split has facet j on the boundary of the cell, and the inner point as its last corner. Triangles have 3 parts,
  /// quadrilaterals 4, tetrahedra 4; hexahedra 24: the faces are cut from their middles, so that the split looks the same from everywhere.
  template <int dim>
  struct CellSplit
  {
    /// @p corners in the order of the reference cell.
    CellSplit(const std::vector<dealii::Point<dim>> &corners, bool simplex);

    struct Facet
    {
      unsigned                            face; ///< of the cell
      std::array<dealii::Point<dim>, dim> corners;
      dealii::Tensor<1, dim>              normal; ///< outwards, of unit length
    };
    struct InnerFacet
    {
      std::array<unsigned, 2>             parts;
      std::array<dealii::Point<dim>, dim> corners;
      dealii::Tensor<1, dim>              normal;
    };
    std::array<dealii::Point<dim>, dim + 1> part(unsigned j) const;
    double                                  volume(unsigned j) const;

    dealii::Point<dim>      centre;
    std::vector<Facet>      facets;
    std::vector<InnerFacet> inner;
  };

  /// The points of a rule on a facet.
  template <int dim>
  std::vector<dealii::Point<dim>> points_on_facet(const std::array<dealii::Point<dim>, dim> &corners,
                                                  const dealii::Quadrature<dim - 1>         &rule);
} // namespace unilateral
