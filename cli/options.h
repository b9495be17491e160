// The command line: what was asked, or why it cannot be understood.
#pragma once

#include "unilateral/case/toml_document.h"

#include <optional>
#include <string>
#include <variant>
#include <vector>

namespace unilateral
{
  /// How a process ends; the numbers are part of the program's contract.
  enum ExitCode
  {
    exit_solved = 0,
    exit_internal_error = 1,
    exit_bad_input = 2,
    exit_not_converged = 3,
    exit_expectation_failed = 4,
    exit_interrupted = 130
  };

  enum class Command
  {
    run,
    check,
    expand,
    infsup,
    study_epsilon,
    study_mesh,
    study_quadrature,
    sweep,
    report,
    picture,
    schema,
    init,
    completion,
    explain,
    manual
  };

  struct Options
  {
    Command                  command = Command::run;
    std::string              case_path;
    std::string              directory;        ///< of the results; empty: <case name>.out
    std::vector<Override>    overrides;        ///< --set KEY=VALUE
    unsigned                 n_levels = 0;     ///< of infsup and study mesh; 0: their own default
    std::string              zone;             ///< of infsup: an expression, "" for none
    std::vector<double>      epsilons;         ///< of study epsilon; empty: its own default
    std::optional<double>    epsilon;          ///< of study mesh
    bool                     adaptive = false; ///< of study mesh
    std::optional<double>    power;            ///< of study mesh: epsilon ~ h^power
    std::vector<std::string> rules;            ///< of study quadrature; empty: all that fit
    std::vector<std::string> folders;          ///< of report and picture
    std::string              output_file;      ///< of report with several folders, of picture; empty: their own default
    std::string              field;            ///< of picture; empty: its own default
    std::vector<std::string> over;             ///< of sweep: KEY=FROM:TO:N or KEY=A,B,C
    std::vector<std::string> quantities;       ///< of sweep: paths into results.json; empty: its own default
    unsigned                 n_jobs = 0;       ///< of sweep: runs at a time; 0: as many as there are processors
    bool                     resume = false;   ///< of run: goes on where a run was left
    unsigned                 n_processes = 0;  ///< of run and study mesh, as mpirun would start them; 0: this one
    bool                     json = false, quiet = false, verbose = false, no_color = false;
    std::string              log_file;              ///< empty: none
    std::vector<std::string> words;                 ///< what follows a command that takes no case: a kind, a shell, a name
    std::string              mesh_file;             ///< of init
    bool                     latex = false;         ///< of infsup, studies and sweep: a table for LaTeX, too
    bool                     allow_scripts = false; ///< of Gmsh, even where the system cannot confine them
  };

  /// The options, or the exit code when there is nothing left to do: --help and --version have printed their text on standard output
  /// (0), a usage error its message on standard error (2).
  std::variant<Options, int> parse_command_line(int argc, char **argv);
} // namespace unilateral
