// In how many steps a mesh is divided among many processes.
#pragma once

#include <vector>

namespace unilateral
{
  /// Factors of @p n_processes, the largest first: a mesh is divided in as many parts as the first one says, each of these by its share of
  /// the processes in as many as the second one says, and so on. None is larger than @p at_once, or than the largest prime factor of
  /// @p n_processes; there are as few of them as that allows, and of these the largest is as small as it can be.
  std::vector<unsigned> division_steps(unsigned n_processes, unsigned at_once);

  /// The step that is next.
  struct DivisionStep
  {
    unsigned n_parts = 1; ///< of each part there is; 1: none yet
    unsigned n_alike;     ///< processes that have the same part then
  };

  /// For a mesh of @p n_cells whose parts, or which itself, @p n_alike of @p n_processes have each: as many of the @p steps to come at a
  /// time as leave @p enough cells for each part.
  DivisionStep next_division(const std::vector<unsigned> &steps, unsigned n_processes, unsigned n_alike, double n_cells, double enough);
} // namespace unilateral
