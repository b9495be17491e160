// The mapping of curved triangles and tetrahedra.
#pragma once

#include "unilateral/mesh/curved_cells.h"

#include <deal.II/fe/fe_simplex_p.h>
#include <deal.II/fe/mapping_fe.h>

#include <memory>
#include <vector>

namespace unilateral
{
  /// Polynomials of degree 2 whose nodes lie where CurvedCells says.
  template <int dim>
  class CurvedSimplexMapping : public dealii::MappingFE<dim>
  {
  public:
    /// Keeps a reference to @p cells, which may follow refinement.
    explicit CurvedSimplexMapping(const CurvedCells<dim> &cells) : dealii::MappingFE<dim>(dealii::FE_SimplexP<dim>(2)), cells(cells) {}

    std::unique_ptr<dealii::Mapping<dim>> clone() const override { return std::make_unique<CurvedSimplexMapping<dim>>(cells); }

  protected:
    std::vector<dealii::Point<dim>>
    compute_mapping_support_points(const typename dealii::Triangulation<dim>::cell_iterator &cell) const override
    {
      return cells.nodes(cell);
    }

  private:
    const CurvedCells<dim> &cells;
  };
} // namespace unilateral
