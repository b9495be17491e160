#include "unilateral/discretisation/memory_estimate.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string>

namespace unilateral
{
  namespace
  {
    /// Per cell and per unknown of a fine mesh: about its share of nodes, and the entries of its row in A.
    struct Density
    {
      double dofs_per_cell, entries_per_row;
    };

    Density density(const ElementName &element, const unsigned dim)
    {
      const double p = std::max(element.degree, 1u);
      if (!element.simplex() || dim == 1)
        return {std::pow(p, dim), std::pow(p + 2, dim)};
      // Two triangles make a square, at least five tetrahedra a cube. At low degrees a row meets fewer neighbours than on the square.
      return dim == 2 ? Density{p * p / 2, 0.75 * std::pow(p + 2, dim)} : Density{p * p * p / 6, 0.5 * std::pow(p + 2, dim)};
    }

    std::string gigabytes(const double bytes)
    {
      return fmt::format("{:.3g} GB", bytes / 1e9);
    }
  } // namespace

  FinestLevel finest_level(const ProblemStatement &statement, const unsigned dim, const std::size_t n_coarse_cells)
  {
    // At most 0.7 of the peak measured with multigrid for assembled matrices, which is 2.5 kB an unknown for P2 tetrahedra (850 000), 3.5
    // for Q1 hexahedra (320 000); membranes and the direct solver take more.
    constexpr double bytes_per_cell = 300, bytes_per_dof = 300, bytes_per_entry = 16;

    const Density density = unilateral::density(statement.model.element, dim);
    FinestLevel   level;
    level.n_cells = double(n_coarse_cells) * std::pow(2., dim * statement.mesh.refine);
    // Every unknown of a scalar problem is as many as u has components, and so is every entry of its row.
    const double components = statement.elastic() ? dim : 1;
    level.n_dofs = level.n_cells * density.dofs_per_cell * components;
    level.bytes = level.n_cells * bytes_per_cell + level.n_dofs * (bytes_per_dof + components * density.entries_per_row * bytes_per_entry);
    return level;
  }

  std::size_t known_coarse_cells(const ProblemStatement &statement, const unsigned dim)
  {
    if (statement.mesh.source != MeshDescription::Source::box)
      return 1;
    std::size_t n = 1;
    for (const unsigned cells : statement.mesh.cells)
      n *= cells;
    const bool simplex = statement.model.element.simplex() && dim > 1;
    return n * (!simplex ? 1 : dim == 2 ? 2 : 5);
  }

  void check_memory(const ProblemStatement     &statement,
                    const unsigned              dim,
                    const std::size_t           n_coarse_cells,
                    const std::optional<double> available)
  {
    const FinestLevel level = finest_level(statement, dim, n_coarse_cells);
    if (available && level.bytes > *available)
      throw InputError(
        statement.mesh.number_where,
        fmt::format("the finest level would have about {:.2g} cells and {:.2g} unknowns, which take {} of memory or more; {} "
                    "are free: lower refine or cells, refine less in places, or take an element of lower degree",
                    level.n_cells, level.n_dofs, gigabytes(level.bytes), gigabytes(*available)),
        MessageName("mesh-too-large"));
  }
} // namespace unilateral
