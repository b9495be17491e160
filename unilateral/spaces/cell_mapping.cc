#include "unilateral/spaces/cell_mapping.h"

#include "unilateral/spaces/curved_simplex_mapping.h"

#include <deal.II/fe/fe_simplex_p.h>
#include <deal.II/fe/mapping_fe.h>
#include <deal.II/fe/mapping_q.h>
#include <deal.II/fe/mapping_q_cache.h>

#include <algorithm>

namespace unilateral
{
  using namespace dealii;

  template <int dim>
  std::unique_ptr<Mapping<dim>> make_mapping(const ElementName &element, const Mesh<dim> &mesh)
  {
    if (element.simplex())
    {
      if (mesh.curved_cells && element.degree > 1)
        return std::make_unique<CurvedSimplexMapping<dim>>(*mesh.curved_cells);
      return std::make_unique<MappingFE<dim>>(FE_SimplexP<dim>(1));
    }
    unsigned degree = mesh.curved && element.family != ElementName::Family::hermite ? std::max(element.degree, 1u) : 1;
    if (mesh.curved_cells)
      degree = std::min(degree, 2u);
    if (degree == 1)
      return std::make_unique<MappingQ<dim>>(1);
    return std::make_unique<MappingQCache<dim>>(degree);
  }

  template <int dim>
  void place_cells(Mapping<dim> &mapping, const Mesh<dim> &mesh)
  {
    auto *const cache = dynamic_cast<MappingQCache<dim> *>(&mapping);
    if (cache && mesh.curved_cells)
      cache->initialize(*mesh.triangulation, [&](const auto &cell) { return mesh.curved_cells->nodes(cell); });
    else if (cache)
      cache->initialize(MappingQ<dim>(cache->get_degree()), *mesh.triangulation);
  }

#define INSTANTIATE(dim)                                                                                                                   \
  template std::unique_ptr<Mapping<dim>> make_mapping(const ElementName &, const Mesh<dim> &);                                             \
  template void                          place_cells(Mapping<dim> &, const Mesh<dim> &);
  INSTANTIATE(1)
  INSTANTIATE(2)
  INSTANTIATE(3)
#undef INSTANTIATE
} // namespace unilateral
