#include "cli/options.h"

#include <deal.II/base/config.h>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include <cstdio>

namespace unilateral
{
  namespace
  {
    struct Announced
    {
      const char *name, *description;
    };
    // Names that are taken, so that a later release can give them their meaning without surprise.
    constexpr Announced announced[] = {{"study", "Study the penalty parameter, the mesh or the quadrature"},
                                       {"report", "Rebuild report.html from results"},
                                       {"init", "Write a short commented case"},
                                       {"schema", "Print the schema of case files"},
                                       {"explain", "Explain a message"},
                                       {"completion", "Print shell completion"}};

    int usage_error(const std::string &message)
    {
      fmt::print(stderr, "unilateral: error: {}\nTry 'unilateral --help'.\n", message);
      return exit_bad_input;
    }

    /// The message for a command that has a name but no meaning yet; empty when another was given.
    std::string not_available(const CLI::App &program)
    {
      for (const Announced &command : announced)
        if (program.got_subcommand(command.name))
          return fmt::format("'{}' is not available yet in version {}", command.name, UNILATERAL_VERSION);
      return "";
    }

    std::vector<std::string> command_names(const CLI::App &program)
    {
      std::vector<std::string> names;
      for (const CLI::App *command : program.get_subcommands([](const CLI::App *) { return true; }))
        names.push_back(command->get_name());
      return names;
    }

    /// What to say when no command was recognised.
    std::string missing_command(const CLI::App &program)
    {
      for (const std::string &word : program.remaining())
        if (!word.empty() && word.front() != '-')
        {
          if (word.ends_with(".toml"))
            return fmt::format("'{0}' is not a command; did you mean 'unilateral run {0}'?", word);
          return fmt::format("unknown command '{}'{}", word, suggestion(word, command_names(program)));
        }
      return "a command is missing: run, check, expand or infsup";
    }

    /// "unknown option '-x'", "unexpected argument 'y'" with the nearest option's name.
    std::string unexpected(const CLI::App &program, const std::vector<std::string> &words)
    {
      for (const std::string &word : words)
      {
        if (word.size() < 2 || word.front() != '-')
          return fmt::format("unexpected argument '{}'", word);
        std::vector<std::string> known = {"--help", "--version", "--json", "--quiet", "--verbose", "--no-color", "--log", "--set"};
        if (program.got_subcommand("run") || program.got_subcommand("infsup"))
          known.push_back("--output");
        if (program.got_subcommand("infsup"))
          known.insert(known.end(), {"--levels", "--zone"});
        const std::string nearest = did_you_mean(word.substr(0, word.find('=')), known);
        return nearest.empty() ? fmt::format("unknown option '{}'", word)
                               : fmt::format("unknown option '{}'; did you mean '{}'?", word, nearest);
      }
      return "unexpected arguments";
    }
  } // namespace

  std::variant<Options, int> parse_command_line(const int argc, char **argv)
  {
    Options                  options;
    std::vector<std::string> settings;

    CLI::App program("Solves obstacle problems: variational inequalities with unilateral constraints, by finite elements.", "unilateral");
    program.footer("Exit codes: 0 solved and every expectation holds, 1 internal error, 2 bad input or usage, 3 not converged,\n"
                   "            4 solved but an expectation fails, 130 interrupted.");
    program.require_subcommand(1);
    program.fallthrough();
    program.set_version_flag("--version", "unilateral " UNILATERAL_VERSION " (deal.II " DEAL_II_PACKAGE_VERSION ")");
    program.add_flag("--json", options.json, "Results as JSON on standard output, and nothing else there");
    program.add_flag("-q,--quiet", options.quiet, "Only warnings and errors");
    program.add_flag("-v,--verbose", options.verbose, "Every step of the solver");
    program.add_flag("--no-color", options.no_color, "Plain text also on a terminal");
    program.add_option("--log", options.log_file, "Write everything to this file as it happens")->type_name("FILE");
    // One value each: a list would swallow the case file after it.
    program.add_option("--set", settings, "Set a key of the case, e.g. --set mesh.refine=6; may be repeated")
      ->type_name("KEY=VALUE")
      ->allow_extra_args(false)
      ->expected(1)
      ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);

    const auto add_case = [&options](CLI::App *command)
    { command->add_option("CASE", options.case_path, "The case file (TOML)")->required()->type_name(""); };
    CLI::App *const run = program.add_subcommand("run", "Solve a case");
    add_case(run);
    run->add_option("-o,--output", options.directory, "Folder of the results; default: <case name>.out")->type_name("DIR");
    CLI::App *const check = program.add_subcommand("check", "Read a case, build its mesh and spaces, show the gap; solve nothing");
    add_case(check);
    CLI::App *const expand = program.add_subcommand("expand", "Print a case with every default filled in");
    add_case(expand);
    CLI::App *const infsup = program.add_subcommand("infsup", "Inf-sup constants of the element and the rule, level by level");
    add_case(infsup);
    infsup->add_option("-o,--output", options.directory, "Folder of infsup.json and infsup.csv; default: <case name>.out")
      ->type_name("DIR");
    infsup->add_option("--levels", options.n_levels, "How many levels, from the coarse mesh on; default 5")
      ->check(CLI::Range(1, 20))
      ->type_name("N");
    infsup->add_option("--zone", options.zone, "Where the pressure may live, e.g. \"x>1/3 && x<2/3\"")->type_name("EXPRESSION");
    for (const Announced &command : announced)
    {
      CLI::App *const added = program.add_subcommand(command.name, fmt::format("{} (not available yet)", command.description));
      added->allow_extras();
    }
    for (CLI::App *const command : {run, check, expand, infsup})
      command->footer("Also: --json, -q, -v, --no-color, --log FILE, --set KEY=VALUE; see 'unilateral --help'.");

    try
    {
      program.parse(argc, argv);
    }
    catch (const CLI::CallForHelp &e)
    {
      return program.exit(e);
    }
    catch (const CLI::CallForAllHelp &e)
    {
      return program.exit(e);
    }
    catch (const CLI::CallForVersion &e)
    {
      return program.exit(e);
    }
    catch (const CLI::ParseError &e)
    {
      // An announced command is told apart from a wrong one whatever follows it.
      if (const std::string announcement = not_available(program); !announcement.empty())
        return usage_error(announcement);
      if (program.get_subcommands().empty())
        return usage_error(missing_command(program));
      if (const std::vector<std::string> words = program.remaining(true); dynamic_cast<const CLI::ExtrasError *>(&e) && !words.empty())
        return usage_error(unexpected(program, words));
      if (options.case_path.empty() && dynamic_cast<const CLI::RequiredError *>(&e))
        return usage_error(fmt::format("the case file is missing: unilateral {} CASE.toml", program.get_subcommands().front()->get_name()));
      return usage_error(e.what());
    }

    if (const std::string announcement = not_available(program); !announcement.empty())
      return usage_error(announcement);
    for (const auto &[app, command] :
         {std::pair(run, Command::run), {check, Command::check}, {expand, Command::expand}, {infsup, Command::infsup}})
      if (program.got_subcommand(app))
        options.command = command;

    for (const std::string &setting : settings)
    {
      const std::size_t equals = setting.find('=');
      if (equals == std::string::npos || equals == 0)
        return usage_error(fmt::format("--set takes KEY=VALUE, e.g. --set mesh.refine=6, not '{}'", setting));
      options.overrides.emplace_back(setting.substr(0, equals), setting.substr(equals + 1));
    }
    return options;
  }
} // namespace unilateral
