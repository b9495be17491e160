#include "unilateral/spaces/cells_of_former_mesh.h"

#include "unilateral/spaces/cell_nodes_of_space.h"

#include <array>
#include <cmath>
#include <map>
#include <memory>
#include <numeric>
#include <string>
#include <utility>
#include <vector>

namespace unilateral
{
  template <int dim>
  FormerMesh record_of(const FunctionSpace<dim> &space)
  {
    FormerMesh record;
    record.centres.reserve(space.mesh.triangulation->n_active_cells());
    for (const auto &cell : space.mesh.triangulation->active_cell_iterators())
    {
      const dealii::Point<dim> centre = cell->center();
      std::array<double, 3>    x{};
      for (unsigned d = 0; d < dim; ++d)
        x[d] = centre[d];
      record.centres.push_back(x);
    }
    return record;
  }

  template <int dim>
  std::vector<unsigned> n_former_cells(const FunctionSpace<dim> &space, const FormerMesh &former)
  {
    CellNodes           nodes = cell_nodes_of(space, /*degree=*/0);
    std::vector<double> numbers(nodes.n_cells());
    std::iota(numbers.begin(), numbers.end(), 0.);
    std::map<std::string, std::vector<double>> functions;
    functions["cell"] = std::move(numbers);
    const auto          cells = std::make_shared<const CellFunctions>(std::move(nodes), std::move(functions));
    std::vector<double> cell_at(former.centres.size());
    cells->function("cell", 1, 0, "the number of a cell")->values(former.centres, cell_at, {});
    std::vector<unsigned> n(space.mesh.triangulation->n_active_cells());
    for (const double cell : cell_at)
      if (std::isfinite(cell))
        ++n[std::size_t(cell)];
    return n;
  }

#define INSTANTIATE(dim)                                                                                                                   \
  template FormerMesh            record_of(const FunctionSpace<dim> &);                                                                    \
  template std::vector<unsigned> n_former_cells(const FunctionSpace<dim> &, const FormerMesh &);
  INSTANTIATE(1)
  INSTANTIATE(2)
  INSTANTIATE(3)
#undef INSTANTIATE
} // namespace unilateral
