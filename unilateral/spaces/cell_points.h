// What points and rules of the reference cell are on one cell after another.
#pragma once

#include "unilateral/mesh/congruent_cells.h"

#include <deal.II/base/point.h>
#include <deal.II/base/quadrature.h>
#include <deal.II/fe/fe_values.h>
#include <deal.II/fe/mapping.h>
#include <deal.II/grid/tria.h>

#include <memory>
#include <vector>

namespace unilateral
{
  /// The images of points of the reference cell. Where corners alone decide, they are sums over the corners, and nothing else is computed.
  template <int dim>
  class CellPoints
  {
  public:
    CellPoints(const dealii::Mapping<dim> &mapping, dealii::ReferenceCell cell, const std::vector<dealii::Point<dim>> &unit_points);

    /// Until the next call.
    const std::vector<dealii::Point<dim>> &on(const typename dealii::Triangulation<dim>::cell_iterator &cell);

  private:
    std::vector<dealii::Point<dim>>             points;
    std::vector<std::vector<double>>            corner_weights; ///< points x corners; none on curved cells
    std::unique_ptr<dealii::FiniteElement<dim>> no_function;
    std::unique_ptr<dealii::FEValues<dim>>      values; ///< on curved cells
  };

  /// The weights of a rule times the Jacobian at its points, computed once for cells of the same shape.
  template <int dim>
  class CellWeights
  {
  public:
    CellWeights(const dealii::Mapping<dim>       &mapping,
                const dealii::Triangulation<dim> &triangulation,
                dealii::ReferenceCell             cell,
                const dealii::Quadrature<dim>    &rule);

    /// Until the next call.
    const std::vector<double> &on(const typename dealii::Triangulation<dim>::cell_iterator &cell);

  private:
    CellShapes<dim>                             shapes;
    std::vector<std::vector<double>>            known; ///< by shape
    std::unique_ptr<dealii::FiniteElement<dim>> no_function;
    dealii::FEValues<dim>                       values;
  };
} // namespace unilateral
