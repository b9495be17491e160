// The solution as files for ParaView.
#pragma once

#include "unilateral/output/vtu_file.h"
#include "unilateral/solve.h"

#include <optional>
#include <string>

namespace unilateral
{
  /// Writes solution.vtu (u, the bounds in the domain where they are finite, the nodal contact pressure; of a body the recovered stress and
  /// its principal values) and constraint-points.vtu (pressure, gap, penetration, ... at the points of I_G) into @p directory, which
  /// exists. Of a mesh of adaptive refinement that others follow (@p cycle, from 0): solution.CYCLE.vtu and so on.
  template <int dim>
  void write_solution(const Solution<dim> &solution, const std::string &directory, std::optional<unsigned> cycle = {});

  /// Writes solution.pvd and constraint-points.pvd: the files of the meshes, @p n_cycles with numbers and @p last the one without, one
  /// after the other, as a sequence for ParaView.
  void write_cycles_pvd(unsigned n_cycles, bool last, const std::string &directory);

  /// Writes constraint-points.csv into @p directory: what constraint-points.vtu has, a line for each point of I_G, in its first column the
  /// part of the constraint. Where several processes share the mesh each writes its points, constraint-points.RANK.csv.
  template <int dim>
  void write_constraint_points_csv(const Solution<dim> &solution, const std::string &directory);

  /// What write_solution() writes, without files.
  struct SolutionGrids
  {
    VtuGrid solution, points;
  };
  template <int dim>
  SolutionGrids grids_of(const Solution<dim> &solution);

  /// Is @p name that of such a file, or of a piece that one of several processes has written?
  bool is_solution_file(const std::string &name);
} // namespace unilateral
