// The map from the reference cell to the cells of a mesh.
#pragma once

#include "unilateral/mesh/mesh.h"
#include "unilateral/spaces/element.h"

#include <deal.II/fe/mapping.h>

#include <memory>

namespace unilateral
{
  /// Straight cells are affine or multilinear images of the reference cell; curved ones get polynomials of the degree of the element, or
  /// of degree 2, where that is the geometry's. A higher degree than the element's would leave rigid body modes out of V_h. Refers to
  /// the curved cells of @p mesh.
  template <int dim>
  std::unique_ptr<dealii::Mapping<dim>> make_mapping(const ElementName &element, const Mesh<dim> &mesh);

  /// Where curved cells lie is asked of the geometry once for each mesh: it takes longer than whatever is done with a cell.
  template <int dim>
  void place_cells(dealii::Mapping<dim> &mapping, const Mesh<dim> &mesh);
} // namespace unilateral
