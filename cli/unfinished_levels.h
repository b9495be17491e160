// What a run without refinement by the error leaves for another one that goes on from the level it had come to.
#pragma once

#include "cli/console.h"

#include "unilateral/base/processes.h"
#include "unilateral/base/stopwatch.h"
#include "unilateral/case/case.h"
#include "unilateral/solve.h"

#include <string>

namespace unilateral
{
  template <int dim>
  class UnfinishedLevels
  {
  public:
    UnfinishedLevels(const std::string &directory, const Case &request, const Processes &processes);

    /// The solution on a level: written after some seconds, so that writing takes at most a twentieth of the time. Collective where
    /// processes share the mesh. Throws OutputError.
    void add(const Solution<dim> &solution);

    /// After an interruption: writes the iterate of the level at hand, where there is one, and says what there is. False: nothing.
    bool leave(const LoadStepping<dim> &stepping, Console &console);

  private:
    void write(const Solution<dim> &solution);

    const std::string directory;
    const Case       &request;
    const Processes   processes;
    const bool        may_be_resumed; ///< the folder has no restart file of a load history, and the case no refinement by the error
    bool              written = false;
    unsigned          level = 0;
    Stopwatch         watch;
    double            seconds_without = 0, seconds_of_writing = 0;
  };
} // namespace unilateral
