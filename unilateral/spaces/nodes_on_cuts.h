// Nodes on the edges and faces at which a mesh was cut, by names that every process gives them alike.
#pragma once

#include "unilateral/mesh/simplex_refinement.h"
#include "unilateral/mesh/subdomain.h"

#include <deal.II/dofs/dof_handler.h>

#include <array>
#include <cstdint>
#include <tuple>
#include <utility>
#include <vector>

namespace unilateral
{
  /// A node on an edge or face of a coarse cell: its weights at the vertices there, in an order of their own.
  struct NodeName
  {
    std::array<std::uint32_t, 4> vertex{};
    std::array<std::uint64_t, 4> weight{}; ///< 0: no vertex
    std::uint32_t                component = 0;

    bool operator<(const NodeName &other) const
    {
      return std::tie(vertex, weight, component) < std::tie(other.vertex, other.weight, other.component);
    }
  };

  /// Names with the unknowns there, each unknown once, in the order of the names, which is the same on all processes.
  using NamedUnknowns = std::vector<std::pair<NodeName, std::uint32_t>>;

  /// The nodes at which another process may have a cell, of Lagrange elements on the part, or of Hermite elements, whose values and
  /// derivatives at a vertex count as components.
  template <int dim>
  NamedUnknowns hypercube_nodes_on_cuts(const Subdomain<dim> &subdomain, const dealii::DoFHandler<dim> &dof_handler);

  /// The same of simplices. @p lines_cut: by each refinement since the mesh was divided.
  template <int dim>
  NamedUnknowns simplex_nodes_on_cuts(const Subdomain<dim>          &subdomain,
                                      const dealii::DoFHandler<dim> &dof_handler,
                                      const std::vector<CutLines>   &lines_cut);
} // namespace unilateral
