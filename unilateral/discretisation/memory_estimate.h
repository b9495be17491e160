// Does the finest level fit into the memory? Asked before anything large is made: a process that runs out of memory is killed without a
// word.
#pragma once

#include "unilateral/base/available_memory.h"
#include "unilateral/discretisation/problem_statement.h"

#include <cstddef>
#include <optional>

namespace unilateral
{
  /// The finest level of a mesh of @p n_coarse_cells in @p dim dimensions.
  struct FinestLevel
  {
    double n_cells = 0, n_dofs = 0;
    double bytes = 0; ///< that a run needs at least: cells, matrix, tangent; measured, and then less to be on the safe side
  };
  FinestLevel finest_level(const ProblemStatement &statement, unsigned dim, std::size_t n_coarse_cells);

  /// Cells of the coarse mesh as far as they are known before it is built: those of a box, else 1.
  std::size_t known_coarse_cells(const ProblemStatement &statement, unsigned dim);

  /// Throws InputError, at what makes the cells so many, when the finest level needs more than @p available bytes.
  void check_memory(const ProblemStatement &statement,
                    unsigned                dim,
                    std::size_t             n_coarse_cells,
                    std::optional<double>   available = available_memory());
} // namespace unilateral
