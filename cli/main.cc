// The program: commands, exit codes, and the one switch over the dimension.
#include "cli/case_with_mesh.h"
#include "cli/console.h"
#include "cli/expand.h"
#include "cli/failure.h"
#include "cli/finished_meshes.h"
#include "cli/help_commands.h"
#include "cli/interrupt.h"
#include "cli/options.h"
#include "cli/run_files.h"
#include "cli/run_history.h"
#include "cli/summary.h"
#include "cli/sweep.h"
#include "cli/unfinished_levels.h"

#include "unilateral/base/file_access.h"
#include "unilateral/base/mpi_session.h"
#include "unilateral/base/mpirun.h"
#include "unilateral/base/processes.h"
#include "unilateral/case/case_results.h"
#include "unilateral/case/expectations.h"
#include "unilateral/case/level_restart.h"
#include "unilateral/case/mesh_restart.h"
#include "unilateral/case/problem_of_case.h"
#include "unilateral/case/read_case.h"
#include "unilateral/case/solve_history.h"
#include "unilateral/case/write_case.h"
#include "unilateral/functions/compile_field.h"
#include "unilateral/output/latex_table.h"
#include "unilateral/output/result_files.h"
#include "unilateral/output/results.h"
#include "unilateral/output/solution_files.h"
#include "unilateral/output/step_files.h"
#include "unilateral/report/picture.h"
#include "unilateral/report/report.h"
#include "unilateral/report/scene.h"
#include "unilateral/solve.h"
#include "unilateral/studies/epsilon_study.h"
#include "unilateral/studies/inf_sup_study.h"
#include "unilateral/studies/mesh_study.h"
#include "unilateral/studies/preview.h"
#include "unilateral/studies/quadrature_study.h"

#include <deal.II/base/exceptions.h>
#include <deal.II/base/timer.h>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <cstdio>
#include <cstring>
#include <exception>
#include <filesystem>
#include <memory>
#include <optional>
#include <sstream>
#include <stdexcept>
#include <type_traits>

#include <unistd.h>

namespace
{
  using namespace unilateral;
  using Json = nlohmann::ordered_json;

  /// Calls @p action with the dimension as a type.
  template <typename Action>
  int with_dimension(const unsigned dimension, const Action &action)
  {
    switch (dimension)
    {
    case 1:
      return action(std::integral_constant<int, 1>());
    case 2:
      return action(std::integral_constant<int, 2>());
    case 3:
      return action(std::integral_constant<int, 3>());
    default:
      throw std::logic_error(fmt::format("a mesh of dimension {}", dimension));
    }
  }

  template <int dim>
  int run(const Options &options, const Case &request, Diagnostics &diagnostics, Console &console)
  {
    if (!request.steps.empty())
      return run_history<dim>(options, request, console);
    const Processes   processes = Processes::all();
    const bool        first = processes.rank() == 0;
    const std::string directory = options.directory.empty() ? request.name + ".out" : options.directory;
    check_writable(directory);
    console.record(fmt::format("case {}\n\n{}", request.path, expand(request)));

    console.expect_levels(request.mesh.adapt ? 0 : request.mesh.n_refinements() + 1, dim);

    ProblemStatement statement = problem_of(request);
    if (options.resume && request.mesh.adapt)
    {
      statement.mesh.adapt->former = read_mesh_restart(directory, request);
      console.print(
        fmt::format("resumed with the mesh of {} cells that the run before had come to", statement.mesh.adapt->former->centres.size()));
    }

    std::optional<ResultFiles> files;
    FinishedMeshes<dim>        finished(directory, request, processes, files);
    UnfinishedLevels<dim>      unfinished(directory, request, processes);
    auto                       stepping = std::make_unique<LoadStepping<dim>>(
      console, processes, [&](const Solution<dim> &on_mesh) { finished.add(on_mesh); },
      [&](const Solution<dim> &on_level) { unfinished.add(on_level); });
    if (options.resume && !request.mesh.adapt)
    {
      FormerLevel former = read_level_restart(directory, request);
      console.print(fmt::format("resumed on level {}, with what the run before had come to", former.level));
      stepping->go_on_with(std::move(former));
    }
    try
    {
      stepping->solve(statement, diagnostics);
    }
    catch (const Interrupted &)
    {
      if (!finished.leave(console) && !unfinished.leave(*stepping, console))
        throw;
      return exit_interrupted;
    }
    Solution<dim> solution = std::move(stepping->solution());
    stepping.reset(); // matrices, which take memory
    RunResult &result = solution.result;
    console.show(diagnostics.all());

    console.phase("output", directory);
    const dealii::Timer timer;
    write_files(
      [&]
      {
        if (!files)
          files.emplace(directory, processes);
        if (first)
          write_file_atomically(files->path_of("case.toml"), expand(request));
        const auto running = solution.problem->time_by_part.run("files");
        if (request.files.vtu && (first || solution.problem->space.subdomain))
          write_solution(solution, files->folder());
        if (request.files.vtu && first && finished.n() > 0)
          write_cycles_pvd(finished.n(), /*last=*/true, files->folder());
        if (request.files.csv && (first || solution.problem->space.subdomain))
          write_constraint_points_csv(solution, files->folder());
      });
    result.timing.output = timer.wall_time();
    result.timing.parts = solution.problem->time_by_part.seconds();
    result.timing.total += result.timing.output;

    const double own_memory = peak_bytes();
    result.memory_of_others = processes.sum(own_memory) - own_memory;
    const bool as_expected = evaluate_expectations(result, request);
    const Json json = to_json(result, request);
    if (first)
      write_files([&] { write_file_atomically(files->path_of("results.json"), to_text(json)); });

    console.print(summary(result));
    console.show(failed_expectations(result));
    console.conclude(last_line(result, directory), result.converged && as_expected && result.meets_what_is_asked());
    write_files(
      [&]
      {
        processes.sum(0.); // all pieces are there
        if (first)
        {
          write_file_atomically(files->path_of("run.log"), console.log_text());
          remove_old_steps(directory);
          remove_restart(directory);
          if (request.files.report)
          {
            // It is made from the files, and the solution takes most of the memory.
            solution.flux.reset();
            solution.constraint_set = {};
            solution.problem.reset();
            write_report(files->folder(), directory);
          }
        }
        finish_whatever_is_asked();
        files->publish("case.toml", [](const std::string &name) { return is_solution_file(name) || name == "report.html"; });
      });
    if (options.json && first)
      print_results(to_text(json));
    return !result.converged                                      ? exit_not_converged
           : as_expected && solution.result.meets_what_is_asked() ? exit_solved
                                                                  : exit_expectation_failed;
  }

  template <int dim>
  int check(const Options &options, const Case &request, Diagnostics &diagnostics, Console &console)
  {
    const bool to_file = !options.directory.empty();
    if (to_file)
      check_writable(options.directory);
    const CheckReport report = unilateral::check<dim>(problem_of(request), diagnostics, console, to_file);
    if (request.steps.size() > 1)
      check_history<dim>(request, diagnostics);
    console.show(diagnostics.all());
    if (to_file)
      write_files(
        [&]
        {
          ResultFiles files(options.directory);
          write_file_atomically(files.path_of("parts.vtu"), to_vtu(report.boundary));
          files.publish("parts.vtu");
        });
    if (options.json)
      print_results(to_text(to_json(report, request, dim)));
    else if (!console.print(summary(report, dim)))
      throw OutputError("cannot write to standard output: the report is incomplete");
    const std::string steps = request.steps.empty() ? "" : fmt::format(", its {} steps, too", request.steps.size());
    console.conclude(fmt::format("checked: the case is in order{}; nothing was solved{}", steps,
                                 to_file ? fmt::format("; parts.vtu in {}", options.directory) : ""),
                     true);
    return exit_solved;
  }

  std::string results_directory(const Options &options, const Case &request)
  {
    const std::string directory = options.directory.empty() ? request.name + ".out" : options.directory;
    check_writable(directory);
    return directory;
  }

  /// "a, b and c"
  std::string list_of(const std::vector<std::string> &names)
  {
    return names.size() < 2 ? fmt::format("{}", fmt::join(names, ""))
                            : fmt::format("{} and {}", fmt::join(names.begin(), names.end() - 1, ", "), names.back());
  }

  /// NAME.json, NAME.csv, for --latex NAME.tex, and @p more files (name, content), then the table for people or the JSON.
  template <typename Study>
  int publish(const Options                                          &options,
              const Case                                             &request,
              const Study                                            &study,
              const std::string                                      &directory,
              const std::string                                      &name,
              const std::string                                      &conclusion,
              Console                                                &console,
              const std::vector<std::pair<std::string, std::string>> &more = {},
              const bool                                              converged = true)
  {
    if (Processes::all().rank() > 0) // which have the same numbers
      return converged ? exit_solved : exit_not_converged;
    const std::string                                json = to_text(to_json(study, request)), csv = to_csv(study);
    std::vector<std::pair<std::string, std::string>> contents = {{name + ".json", json}, {name + ".csv", csv}};
    if (options.latex)
      contents.emplace_back(name + ".tex", latex_table(csv));
    contents.insert(contents.end(), more.begin(), more.end());
    std::vector<std::string> names;
    write_files(
      [&]
      {
        ResultFiles files(directory);
        for (const char *const left : {"study_mesh_adaptive.csv", "study_mesh_adaptive.tex"}) // of an earlier study of this kind
          if (std::error_code ignored; name == "study_mesh")
            std::filesystem::remove(std::filesystem::path(directory) / left, ignored);
        for (const auto &[file, content] : contents)
        {
          write_file_atomically(files.path_of(file), content);
          names.push_back(file);
        }
        finish_whatever_is_asked();
        files.publish(name + ".json");
        write_report(directory);
        names.push_back("report.html");
      });
    const std::string where = fmt::format("results in {}: {}", directory, list_of(names));
    if (options.json)
      print_results(json);
    else
      console.print(summary(study));
    if (!converged)
    {
      console.conclude(fmt::format("not converged: some rows, marked with '!', are not solutions; {}", where), false);
      return exit_not_converged;
    }
    console.conclude(fmt::format("{}; {}", conclusion, where), true);
    return exit_solved;
  }

  template <typename Study>
  bool all_converged(const Study &study)
  {
    return std::all_of(study.rows.begin(), study.rows.end(), [](const auto &row) { return row.converged; });
  }

  /// infsup has meshes of its own.
  void warn_about_mesh_settings(const Options &options, const unsigned n_levels, Diagnostics &diagnostics)
  {
    for (const auto &[key, value] : options.overrides)
      if (key == "mesh.refine" || key.starts_with("mesh.adapt") || key.starts_with("mesh.local"))
        diagnostics.warning(
          {"--set " + key, 0, 0},
          fmt::format("'{}' changes nothing here: infsup has meshes of its own, the coarse one refined 0 to {} times as a whole; "
                      "--levels N says how many",
                      key, n_levels - 1),
          MessageName("does-nothing"));
  }

  template <int dim>
  int infsup(const Options &options, const Case &request, Diagnostics &diagnostics, Console &console)
  {
    const std::string  directory = results_directory(options, request);
    InfSupStudyOptions wanted{.zone_name = options.zone, .limits = limits_for(dim)};
    if (!options.zone.empty())
    {
      FieldSpec zone = FieldSpec::expression(options.zone);
      zone.where = {"--zone", 0, 0};
      wanted.zone = compile_field(zone, request.parameters, dim);
    }
    if (options.n_levels > 0)
      wanted.n_levels = options.n_levels;
    warn_about_mesh_settings(options, wanted.n_levels, diagnostics);
    const InfSupStudy study = study_inf_sup<dim>(problem_of(request), wanted, diagnostics, console);
    console.show(diagnostics.all());
    return publish(options, request, study, directory, "infsup",
                   study.verdict ? "verdict: " + to_string(study.verdict->stability)
                                 : "no verdict: it takes two levels with three points or more",
                   console, {{"infsup-mode.vtu", to_vtu(study.lowest_mode)}});
  }

  template <int dim>
  int study(const Options &options, const Case &request, Diagnostics &diagnostics, Console &console)
  {
    const std::string directory = results_directory(options, request);
    if (options.command == Command::study_epsilon)
    {
      const EpsilonStudy result = study_epsilon<dim>(problem_of(request), {options.epsilons}, diagnostics, console, Processes::all());
      console.show(diagnostics.all());
      return publish(options, request, result, directory, "study_epsilon", conclusion(result), console, {}, all_converged(result));
    }
    if (options.command == Command::study_mesh)
    {
      const MeshStudy result = study_mesh<dim>(problem_of(request), {options.n_levels, options.epsilon, options.power, options.adaptive},
                                               diagnostics, console, Processes::all());
      console.show(diagnostics.all());
      std::vector<std::pair<std::string, std::string>> more;
      if (result.adaptive)
      {
        more.emplace_back("study_mesh_adaptive.csv", to_csv(*result.adaptive));
        if (options.latex)
          more.emplace_back("study_mesh_adaptive.tex", latex_table(more[0].second));
      }
      const std::size_t n_meshes = result.rows.size() + (result.adaptive ? result.adaptive->rows.size() : 0);
      return publish(options, request, result, directory, "study_mesh",
                     fmt::format("studied {} mesh{}", n_meshes, n_meshes == 1 ? "" : "es"), console, more,
                     all_converged(result) && (!result.adaptive || result.adaptive->converged));
    }
    const QuadratureStudy result = study_quadrature<dim>(problem_of(request), options.rules, diagnostics, console, Processes::all());
    console.show(diagnostics.all());
    return publish(
      options, request, result, directory, "study_quadrature", conclusion(result), console, {},
      std::all_of(result.rows.begin(), result.rows.end(), [](const auto &row) { return row.converged || !row.refused.empty(); }));
  }

  int report(const Options &options, Console &console)
  {
    std::string file = options.output_file;
    if (options.folders.size() == 1 && file.empty())
    {
      check_writable_file(std::filesystem::path(options.folders[0]) / "report.html");
      write_files([&] { write_report(options.folders[0]); });
      file = options.folders[0] + "/report.html";
    }
    else
    {
      std::vector<ResultsFolder> folders;
      for (const std::string &folder : options.folders)
        folders.push_back(read_results(folder));
      file = file.empty() ? "report.html" : file;
      check_writable_file(file);
      write_files([&] { write_file_atomically(file, report_html(folders)); });
    }
    console.conclude(fmt::format("written: {}", file), true);
    return exit_solved;
  }

  int picture(const Options &options, Console &console)
  {
    const std::string &directory = options.folders[0],
                      file = options.output_file.empty() ? directory + "/picture.svg" : options.output_file;
    if (!file.ends_with(".svg") && !file.ends_with(".png"))
      throw InputError({file, 0, 0}, "pictures are .svg or .png files; choose such a name with -o", MessageName("bad-option"));
    check_writable_file(file);
    const ResultsFolder folder = read_results(directory);
    const std::string   svg = picture_svg(make_scene(folder, {.triangles = 400000}), folder.title(), {.field = options.field});
    if (svg.empty())
      throw InputError({directory, 0, 0}, "there is nothing to draw: the folder has no solution.vtu; run the case with output.vtu = true",
                       MessageName("file-not-found"));
    write_files([&] { write_file_atomically(file, file.ends_with(".png") ? png_of_svg(svg) : svg); });
    console.conclude(fmt::format("written: {}", file), true);
    return exit_solved;
  }

  /// What @p read returns on the first process, on all of them. It may be interrupted.
  std::string by_first_process(const std::function<std::string()> &read)
  {
    const Processes   processes = Processes::all();
    bool              interrupted = false;
    std::vector<char> answer;
    if (processes.rank() == 0)
      try
      {
        const std::string text = read();
        answer.assign(text.begin(), text.end());
      }
      catch (const Interrupted &)
      {
        interrupted = true;
      }
    if (processes.any(interrupted))
      throw Interrupted();
    answer = processes.gather(answer);
    return {answer.begin(), answer.end()};
  }

  /// All processes read the case, of a mesh file the first one alone: its names, and with them the cells of a .msh.
  Case read_case_once(const Options &options, Diagnostics &diagnostics)
  {
    FileAccess before = file_access(), access = before;
    access.read_ahead = options.command != Command::expand;
    if (started_by_mpirun() && !Processes::all().alone())
      access.by_first_process = by_first_process;
    set_file_access(std::move(access));
    Case request = read_case(options.case_path, options.overrides, diagnostics, {.expressions = {options.zone}});
    set_file_access(std::move(before));
    return request;
  }

  int execute(const Options &options, Diagnostics &diagnostics, Console &console)
  {
    if (options.command == Command::report)
      return report(options, console);
    if (options.command == Command::picture)
      return picture(options, console);
    if (options.command == Command::sweep)
      return sweep(options, console);
    if (is_help_command(options.command))
    {
      print_results(run_help_command(options, case_with_mesh));
      return exit_solved;
    }
    const Case request = read_case_once(options, diagnostics);
    console.show(diagnostics.all());
    if (options.command == Command::expand)
      return expand(options, request);
    return with_dimension(request.dimension,
                          [&](const auto dimension)
                          {
                            constexpr int dim = dimension;
                            switch (options.command)
                            {
                            case Command::run:
                              return run<dim>(options, request, diagnostics, console);
                            case Command::check:
                              return check<dim>(options, request, diagnostics, console);
                            case Command::infsup:
                              return infsup<dim>(options, request, diagnostics, console);
                            default:
                              return study<dim>(options, request, diagnostics, console);
                            }
                          });
  }

  /// The first line of what deal.II has to say, without its frame of dashes and its stack.
  std::string plain_text(const dealii::ExceptionBase &e)
  {
    std::ostringstream info;
    e.print_info(info);
    std::string text = info.str();
    text.erase(0, text.find_first_not_of(" \n"));
    text = text.substr(0, text.find('\n'));
    return text.empty() ? e.get_exc_name() : text;
  }

  /// When one of several processes fails and the others do not, they would wait for it for ever: it says why, and ends them all. What all
  /// of them meet is said by the first alone.
  int fail(const Failure &failure, Console &console)
  {
    const Processes processes = Processes::all();
    if (processes.rank() == 0)
      failure.show(console);
    if (processes.alone() || processes.all_arrive(std::chrono::seconds(2)))
      return failure.exit_code;
    if (processes.rank() > 0)
    {
      console.speak();
      failure.show(console);
    }
    MPI_Abort(processes.communicator(), failure.exit_code);
    return failure.exit_code;
  }

  Failure no_reference(const NoReference &e, const Diagnostics &diagnostics)
  {
    return {exit_not_converged, [before = diagnostics.all(), reason = std::string(e.what())](Console &console)
            {
              console.show(before);
              console.conclude(
                fmt::format("not converged: {}; a coarser mesh that is refined (mesh.refine) starts closer [not-converged]", reason),
                false);
            }};
  }

  /// Every way a command can end, as an exit code.
  int guarded(const Options &options, Console &console)
  {
    Diagnostics diagnostics;
    try
    {
      return execute(options, diagnostics, console);
    }
    catch (const NoReference &e)
    {
      return fail(no_reference(e, diagnostics), console);
    }
    catch (const dealii::ExceptionBase &e)
    {
      const bool memory = is_shortage_of_memory(e) || dynamic_cast<const dealii::StandardExceptions::ExcOutOfMemory *>(&e);
      return fail(memory ? out_of_memory() : internal_error(plain_text(e), e.what()), console);
    }
    catch (...)
    {
      return fail(failure_of(std::current_exception(), diagnostics), console);
    }
  }
} // namespace

// What gets out of it, want of memory, ends like every other crash.
int main(int argc, char **argv) // NOLINT(bugprone-exception-escape)
{
  reserve_standard_streams();
  const std::variant<Options, int> command_line = parse_command_line(argc, argv);
  if (const int *const exit_code = std::get_if<int>(&command_line))
    return *exit_code;
  const Options &options = std::get<Options>(command_line);

  install_signal_handlers(); // an interrupt that comes while MPI starts is one, too
  // Starting MPI takes as long as these commands do.
  const bool alone = !started_by_mpirun() &&
                     (options.command == Command::expand || options.command == Command::report || options.command == Command::picture);
  std::optional<MpiSession> mpi;
  if (!alone)
    mpi.emplace();
  const bool several = mpi && mpi->n_ranks() > 1, mute = mpi && mpi->rank() > 0;
  dealii::deal_II_exceptions::disable_abort_on_exception();
  install_signal_handlers(); // again: MPI brings handlers of its own for crashes
  if (!several)
    end_soon_after_signals();
  set_file_access({options.allow_scripts, interrupt_requested});
  const bool shared = options.command == Command::run || options.command == Command::study_mesh ||
                      options.command == Command::study_epsilon || options.command == Command::study_quadrature;
  if (mute && !shared)
    return exit_solved;
  std::optional<Console> console;
  try
  {
    console.emplace(Console::Settings{options.json, options.quiet, options.verbose, options.no_color, mute ? "" : options.log_file, mute});
  }
  catch (const InputError &e)
  {
    fmt::print(stderr, "{}\n", e.what());
    if (several)
      MPI_Abort(MPI_COMM_WORLD, exit_bad_input);
    return exit_bad_input;
  }
  console->record(fmt::format("unilateral {}, deal.II {}", UNILATERAL_VERSION, DEAL_II_PACKAGE_VERSION));
  if (several)
    console->record(fmt::format("{} processes", mpi->n_ranks()));
  if (several && !shared)
    fmt::print(stderr, "unilateral: this command is work for one process: of {} the first does it\n", mpi->n_ranks());
  return guarded(options, *console);
}
