// A part of a coarse mesh on its way from the process that made the mesh to the one that gets it.
#pragma once

#include "unilateral/mesh/division.h"
#include "unilateral/mesh/mesh.h"
#include "unilateral/mesh/subdomain.h"

#include <memory>
#include <vector>

namespace unilateral
{
  /// Whether parts of @p whole can be sent: its cells are straight or have their own nodes. Those that follow a manifold or a drawing can
  /// not, since their refinement needs it as a whole.
  template <int dim>
  bool can_be_sent(const Mesh<dim> &whole);

  /// The cells of @p whole, a coarse mesh, that @p division gives to the process @p rank, and whose cells are around. @p cells_at_vertex:
  /// see find_cells_at_vertices().
  template <int dim>
  std::vector<char>
  pack_part(const Mesh<dim> &whole, const Division &division, const std::vector<std::vector<unsigned>> &cells_at_vertex, unsigned rank);

  /// The same as cut_out_subdomain() leaves, but that the process does not know the mesh as a whole.
  template <int dim>
  struct ReceivedPart
  {
    Mesh<dim>                       mesh;
    std::unique_ptr<Subdomain<dim>> subdomain;
  };
  template <int dim>
  ReceivedPart<dim> unpack_part(const std::vector<char> &bytes, const Processes &processes);
} // namespace unilateral
