#include "cli/run_history.h"

#include "cli/interrupt.h"
#include "cli/run_files.h"
#include "cli/summary.h"

#include "unilateral/base/processes.h"
#include "unilateral/base/stopwatch.h"
#include "unilateral/case/case_results.h"
#include "unilateral/case/expectations.h"
#include "unilateral/case/restart.h"
#include "unilateral/case/solve_history.h"
#include "unilateral/case/write_case.h"
#include "unilateral/output/result_files.h"
#include "unilateral/output/results.h"
#include "unilateral/output/solution_files.h"
#include "unilateral/output/step_files.h"
#include "unilateral/report/report.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <string>
#include <vector>

namespace unilateral
{
  namespace
  {
    using StepsJson = nlohmann::ordered_json;

    /// Shows the levels of the first step; after it each step is a row of another table.
    class HistoryProgress : public Progress
    {
    public:
      explicit HistoryProgress(Console &console) : console(console) {}

      void phase(const std::string &name, const std::string &detail) override
      {
        console.phase(name, detail + (step.empty() || detail.empty() ? "" : ", ") + step);
      }
      void fraction(const double share) override { console.fraction(share); }
      void newton_step(const NewtonStep &newton) override { console.newton_step(newton); }
      void level_finished(const LevelReport &level) override
      {
        if (step.empty())
          console.level_finished(level);
      }
      void log(const std::string &line) override { console.log(line); }
      bool stop_requested() const override { return console.stop_requested(); }

      void next(const std::size_t k, const std::size_t n) { step = fmt::format("step {} of {}", k + 1, n); }

    private:
      Console    &console;
      std::string step; ///< none: the first one
    };

    std::string cell_text(const StepsJson &value)
    {
      return value.is_number()   ? fmt::format("{:.6g}", value.get<double>())
             : value.is_null()   ? "-"
             : value.is_string() ? value.get<std::string>()
                                 : value.dump();
    }

    /// The table of steps, a line at a time.
    class StepTable
    {
    public:
      explicit StepTable(const Case &request) : keys(stepped_keys(request)) { keys.resize(std::min<std::size_t>(keys.size(), 4)); }

      std::string header(const StepsJson &step) const
      {
        std::string text = "  step";
        for (const std::string &key : keys)
          text += fmt::format(" {:>12}", key.substr(0, 12));
        for (std::size_t c = 0; c < step["constraint"].size(); ++c)
          text += fmt::format(" {:>14} {:>9}", "contact force", "active");
        return text + fmt::format(" {:>12} {:>7} {:>9}", "energy", "Newton", "time");
      }

      std::string row(const StepsJson &step) const
      {
        std::string text = fmt::format("{:>6}", step["number"].get<std::size_t>());
        for (const std::string &key : keys)
          text += fmt::format(" {:>12}", cell_text(step["parameters"][key]).substr(0, 12));
        for (const StepsJson &constraint : step["constraint"])
          text += fmt::format(" {:>14} {:>9}", cell_text(constraint["total_contact_force"]), cell_text(constraint["n_active"]));
        text += fmt::format(" {:>12} {:>7} {:>7.2f} s", cell_text(step["solution"]["energy"]),
                            cell_text(step["solver"]["newton_iterations"]), step["timing"]["total"].get<double>());
        return step["status"] == "converged" ? text : text + "  not converged";
      }

    private:
      std::vector<std::string> keys;
    };

    /// The files of a history, step by step.
    template <int dim>
    class HistoryFiles
    {
    public:
      HistoryFiles(std::string directory, const Case &request, const Processes &processes)
        : directory(std::move(directory)), request(request), processes(processes)
      {
      }

      /// After a former run, of which the folders of @p steps_before stay.
      void resume(StepsBefore steps_before)
      {
        before = std::move(steps_before);
        first_step = before.n();
        has_part = processes.rank() == 0; // each process has read the whole solution
        if (processes.rank() == 0)
          keep_steps(before.n(), request.steps.size(), directory);
        processes.sum(0.); // folders have their names
        for (std::size_t k = 0; k < before.n(); ++k)
          if (const std::string folder = folder_of_step(k, request.steps.size());
              std::filesystem::exists(std::filesystem::path(directory) / folder / "results.json"))
          {
            folders.push_back(folder);
            kept.push_back(k);
          }
      }

      /// Whether the fields of a step have a folder.
      bool keeps(const SolvedStep<dim> &step) const
      {
        return step.last || (request.files.every > 0 && (step.k + 1) % request.files.every == 0);
      }

      void write(const SolvedStep<dim> &step, const StepsJson &steps)
      {
        const bool first = processes.rank() == 0;
        Stopwatch  watch;
        if (step.k == first_step && first)
          start();
        if (keeps(step))
        {
          const std::string folder = folder_of_step(step.k, request.steps.size());
          ResultFiles       files(directory + "/" + folder, processes);
          write_fields(step.solution, files.folder());
          if (first)
            write_file_atomically(files.path_of("results.json"), to_text(to_json(step.solution.result, step.request)));
          processes.sum(0.); // all pieces are there
          files.publish("results.json", is_solution_file);
          folders.push_back(folder);
          kept.push_back(step.k);
        }
        before.all_meet = before.all_meet && step.solution.result.meets_what_is_asked();
        if (step.solution.result.converged)
        {
          before.steps.push_back(steps.back());
          before.previous = step.functions;
          has_part = processes.rank() == 0 || step.solution.problem->space.subdomain;
        }
        // Not a table of thousands for every one of thousands. A run that is killed leaves what is half a second old at most.
        if (unwritten += since_table.lap(); unwritten > 0.5)
        {
          write_table(steps);
          unwritten = 0;
        }
        // That takes a solution to be written: at most a twentieth of the time.
        without_restart += since_restart.lap();
        if (!step.last && processes.any(without_restart > 20 * seconds_of_restart))
        {
          leave_restart();
          seconds_of_restart = since_restart.lap();
          without_restart = 0;
        }
        seconds += watch.lap();
      }

      /// Each step so far meets the tolerances that the case asks for.
      bool all_meet() const { return before.all_meet; }

      /// What `--resume` needs. Collective.
      void leave_restart()
      {
        if (before.n() > 0)
          write_restart(directory, request, before, has_part, processes);
      }

      /// After the last step, or one that did not converge.
      void end(const bool complete)
      {
        if (!complete)
          leave_restart();
        else if (processes.rank() == 0)
          remove_restart(directory);
      }

      /// The table of the steps so far.
      void write_table(const StepsJson &steps) const
      {
        if (processes.rank() == 0 && !steps.empty())
          write_file_atomically(directory + "/step_history.csv", steps_to_csv(steps));
      }

      void write_fields(const Solution<dim> &solution, const std::string &folder) const
      {
        if (processes.rank() > 0 && !solution.problem->space.subdomain)
          return;
        if (request.files.vtu)
          write_solution(solution, folder);
        if (request.files.csv)
          write_constraint_points_csv(solution, folder);
      }

      /// solution.pvd and constraint-points.pvd: the steps that have folders.
      void write_collections(const StepsJson &steps, const std::string &folder) const
      {
        if (!request.files.vtu)
          return;
        std::string               key;
        const std::vector<double> all = abscissa_of_steps(steps, key);
        for (const std::string name : {"solution", "constraint-points"})
        {
          std::vector<std::string> names;
          std::vector<double>      times;
          for (std::size_t k = 0; k < folders.size(); ++k)
          {
            const std::string whole = fmt::format("{}/{}.vtu", folders[k], name);
            names.push_back(std::filesystem::exists(fmt::format("{}/{}", directory, whole)) ? whole
                                                                                            : fmt::format("{}/{}.pvtu", folders[k], name));
            times.push_back(all[kept[k]]);
          }
          write_file_atomically(fmt::format("{}/{}.pvd", folder, name), to_pvd(names, times));
        }
      }

      double seconds = 0; ///< that writing took

    private:
      /// What former runs have left, of one that is resumed its end, goes before the first step comes, or files of two runs would lie side
      /// by side.
      void start() const
      {
        namespace fs = std::filesystem;
        fs::create_directories(directory);
        if (first_step == 0)
          remove_old_steps(directory);
        std::error_code       failure;
        std::vector<fs::path> old;
        for (const auto &entry : fs::directory_iterator(directory, failure))
          if (const std::string name = entry.path().filename().string();
              is_solution_file(name) || name == "results.json" || name == "report.html" || name == "case.toml")
            old.push_back(entry.path());
        for (const fs::path &path : old)
          fs::remove(path, failure);
        if (first_step == 0)
          write_file_atomically(directory + "/step_history.csv", std::string("step\n"));
      }

      const std::string        directory;
      const Case              &request;
      const Processes         &processes;
      std::vector<std::string> folders;
      std::vector<std::size_t> kept;
      StepsBefore              before;           ///< the steps so far
      std::size_t              first_step = 0;   ///< of this run
      bool                     has_part = false; ///< of the last solution, this process
      Stopwatch                since_table, since_restart;
      double                   seconds_of_restart = 0, without_restart = 0; ///< that it took the last time; since then
      double                   unwritten = 0;                               ///< seconds since the table was written
    };

    /// Everything at the end: numbers of the whole, fields of the last step, report.
    template <int dim>
    int finish(const Options     &options,
               const Case        &request,
               const std::string &directory,
               const Processes   &processes,
               HistoryFiles<dim> &history,
               Solution<dim>     &solution,
               const StepsJson   &steps,
               Console           &console)
    {
      const bool  all_meet = history.all_meet();
      const bool  first = processes.rank() == 0;
      RunResult  &result = solution.result;
      ResultFiles files(directory, processes);
      write_files(
        [&]
        {
          Stopwatch watch;
          history.write_fields(solution, files.folder());
          history.write_table(steps);
          if (first)
          {
            write_file_atomically(files.path_of("case.toml"), expand(request));
            history.write_collections(steps, files.folder());
          }
          history.seconds += watch.lap();
        });
      result.timing.output += history.seconds;
      result.timing.parts = solution.problem->time_by_part.seconds();
      result.timing.total += history.seconds;
      const double own_memory = peak_bytes();
      result.memory_of_others = processes.sum(own_memory) - own_memory;
      const bool      as_expected = evaluate_expectations(result, request, steps);
      const StepsJson json = to_json(result, request, steps);
      if (first)
        write_files([&] { write_file_atomically(files.path_of("results.json"), to_text(json)); });

      console.print(summary(result));
      console.show(failed_expectations(result));
      const std::string sentence = last_line(result, directory);
      const bool        good = result.converged && as_expected && all_meet;
      console.conclude(
        result.converged && steps.size() == 1 ? sentence
        : !result.converged                   ? fmt::format("step {} of {} {}", steps.size(), request.steps.size(), sentence)
        : all_meet || !result.meets_what_is_asked()
          ? fmt::format("{} (last of {} steps)", sentence, steps.size())
          : fmt::format("solved, but a step before the last misses a tolerance that the case asks for; results in {}", directory),
        good);
      write_files(
        [&]
        {
          processes.sum(0.); // all pieces are there
          if (first)
          {
            write_file_atomically(files.path_of("run.log"), console.log_text());
            if (request.files.report)
              write_report(files.folder(), directory);
          }
          finish_whatever_is_asked();
          files.publish("case.toml", [](const std::string &name) { return is_solution_file(name) || name == "report.html"; });
          history.end(/*complete=*/result.converged);
        });
      if (options.json && first)
        print_results(to_text(json));
      return !result.converged ? exit_not_converged : as_expected && all_meet ? exit_solved : exit_expectation_failed;
    }

    /// What is left where a step has no solution: the numbers and fields of those before it. @p result: of the last of these.
    template <int dim>
    void leave_steps_before(const std::string       &directory,
                            const Case              &request,
                            const Processes         &processes,
                            const HistoryFiles<dim> &history,
                            RunResult                result,
                            const StepsJson         &steps,
                            const InputError        &why,
                            Console                 &console)
    {
      if (processes.rank() > 0)
        return;
      result.converged = false;
      result.reason = why.diagnostics.empty() ? why.what() : why.diagnostics.front().message;
      console.print(fmt::format("step {} of {} has no solution; the numbers of those before it are in {}/results.json", steps.size() + 1,
                                request.steps.size(), directory));
      console.record(why.what());
      ResultFiles files(directory);
      write_file_atomically(files.path_of("case.toml"), expand(request));
      write_file_atomically(files.path_of("results.json"), to_text(to_json(result, request, steps)));
      write_file_atomically(files.path_of("run.log"), console.log_text());
      history.write_collections(steps, files.folder());
      if (request.files.report)
        write_report(files.folder(), directory);
      files.publish("case.toml", [](const std::string &name) { return is_solution_file(name) || name == "report.html"; });
    }

    template <int dim>
    int run_steps(const Options &options, const Case &request, Console &console)
    {
      const Processes   processes = Processes::all();
      const std::string directory = options.directory.empty() ? request.name + ".out" : options.directory;
      check_writable(directory);
      console.record(fmt::format("case {}\n\n{}", request.path, expand(request)));

      HistoryProgress   progress(console);
      HistoryFiles<dim> files(directory, request, processes);
      StepsBefore       before;
      if (options.resume)
      {
        before = read_restart(directory, request);
        files.resume(before);
        console.print(fmt::format("resumed after step {} of {}", before.n(), request.steps.size()));
      }
      LoadStepping<dim> stepping(progress, processes);
      const StepTable   table(request);
      StepsJson         so_far = before.steps;
      RunResult         last;
      try
      {
        const StepsJson steps = solve_history<dim>(
          request, stepping,
          [&](const SolvedStep<dim> &step, const StepsJson &all)
          {
            so_far.push_back(all.back());
            last = step.solution.result;
            console.show(step.diagnostics.all());
            if (step.k == before.n())
              console.print(table.header(so_far.back()));
            console.print(table.row(so_far.back()));
            progress.next(step.k + 1, request.steps.size());
            write_files([&] { files.write(step, so_far); });
          },
          before);
        console.phase("output", directory);
        return finish(options, request, directory, processes, files, stepping.solution(), steps, console);
      }
      catch (const Interrupted &)
      {
        if (so_far.empty())
          throw;
        write_files(
          [&]
          {
            files.write_table(so_far);
            files.leave_restart();
          });
        console.conclude(fmt::format("interrupted in step {} of {}: the steps before it are in {}; --resume goes on with it",
                                     so_far.size() + 1, request.steps.size(), directory),
                         false);
        return exit_interrupted;
      }
      catch (const InputError &why)
      {
        write_files([&] { files.write_table(so_far); });
        if (processes.alone())
          write_files([&] { files.leave_restart(); });
        // A run that is resumed and solves no step leaves the numbers of the one before.
        if (so_far.size() > before.n() && so_far.size() < request.steps.size())
          write_files([&] { leave_steps_before(directory, request, processes, files, last, so_far, why, console); });
        throw;
      }
      catch (...)
      {
        write_files([&] { files.write_table(so_far); });
        throw;
      }
    }
  } // namespace

  template <int dim>
  int run_history(const Options &options, const Case &request, Console &console)
  {
    return run_steps<dim>(options, request, console);
  }

  template int run_history<1>(const Options &, const Case &, Console &);
  template int run_history<2>(const Options &, const Case &, Console &);
  template int run_history<3>(const Options &, const Case &, Console &);
} // namespace unilateral
