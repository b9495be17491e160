#include "unilateral/discretisation/unknowns_on_finest.h"

#include <algorithm>
#include <array>

namespace unilateral
{
  template <int dim>
  double unknowns_on_finest(const Problem<dim> &problem)
  {
    const unsigned   refinements = std::max(problem.statement.mesh.refine, problem.space.level) - problem.space.level;
    constexpr double of_cube[4][4] = {{1}, {1, 2}, {1, 4, 4}, {1, 6, 12, 8}}, of_simplex[4][4] = {{1}, {1, 2}, {0, 3, 4}, {0, 1, 8, 8}};
    const auto      &made = problem.space.element.simplex() ? of_simplex : of_cube;
    const auto      &mesh = *problem.space.mesh.triangulation;
    std::array<double, 4> n{};
    n[0] = mesh.n_used_vertices();
    n[1] = mesh.n_active_lines();
    if (dim == 3)
      n[2] = mesh.n_active_faces();
    n[dim] = mesh.n_active_cells();
    if (problem.space.subdomain) // those at cuts count more than once
      problem.space.processes().sum(n.data(), n.size());
    for (unsigned level = 0; level < refinements; ++level)
      for (unsigned k = 0; k <= dim; ++k)
      {
        n[k] *= made[k][k];
        for (unsigned j = k + 1; j <= dim; ++j)
          n[k] += n[j] * made[j][k];
      }
    const auto &fe = *problem.space.fe;
    return problem.growth_in_places() * (n[0] * fe.n_dofs_per_vertex() + n[1] * fe.n_dofs_per_line() +
                                         (dim > 1 ? n[2] * fe.n_dofs_per_quad() : 0) + (dim > 2 ? n[3] * fe.n_dofs_per_hex() : 0));
  }

  template double unknowns_on_finest(const Problem<1> &);
  template double unknowns_on_finest(const Problem<2> &);
  template double unknowns_on_finest(const Problem<3> &);
} // namespace unilateral
