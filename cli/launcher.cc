// What is typed: it answers at once what needs no libraries (help, schema, init, completion, explain, expand, mistakes on the command line)
// and else becomes the program that computes, unilateral-core, whose 200 libraries take some tenths of a second to load.
#include "cli/console.h"
#include "cli/expand.h"
#include "cli/failure.h"
#include "cli/file_readers.h"
#include "cli/help_commands.h"
#include "cli/interrupt.h"
#include "cli/options.h"
#include "cli/several_processes.h"

#include "unilateral/base/diagnostics.h"
#include "unilateral/base/file_access.h"
#include "unilateral/base/mpirun.h"
#include "unilateral/case/read_case.h"

#include <fmt/format.h>

#include <cstdio>
#include <cstdlib>
#include <exception>
#include <filesystem>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include <unistd.h>

namespace
{
  using namespace unilateral;

  /// Vectors of a hundred megabytes come and go: with pages of 2 MB, where the kernel has them on request, and the C library of GNU, large
  /// runs take two thirds of the time. What the user says in GLIBC_TUNABLES comes last, and counts.
  void ask_for_large_pages()
  {
    std::string       tunables = "glibc.malloc.hugetlb=1:glibc.malloc.mmap_threshold=33554432:"
                                 "glibc.malloc.trim_threshold=4294967296:glibc.malloc.top_pad=67108864";
    const char *const of_user = std::getenv("GLIBC_TUNABLES");
    if (of_user != nullptr && *of_user != 0)
      tunables += std::string(":") + of_user;
    setenv("GLIBC_TUNABLES", tunables.c_str(), 1);
  }

  int become_core(char **const argv)
  {
    ask_for_large_pages();
    const std::vector<std::filesystem::path> folders = folders_of_program();
    for (const std::filesystem::path &folder : folders)
    {
      const std::string core = (folder / "unilateral-core").string();
      if (access(core.c_str(), X_OK) == 0)
        execv(core.c_str(), argv);
    }
    fmt::print(stderr, "unilateral: error: the program is incomplete, unilateral-core is not beside it in '{}'; build or install it anew\n",
               folders.front().string());
    return exit_internal_error;
  }

  /// Nothing is shown or logged before it is known that the case can be read here: the other program would do so again.
  int expand_or_become_core(const Options &options, char **const argv)
  {
    install_signal_handlers();
    end_soon_after_signals();
    set_file_access({options.allow_scripts, interrupt_requested});
    Diagnostics         diagnostics;
    std::optional<Case> request;
    std::exception_ptr  mistakes;
    try
    {
      request = read_case(options.case_path, options.overrides, diagnostics);
    }
    catch (const FileReaderIsAbsent &)
    {
      return become_core(argv);
    }
    catch (...)
    {
      mistakes = std::current_exception();
    }

    std::optional<Console> console;
    try
    {
      console.emplace(Console::Settings{options.json, options.quiet, options.verbose, options.no_color, options.log_file});
    }
    catch (const InputError &e)
    {
      fmt::print(stderr, "{}\n", e.what());
      return exit_bad_input;
    }
    console->record(fmt::format("unilateral {}, deal.II {}", UNILATERAL_VERSION, UNILATERAL_DEALII_VERSION));
    try
    {
      if (mistakes)
        std::rethrow_exception(mistakes);
      console->show(diagnostics.all());
      return expand(options, *request);
    }
    catch (...)
    {
      const Failure failure = failure_of(std::current_exception(), diagnostics);
      failure.show(*console);
      return failure.exit_code;
    }
  }

  int print(const std::string &text)
  {
    return std::fwrite(text.data(), 1, text.size(), stdout) == text.size() && std::fflush(stdout) == 0 ? exit_solved : exit_internal_error;
  }
} // namespace

int main(int argc, char **argv) // NOLINT(bugprone-exception-escape)
{
  reserve_standard_streams();
  const std::variant<Options, int> command_line = parse_command_line(argc, argv);
  if (const int *const exit_code = std::get_if<int>(&command_line))
    return *exit_code;
  const Options &options = std::get<Options>(command_line);
  if (options.command == Command::expand && !started_by_mpirun())
    return expand_or_become_core(options, argv);
  if (options.n_processes > 1 && !started_by_mpirun())
    return run_as_processes(options.n_processes, argv);
  if (options.n_processes > 0 && other_number_of_processes(options.n_processes))
    return exit_bad_input;
  if (!is_help_command(options.command) || !options.mesh_file.empty())
    return become_core(argv);
  try
  {
    return print(run_help_command(options, nullptr));
  }
  catch (const InputError &e)
  {
    for (const Diagnostic &message : e.diagnostics)
      fmt::print(stderr, "{}\n", message.where.file.empty() ? "unilateral: error: " + message.message : to_string(message));
    return exit_bad_input;
  }
  catch (const std::exception &e)
  {
    fmt::print(stderr, "unilateral: error: internal error ({})\n", e.what());
    return exit_internal_error;
  }
}
