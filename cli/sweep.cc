#include "cli/sweep.h"

#include "cli/sweep_table.h"

#include "unilateral/base/visible_text.h"
#include "unilateral/case/expectations.h"
#include "unilateral/case/read_case.h"
#include "unilateral/output/latex_table.h"
#include "unilateral/output/result_files.h"
#include "unilateral/output/results.h"
#include "unilateral/report/report.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <map>
#include <sstream>
#include <thread>

#include <fcntl.h>
#include <sched.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

namespace unilateral
{
  namespace
  {
    namespace fs = std::filesystem;
    using SweepJson = nlohmann::ordered_json;

    unsigned n_processors()
    {
      cpu_set_t own;
      return sched_getaffinity(0, sizeof own, &own) == 0 ? std::max(1, CPU_COUNT(&own)) : std::max(1U, std::thread::hardware_concurrency());
    }

    std::string text_in(const fs::path &path)
    {
      std::ifstream      in(path, std::ios::binary);
      std::ostringstream text;
      if (in)
        text << in.rdbuf();
      return std::move(text).str();
    }

    /// One run after another, several at a time.
    class Runs
    {
    public:
      Runs(const Options &options, const std::vector<SweepAxis> &axes, fs::path folder)
        : options(options), axes(axes), folder(std::move(folder)), program(fs::read_symlink("/proc/self/exe").string())
      {
      }

      /// None goes on alone.
      ~Runs()
      {
        for (const auto &[child, running] : children)
          kill(child, SIGTERM);
        for (const auto &[child, running] : children)
          waitpid(child, nullptr, 0);
      }
      Runs(const Runs &) = delete;
      Runs &operator=(const Runs &) = delete;

      std::size_t n_running() const { return children.size(); }

      void start(SweepStep &step)
      {
        std::vector<std::string> words = {program, "run", options.case_path, "-q", "--no-color", "-o", (folder / step.folder).string()};
        for (const auto &[key, value] : options.overrides)
          words.insert(words.end(), {"--set", fmt::format("{}={}", key, value)});
        for (std::size_t a = 0; a < axes.size(); ++a)
          words.insert(words.end(), {"--set", fmt::format("{}={}", axes[a].key, step.values[a])});
        words.insert(words.end(), {"--set", "output.report=false"});
        if (options.allow_scripts)
          words.emplace_back("--allow-scripts");
        std::vector<char *> arguments;
        for (std::string &word : words)
          arguments.push_back(word.data());
        arguments.push_back(nullptr);
        posix_spawn_file_actions_t files;
        posix_spawn_file_actions_init(&files);
        const std::string messages = messages_of(step);
        posix_spawn_file_actions_addopen(&files, STDIN_FILENO, "/dev/null", O_RDONLY, 0);
        posix_spawn_file_actions_addopen(&files, STDOUT_FILENO, "/dev/null", O_WRONLY, 0);
        posix_spawn_file_actions_addopen(&files, STDERR_FILENO, messages.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_NOFOLLOW, 0666);
        pid_t     child = 0;
        const int failure = posix_spawn(&child, program.c_str(), &files, nullptr, arguments.data(), environ);
        posix_spawn_file_actions_destroy(&files);
        if (failure != 0)
          throw OutputError(fmt::format("a run cannot be started: {}", std::strerror(failure)));
        children[child] = {&step, std::chrono::steady_clock::now()};
      }

      /// One that has ended, or none.
      SweepStep *ended()
      {
        for (const auto &[child, running] : children)
        {
          int status = 0;
          if (waitpid(child, &status, WNOHANG) != child)
            continue;
          SweepStep &step = *running.step;
          step.exit_code = WIFEXITED(status) ? WEXITSTATUS(status) : exit_internal_error;
          step.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - running.start).count();
          const std::string text = text_in(messages_of(step));
          fs::remove(messages_of(step));
          step.results = SweepJson::parse(text_in(folder / step.folder / "results.json"), nullptr, false);
          if (step.exit_code != exit_solved)
          {
            std::string line = text.substr(0, text.find('\n'));
            if (const std::size_t error = text.find("error: "); error != std::string::npos)
              line = text.substr(error, text.find('\n', error) - error);
            step.message = visible(line);
          }
          children.erase(child);
          return &step;
        }
        return nullptr;
      }

    private:
      std::string messages_of(const SweepStep &step) const { return (folder / ("." + step.folder + ".messages")).string(); }

      struct Running
      {
        SweepStep                            *step = nullptr;
        std::chrono::steady_clock::time_point start;
      };
      const Options                &options;
      const std::vector<SweepAxis> &axes;
      const fs::path                folder;
      const std::string             program;
      std::map<pid_t, Running>      children;
    };

    /// How bad an exit code is.
    int severity(const int exit_code)
    {
      switch (exit_code)
      {
      case exit_solved:
        return 0;
      case exit_expectation_failed:
        return 1;
      case exit_not_converged:
        return 2;
      case exit_bad_input:
        return 3;
      default:
        return 4;
      }
    }
    void run_all(std::vector<SweepStep>       &steps,
                 const std::vector<SweepAxis> &axes,
                 const Options                &options,
                 const fs::path               &folder,
                 const unsigned                at_once,
                 Console                      &console)
    {
      Runs        runs(options, axes, folder);
      std::size_t next = 0, n_ended = 0;
      while (n_ended < steps.size())
      {
        if (console.stop_requested())
          throw Interrupted();
        while (next < steps.size() && runs.n_running() < at_once)
          runs.start(steps[next++]);
        SweepStep *const step = runs.ended();
        if (!step)
        {
          std::this_thread::sleep_for(std::chrono::milliseconds(5));
          continue;
        }
        ++n_ended;
        std::string values;
        for (std::size_t a = 0; a < axes.size(); ++a)
          values += fmt::format("{}{} = {}", a > 0 ? ", " : "", axes[a].key, step->values[a]);
        // The numbers that a case expects are those of its own values.
        const bool says_more = !step->message.empty() && step->exit_code != exit_expectation_failed;
        console.print(fmt::format("  {:>3}/{}  {}  {}: {}{}{}", n_ended, steps.size(), step->folder, visible(values), status_of(*step),
                                  says_more ? ", " : "", says_more ? step->message : ""));
      }
    }

    /// Messages about the first values, which are read as --set, name --over.
    std::vector<Diagnostic> naming_over(std::vector<Diagnostic> messages, const std::vector<SweepAxis> &axes)
    {
      for (Diagnostic &message : messages)
        for (const SweepAxis &axis : axes)
          if (message.where.file == "--set " + axis.key)
            message.where.file = "--over " + axis.key;
      return messages;
    }

    /// The case with the first value of each key. Throws InputError for what all runs would stumble over.
    Case first_case(const Options &options, const std::vector<SweepAxis> &axes, Console &console)
    {
      std::vector<Override> overrides = options.overrides;
      GivenData             later; // the first case does not have the other values, which may use a parameter, too
      for (const SweepAxis &axis : axes)
      {
        overrides.emplace_back(axis.key, axis.values[0]);
        later.expressions.insert(later.expressions.end(), axis.values.begin(), axis.values.end());
      }
      Diagnostics diagnostics;
      try
      {
        Case first = read_case(options.case_path, overrides, diagnostics, later);
        check_quantities(first, options.quantities, diagnostics);
        diagnostics.throw_if_errors();
        console.show(naming_over(diagnostics.all(), axes));
        return first;
      }
      catch (const InputError &e)
      {
        throw InputError(naming_over(e.diagnostics, axes));
      }
    }

    /// The folders of steps that an earlier, larger sweep has left here go, as its table does: the rows of its sweep.json that the new one
    /// has not.
    void remove_steps_of_earlier_sweep(const fs::path &folder, const SweepJson &earlier, const std::vector<SweepStep> &steps)
    {
      if (!earlier.is_object() || !earlier.contains("rows") || !earlier["rows"].is_array())
        return;
      for (const SweepJson &row : earlier["rows"])
      {
        const std::string name =
          row.is_object() && row.contains("folder") && row["folder"].is_string() ? row["folder"].get<std::string>() : "";
        const bool is_step = name.starts_with("step-") && name.size() > 5 && name.find_first_not_of("0123456789", 5) == std::string::npos;
        if (is_step && std::none_of(steps.begin(), steps.end(), [&](const SweepStep &step) { return step.folder == name; }))
        {
          std::error_code ignored; // what cannot be removed stays
          fs::remove_all(folder / name, ignored);
        }
      }
    }
  } // namespace

  int sweep(const Options &options, Console &console)
  {
    std::vector<SweepAxis> axes;
    for (const std::string &text : options.over)
      axes.push_back(parse_sweep_axis(text));
    std::vector<SweepStep> steps = all_combinations(axes);

    const Case first = first_case(options, axes, console);

    const fs::path folder = options.directory.empty() ? first.name + ".sweep" : options.directory;
    check_writable(folder);
    write_files([&] { fs::create_directories(folder); });
    const unsigned at_once = options.n_jobs > 0 ? options.n_jobs : n_processors();
    console.print(
      fmt::format("{} runs of {}, {} at a time", steps.size(), visible(first.path), std::min<std::size_t>(at_once, steps.size())));
    run_all(steps, axes, options, folder, at_once, console);

    const std::vector<std::string> quantities = options.quantities.empty() ? default_quantities(steps) : options.quantities;
    const std::string              csv = sweep_csv(steps, axes, quantities), text = to_text(sweep_json(first, steps, axes, quantities));
    int                            exit_code = exit_solved;
    for (const SweepStep &step : steps)
      if (severity(step.exit_code) > severity(exit_code))
        exit_code = step.exit_code;
    const SweepJson earlier = SweepJson::parse(text_in(folder / "sweep.json"), nullptr, false);
    write_files(
      [&]
      {
        write_file_atomically((folder / "sweep.csv").string(), csv);
        write_file_atomically((folder / "sweep.json").string(), text);
        if (options.latex)
          write_file_atomically((folder / "sweep.tex").string(), latex_table(csv));
        remove_steps_of_earlier_sweep(folder, earlier, steps);
        write_report(folder.string());
      });
    if (options.json)
    {
      std::fwrite(text.data(), 1, text.size(), stdout);
      std::fflush(stdout);
    }
    for (const std::string &key : keys_without_effect(steps, axes, quantities))
      console.print(fmt::format("'{}' changes none of these quantities: is it used by the case?", visible(key)));
    const auto with = [&](const int code)
    { return std::count_if(steps.begin(), steps.end(), [&](const SweepStep &step) { return step.exit_code == code; }); };
    // The expectations of a case are about its own numbers, which a sweep changes.
    const auto n_as_expected = with(exit_solved), n_otherwise = with(exit_expectation_failed);
    console.conclude(
      fmt::format("{} of {} runs solved{}; results in {}: report.html (table and pictures), sweep.csv{}, sweep.json and the runs",
                  n_as_expected + n_otherwise, steps.size(),
                  n_otherwise > 0 ? fmt::format(", {} of them not as the case expects", n_otherwise) : "", folder.string(),
                  options.latex ? ", sweep.tex" : ""),
      n_as_expected == std::ptrdiff_t(steps.size()));
    return exit_code;
  }
} // namespace unilateral
