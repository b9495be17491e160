#include "cli/unfinished_levels.h"

#include "cli/interrupt.h"
#include "cli/run_files.h"

#include "unilateral/case/level_restart.h"
#include "unilateral/case/mesh_restart.h"
#include "unilateral/guess_of_former_run.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>

namespace unilateral
{
  namespace
  {
    constexpr double seconds_before_first = 10, seconds_per_second_of_writing = 20;
  }

  template <int dim>
  UnfinishedLevels<dim>::UnfinishedLevels(const std::string &directory, const Case &request, const Processes &processes)
    : directory(directory), request(request), processes(processes),
      // The slopes of Hermite elements are not among what is kept.
      may_be_resumed(!request.mesh.adapt && request.model.element.family != ElementName::Family::hermite &&
                     !processes.any(processes.rank() == 0 && has_restart_of_steps(directory)))
  {
  }

  template <int dim>
  void UnfinishedLevels<dim>::add(const Solution<dim> &solution)
  {
    seconds_without += watch.lap();
    const bool due = seconds_without > std::max(seconds_before_first, seconds_per_second_of_writing * seconds_of_writing);
    if (!may_be_resumed || !solution.problem->space.processes().any(due))
      return;
    write(solution);
    seconds_of_writing = watch.lap();
    seconds_without = 0;
  }

  template <int dim>
  void UnfinishedLevels<dim>::write(const Solution<dim> &solution)
  {
    const auto &space = solution.problem->space;
    if (processes.rank() > 0 && !space.subdomain)
      return;
    write_files(
      [&]
      {
        std::filesystem::create_directories(directory);
        write_level_restart(directory, request, {space.level, guess_on_cells(solution)}, space.processes());
      });
    written = true;
    level = space.level;
  }

  template <int dim>
  bool UnfinishedLevels<dim>::leave(const LoadStepping<dim> &stepping, Console &console)
  {
    finish_whatever_is_asked();
    if (may_be_resumed && stepping.has_iterate())
      write(stepping.solution());
    if (!written)
      return false;
    console.conclude(fmt::format("interrupted: --resume goes on with level {}, by what is in {}", level, directory), false);
    return true;
  }

  template class UnfinishedLevels<1>;
  template class UnfinishedLevels<2>;
  template class UnfinishedLevels<3>;
} // namespace unilateral
