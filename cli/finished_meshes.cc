#include "cli/finished_meshes.h"

#include "cli/interrupt.h"
#include "cli/run_files.h"

#include "unilateral/case/mesh_restart.h"
#include "unilateral/case/write_case.h"
#include "unilateral/output/solution_files.h"
#include "unilateral/spaces/cells_of_former_mesh.h"

#include <fmt/format.h>

#include <chrono>
#include <filesystem>

namespace unilateral
{
  template <int dim>
  FinishedMeshes<dim>::FinishedMeshes(const std::string          &directory,
                                      const Case                 &request,
                                      const Processes            &processes,
                                      std::optional<ResultFiles> &files)
    : directory(directory), request(request), processes(processes), files(files),
      may_be_resumed(!processes.any(processes.rank() == 0 && has_restart_of_steps(directory)))
  {
  }

  template <int dim>
  void FinishedMeshes<dim>::add(const Solution<dim> &solution)
  {
    const auto &space = solution.problem->space;
    const bool  has_part = processes.rank() == 0 || space.subdomain;
    write_files(
      [&]
      {
        if (!files)
          files.emplace(directory, processes);
        if (request.files.vtu && has_part)
          write_solution(solution, files->folder(), n_meshes);
        if (may_be_resumed && has_part)
          write_mesh_restart(directory, request, n_meshes + 1, record_of(space), space.processes());
      });
    ++n_meshes;
  }

  template <int dim>
  bool FinishedMeshes<dim>::publish(Console &console)
  {
    const bool first = processes.rank() == 0;
    // Processes that each solve the whole may have come to different places.
    if (!request.files.vtu || (!processes.alone() && !processes.all_arrive(std::chrono::seconds(2))))
      return false;
    if (processes.any(!may_be_resumed || (first && std::filesystem::exists(std::filesystem::path(directory) / "results.json"))))
      return false;
    write_files(
      [&]
      {
        processes.sum(0.); // all pieces are there
        if (first)
        {
          write_file_atomically(files->path_of("case.toml"), expand(request));
          write_cycles_pvd(n_meshes, /*last=*/false, files->folder());
          write_file_atomically(files->path_of("run.log"), console.log_text());
        }
        files->publish("case.toml", is_solution_file);
      });
    return true;
  }

  template <int dim>
  bool FinishedMeshes<dim>::leave(Console &console)
  {
    finish_whatever_is_asked();
    if (n_meshes == 0)
      return false;
    const bool  published = publish(console);
    std::string left;
    if (published)
      left = fmt::format("the solution{} on the {} before it {} in {} (solution.pvd)", n_meshes > 1 ? "s" : "",
                         n_meshes > 1 ? fmt::format("{}", n_meshes) : "one", n_meshes > 1 ? "are" : "is", directory);
    if (may_be_resumed)
      left += fmt::format("{}--resume goes on with mesh {}{}", published ? "; " : "", n_meshes, published ? "" : " in " + directory);
    if (left.empty())
      return false;
    console.conclude(fmt::format("interrupted on mesh {}: {}", n_meshes + 1, left), false);
    return true;
  }

  template class FinishedMeshes<1>;
  template class FinishedMeshes<2>;
  template class FinishedMeshes<3>;
} // namespace unilateral
