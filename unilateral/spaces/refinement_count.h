// How many cells local refinements make of one cell.
#pragma once

#include "unilateral/functions/field_function.h"

#include <deal.II/base/point.h>
#include <deal.II/grid/tria.h>

#include <cstddef>
#include <vector>

namespace unilateral
{
  /// Refines single cells in thought: @p n_everywhere times as a whole, and then once for each of @p places what has its centre or a corner
  /// where that is not zero, as FunctionSpace::cells_at() does. Cells are taken for straight, and triangles and tetrahedra for halved along
  /// all edges; what neighbours ask for is left out.
  template <int dim>
  class RefinementCount
  {
  public:
    explicit RefinementCount(std::vector<FieldFunction> places, unsigned n_everywhere = 0);

    /// How many cells @p cell becomes by the local refinements, for each that those of the whole mesh make of it. After a million looks at
    /// cells and what they become, the children of a cell are taken to be alike.
    double operator()(const typename dealii::Triangulation<dim>::cell_iterator &cell);

  private:
    using Corners = std::vector<dealii::Point<dim>>;
    std::size_t n_taken(std::size_t k, const Corners &points);
    double      count(const Corners &corners, unsigned round);

    static constexpr double          n_children = 1u << dim;
    const std::vector<FieldFunction> places;
    const unsigned                   n_everywhere;
    std::size_t                      n_looks = 0;
    std::vector<double>              values; ///< of a place
  };
} // namespace unilateral
