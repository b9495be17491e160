// Cells that are parallel shifts of each other: what is integrated on one of them holds on all.
#pragma once

#include <deal.II/base/geometry_info.h>
#include <deal.II/base/tensor.h>
#include <deal.II/fe/mapping.h>
#include <deal.II/grid/tria.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

namespace unilateral
{
  /// The corners of a cell alone say where its points lie: lines, planes and multilinear images, no curved cells.
  template <int dim>
  bool is_multilinear(const dealii::Mapping<dim> &mapping);

  /// Numbers the shapes of cells. Two cells have the same shape when one is the other moved, up to round-off; a uniformly refined mesh of
  /// parallelograms has as many as its coarse mesh. On curved cells no two shapes are taken to be the same.
  template <int dim>
  class CellShapes
  {
  public:
    static constexpr unsigned none = static_cast<unsigned>(-1);

    /// Geometry alone counts.
    CellShapes(const dealii::Triangulation<dim> &triangulation, const dealii::Mapping<dim> &mapping);

    /// Cells of different regions (material_id) differ, and in those without @p repeats each cell is like no other: for integrals with
    /// coefficients that are constant in some regions.
    CellShapes(const dealii::Triangulation<dim> &triangulation, const dealii::Mapping<dim> &mapping, const std::vector<bool> &repeats);

    /// The number of the cell's shape, one more than the largest so far when it is new, or none: the cell is like no other, or there are
    /// too many shapes.
    template <typename Cell>
    unsigned operator()(const Cell &cell)
    {
      const auto region = by_region ? cell->material_id() : 0;
      if (!repeats[region])
        return none;
      Edges          edges;
      const auto    &origin = cell->vertex(0);
      const unsigned n_vertices = cell->n_vertices();
      double         size = 0;
      for (unsigned v = 1; v < n_vertices; ++v)
      {
        edges[v] = cell->vertex(v) - origin;
        for (unsigned d = 0; d < dim; ++d)
          size = std::max(size, std::abs(edges[v][d]));
      }
      return find(region, edges, n_vertices, 1e-12 * size + round_off);
    }

  private:
    /// From the first corner to the others.
    using Edges = std::array<dealii::Tensor<1, dim>, dealii::GeometryInfo<dim>::vertices_per_cell>;

    struct Shape
    {
      dealii::types::material_id region;
      Edges                      edges;
    };

    unsigned find(dealii::types::material_id region, const Edges &edges, unsigned n_vertices, double tolerance);

    static constexpr std::size_t most_shapes = 256; ///< to compare with

    bool               by_region;
    std::vector<bool>  repeats;
    double             round_off = 0; ///< of the coordinates
    std::vector<Shape> shapes;
    std::size_t        last = 0; ///< that was found: neighbours tend to be alike
  };
} // namespace unilateral
