// The shapes that need no file: box, ball, shell, of segments, quadrilaterals and hexahedra, or of triangles and tetrahedra.
#pragma once

#include "unilateral/mesh/mesh.h"

namespace unilateral
{
  /// @p cells equal boxes a direction; simplices: each square in two right triangles, each cube in five tetrahedra.
  /// Parts: left right bottom top front back.
  template <int dim>
  Mesh<dim>
  box_mesh(const dealii::Point<dim> &lower, const dealii::Point<dim> &upper, const std::vector<unsigned int> &cells, bool simplex);

  /// |x - center| <= radius, part "surface". The boundary follows the sphere under refinement and so does a mapping of any degree on
  /// quadrilaterals and hexahedra; between sphere and straight-sided core cells are blended (transfinite interpolation), which keeps the
  /// order of the mapping. Simplices: a hexagon of six triangles, an icosahedron of twenty tetrahedra. 1-D: two segments.
  template <int dim>
  Mesh<dim> ball_mesh(const dealii::Point<dim> &center, double radius, bool simplex);

  /// inner <= |x - center| <= outer, parts "inner", "outer"; one layer of cells, more of them around the thinner the shell. 2-D and 3-D.
  template <int dim>
  Mesh<dim> shell_mesh(const dealii::Point<dim> &center, double inner, double outer, bool simplex);
} // namespace unilateral
