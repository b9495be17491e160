// What is typed: it answers at once what needs no libraries (help, schema, init, completion, explain, mistakes on the command line) and
// else becomes the program that computes, unilateral-core, whose 250 libraries take half a second to load.
#include "cli/help_commands.h"
#include "cli/options.h"

#include "unilateral/base/diagnostics.h"

#include <fmt/format.h>

#include <cstdio>
#include <exception>
#include <filesystem>
#include <string>
#include <variant>

#include <unistd.h>

namespace
{
  using namespace unilateral;

  /// Beside this program, or where an installation puts it.
  int become_core(char **const argv)
  {
    std::error_code             failure;
    const std::filesystem::path here = std::filesystem::read_symlink("/proc/self/exe", failure).parent_path();
    for (const std::filesystem::path &folder : {here, here / "../libexec/unilateral"})
    {
      const std::string core = (folder / "unilateral-core").lexically_normal().string();
      if (access(core.c_str(), X_OK) == 0)
        execv(core.c_str(), argv);
    }
    fmt::print(stderr, "unilateral: error: the program is incomplete, unilateral-core is not beside it in '{}'; build or install it anew\n",
               here.string());
    return exit_internal_error;
  }

  int print(const std::string &text)
  {
    return std::fwrite(text.data(), 1, text.size(), stdout) == text.size() && std::fflush(stdout) == 0 ? exit_solved : exit_internal_error;
  }
} // namespace

int main(int argc, char **argv) // NOLINT(bugprone-exception-escape)
{
  const std::variant<Options, int> command_line = parse_command_line(argc, argv);
  if (const int *const exit_code = std::get_if<int>(&command_line))
    return *exit_code;
  const Options &options = std::get<Options>(command_line);
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
