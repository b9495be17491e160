// What an unfinished run with refinement by the error leaves, so that another run goes on from the mesh it had come to.
#pragma once

#include "unilateral/base/processes.h"
#include "unilateral/case/case.h"
#include "unilateral/mesh/former_mesh.h"

#include <memory>
#include <string>

namespace unilateral
{
  /// Writes restart.json and, with the @p own part of the mesh, restart-N-P.bin of each process P, into @p folder; @p number is that of the
  /// mesh among those that were solved. Collective. Throws std::runtime_error.
  void
  write_mesh_restart(const std::string &folder, const Case &request, unsigned number, const FormerMesh &own, const Processes &processes);

  /// The whole mesh, for any number of processes. Throws InputError: no such files, damaged ones, or the mesh of another case. The
  /// tolerance and the goal of the refinement, the number of unknowns that it may come to, title, files and expectations may be others.
  std::shared_ptr<const FormerMesh> read_mesh_restart(const std::string &folder, const Case &request);

  /// Whether @p folder has the restart.json of a load history.
  bool has_restart_of_steps(const std::string &folder);
} // namespace unilateral
