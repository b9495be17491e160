// What a run with refinement by the error leaves of each mesh that it has finished: fields, and what another run needs to go on.
#pragma once

#include "cli/console.h"

#include "unilateral/base/processes.h"
#include "unilateral/case/case.h"
#include "unilateral/output/result_files.h"
#include "unilateral/solution.h"

#include <optional>
#include <string>

namespace unilateral
{
  template <int dim>
  class FinishedMeshes
  {
  public:
    /// @p files: of the results in @p directory; made for the first mesh.
    FinishedMeshes(const std::string &directory, const Case &request, const Processes &processes, std::optional<ResultFiles> &files);

    /// The solution on a mesh that another one follows. Collective. Throws OutputError.
    void add(const Solution<dim> &solution);

    unsigned n() const { return n_meshes; }

    /// After an interruption: puts the solutions on the meshes so far in their places, where these are not taken by a former run's results,
    /// and says what there is. False: nothing.
    bool leave(Console &console);

  private:
    bool publish(Console &console);

    const std::string           directory;
    const Case                 &request;
    const Processes             processes;
    std::optional<ResultFiles> &files;
    const bool                  may_be_resumed; ///< the folder has no restart file of a load history, which would be overwritten
    unsigned                    n_meshes = 0;
  };
} // namespace unilateral
