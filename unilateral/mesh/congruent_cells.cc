#include "unilateral/mesh/congruent_cells.h"

#include <deal.II/fe/mapping_fe.h>
#include <deal.II/fe/mapping_q.h>

#include <cmath>
#include <limits>

namespace unilateral
{
  using namespace dealii;

  template <int dim>
  bool is_multilinear(const Mapping<dim> &mapping)
  {
    if (const auto *const polynomial = dynamic_cast<const MappingQ<dim> *>(&mapping))
      return polynomial->get_degree() == 1;
    if (const auto *const on_simplices = dynamic_cast<const MappingFE<dim> *>(&mapping))
      return on_simplices->get_degree() == 1;
    return false;
  }

  template <int dim>
  CellShapes<dim>::CellShapes(const Triangulation<dim> &triangulation, const Mapping<dim> &mapping)
    : CellShapes(triangulation, mapping, {true})
  {
    by_region = false;
  }

  template <int dim>
  CellShapes<dim>::CellShapes(const Triangulation<dim> &triangulation, const Mapping<dim> &mapping, const std::vector<bool> &repeats)
    : by_region(true), repeats(is_multilinear(mapping) ? repeats : std::vector<bool>(repeats.size(), false))
  {
    double extent = 0;
    for (const auto &vertex : triangulation.get_vertices())
      extent = std::max(extent, vertex.norm_square());
    round_off = 8 * std::numeric_limits<double>::epsilon() * std::sqrt(extent);
  }

  template <int dim>
  unsigned CellShapes<dim>::find(const types::material_id region, const Edges &edges, const unsigned n_vertices, const double tolerance)
  {
    const auto same = [&](const Shape &shape)
    {
      if (shape.region != region)
        return false;
      for (unsigned v = 1; v < n_vertices; ++v)
        for (unsigned d = 0; d < dim; ++d)
          if (!(std::abs(shape.edges[v][d] - edges[v][d]) <= tolerance))
            return false;
      return true;
    };
    if (last < shapes.size() && same(shapes[last]))
      return last;
    for (std::size_t k = 0; k < shapes.size(); ++k)
      if (same(shapes[k]))
        return last = k;
    if (shapes.size() == most_shapes)
      return none;
    last = shapes.size();
    shapes.push_back({region, edges});
    return last;
  }

#define INSTANTIATE(dim)                                                                                                                   \
  template bool is_multilinear(const Mapping<dim> &);                                                                                      \
  template class CellShapes<dim>;
  INSTANTIATE(1)
  INSTANTIATE(2)
  INSTANTIATE(3)
#undef INSTANTIATE
} // namespace unilateral
