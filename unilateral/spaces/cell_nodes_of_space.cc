#include "unilateral/spaces/cell_nodes_of_space.h"

#include <deal.II/fe/fe_values.h>

#include <algorithm>
#include <array>
#include <numeric>
#include <vector>

namespace unilateral
{
  using namespace dealii;

  template <int dim>
  Quadrature<dim> lattice_points(const CellNodes &nodes, const unsigned degree)
  {
    std::vector<Point<dim>> points;
    for (const auto &index : nodes.lattice(degree))
    {
      Point<dim> x;
      for (unsigned d = 0; d < dim; ++d)
        x[d] = degree > 0 ? double(index[d]) / degree : nodes.simplex ? 1. / (dim + 1) : 0.5;
      points.push_back(x);
    }
    return Quadrature<dim>(points);
  }

  template <int dim>
  CellNodes cell_nodes_of(const FunctionSpace<dim> &space, const unsigned degree)
  {
    CellNodes nodes;
    nodes.dim = dim;
    nodes.simplex = dim > 1 && space.fe->reference_cell().is_simplex();
    nodes.degree = degree;
    nodes.map_degree = space.mesh.curved || space.mesh.curved_cells ? std::max(space.element.degree, 1u) : 1;

    FEValues<dim>     values(*space.mapping, *space.fe, lattice_points<dim>(nodes, nodes.map_degree), update_quadrature_points);
    const std::size_t n_cells = space.mesh.triangulation->n_active_cells();
    nodes.points.reserve(n_cells * nodes.n_map_nodes());
    for (const auto &cell : space.dof_handler.active_cell_iterators())
    {
      values.reinit(cell);
      for (const Point<dim> &x : values.get_quadrature_points())
      {
        std::array<double, 3> point{};
        for (unsigned d = 0; d < dim; ++d)
          point[d] = x[d];
        nodes.points.push_back(point);
      }
    }
    nodes.map_nodes.resize(nodes.points.size());
    std::iota(nodes.map_nodes.begin(), nodes.map_nodes.end(), 0);
    nodes.value_nodes.resize(n_cells * nodes.n_value_nodes());
    std::iota(nodes.value_nodes.begin(), nodes.value_nodes.end(), 0);
    return nodes;
  }

  template CellNodes     cell_nodes_of(const FunctionSpace<1> &, unsigned);
  template CellNodes     cell_nodes_of(const FunctionSpace<2> &, unsigned);
  template CellNodes     cell_nodes_of(const FunctionSpace<3> &, unsigned);
  template Quadrature<1> lattice_points(const CellNodes &, unsigned);
  template Quadrature<2> lattice_points(const CellNodes &, unsigned);
  template Quadrature<3> lattice_points(const CellNodes &, unsigned);
} // namespace unilateral
