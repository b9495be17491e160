#include "cli/options.h"

#include "cli/command_description.h"

#include "unilateral/base/visible_text.h"

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <utility>

namespace unilateral
{
  namespace
  {
    /// The words of a list, at commas outside parentheses, without the blanks around them.
    std::vector<std::string> split(const std::string &text)
    {
      std::vector<std::string> words(1);
      int                      depth = 0;
      for (const char c : text)
      {
        depth += (c == '(') - (c == ')');
        if (c == ',' && depth == 0)
          words.emplace_back();
        else
          words.back() += c;
      }
      for (std::string &word : words)
      {
        const std::size_t first = word.find_first_not_of(" \t"), last = word.find_last_not_of(" \t");
        word = first == std::string::npos ? "" : word.substr(first, last - first + 1);
      }
      return words;
    }

    int usage_error(const std::string &message)
    {
      fmt::print(stderr, "unilateral: error: {}\nTry 'unilateral --help'.\n", visible_lines(message));
      return exit_bad_input;
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
      return "a command is missing: run, check, expand, infsup, study, sweep, report or picture; init writes a case to start from, "
             "explain NAME tells more about a message, schema and completion help editors and shells";
    }

    /// The same of `study`, where the words after it name none of its commands.
    std::string missing_study(const CLI::App &study, const std::vector<std::string> &words)
    {
      for (const std::string &word : words)
        if (!word.empty() && word.front() != '-' && !word.ends_with(".toml"))
          return fmt::format("unknown study '{}'{}", word, suggestion(word, command_names(study)));
      return "what is to be studied? unilateral study epsilon | mesh | quadrature CASE.toml";
    }

    /// "--levels" and the like, of a command alone.
    std::vector<std::string> long_options(const CLI::App &command)
    {
      std::vector<std::string> names;
      for (const CLI::Option *const option : command.get_options())
        if (!option->get_lnames().empty())
          names.push_back("--" + option->get_lnames()[0]);
      return names;
    }

    /// The commands below @p app that have this option, "infsup", "study mesh".
    void find_commands_with(const std::string &option, const CLI::App &app, const std::string &name, std::vector<std::string> &found)
    {
      for (const CLI::App *const command : app.get_subcommands([](const CLI::App *) { return true; }))
      {
        const std::string              full_name = name + command->get_name();
        const std::vector<std::string> options = long_options(*command);
        if (std::find(options.begin(), options.end(), option) != options.end())
          found.push_back("'" + full_name + "'");
        find_commands_with(option, *command, full_name + " ", found);
      }
    }

    /// "--quiet" for "--quit": the dashes are alike in all of them.
    std::string nearest_option(const std::string &option, const std::vector<std::string> &known)
    {
      const auto without_dashes = [](const std::string &name) { return name.substr(std::min(name.size(), name.find_first_not_of('-'))); };
      std::vector<std::string> names;
      for (const std::string &name : known)
        names.push_back(without_dashes(name));
      const std::string nearest = did_you_mean(without_dashes(option), names);
      return nearest.empty() ? "" : "--" + nearest;
    }

    /// "unknown option '-x'", "unexpected argument 'y'" with the nearest option's name.
    std::string unexpected(const CLI::App &program, const std::vector<std::string> &words)
    {
      for (const std::string &word : words)
      {
        if (word.size() < 2 || word.front() != '-')
          return fmt::format("unexpected argument '{}'", word);
        const std::string        option = word.substr(0, word.find('='));
        std::vector<std::string> known = long_options(program), others;
        std::string              command;
        for (const CLI::App *app = &program; !app->get_subcommands().empty();)
        {
          app = app->get_subcommands().front();
          command += (command.empty() ? "" : " ") + app->get_name();
          const std::vector<std::string> own = long_options(*app);
          known.insert(known.end(), own.begin(), own.end());
        }
        find_commands_with(option, program, "", others);
        if (!others.empty())
          return fmt::format("'{}' has no option '{}'; {} {} it", command, option, fmt::join(others, ", "),
                             others.size() == 1 ? "has" : "have");
        const std::string nearest = nearest_option(option, known);
        return nearest.empty() ? fmt::format("unknown option '{}'", word)
                               : fmt::format("unknown option '{}'; did you mean '{}'?", word, nearest);
      }
      return "unexpected arguments";
    }

    /// "1e-1, 1e-2" as numbers > 0; an error message in @p error.
    std::vector<double> parse_values(const std::string &text, std::string &error)
    {
      std::vector<double> values;
      for (const std::string &word : split(text))
      {
        char        *end = nullptr;
        const double value = std::strtod(word.c_str(), &end);
        if (word.empty() || *end != 0 || !(value > 0) || !std::isfinite(value))
          error = fmt::format("--values takes positive numbers separated by commas, e.g. --values 1e-1,1e-2; '{}' is none", word);
        values.push_back(value);
      }
      return values;
    }

    /// @p n values from @p from to @p to, equal ratios.
    std::vector<double> geometric_sequence(const double from, const double to, const unsigned n)
    {
      std::vector<double> values;
      for (unsigned k = 0; k < n; ++k)
        values.push_back(n == 1 ? from : from * std::pow(to / from, double(k) / (n - 1)));
      return values;
    }

    double number(const std::string &text)
    {
      char        *end = nullptr;
      const double value = std::strtod(text.c_str(), &end);
      return text.empty() || *end != 0 ? std::nan("") : value;
    }

    std::string positive_number(const std::string &text)
    {
      return number(text) > 0 && std::isfinite(number(text)) ? "" : "must be a positive number, not '" + text + "'";
    }

    std::string exponent(const std::string &text)
    {
      return std::abs(number(text)) <= 10 ? "" : "must be a number between -10 and 10, not '" + text + "'";
    }

    /// The commands and options that there are, and what a command line says with them.
    class CommandLine
    {
    public:
      CommandLine()
        : program("Solves obstacle problems: variational inequalities with unilateral constraints, by finite elements.", "unilateral")
      {
        add_general_options();
        CLI::App *const run = add_command(program, "run", "Solve a case", Command::run);
        add_output("Folder of the results; default: <case name>.out in the current folder");
        add_processes(*run);
        run->add_flag("--resume", options.resume, "Go on with what an unfinished run has left in the folder");
        add_command(program, "check", "Read a case, build its mesh and spaces, show the gap; solve nothing", Command::check);
        add_output("Folder for parts.vtu, the parts of the boundary for ParaView; without it nothing is written");
        add_command(program, "expand", "Print a case with every default filled in", Command::expand);
        add_infsup();
        study = program.add_subcommand("study", "Study the penalty parameter, the mesh or the quadrature of a case");
        study->require_subcommand(1);
        add_study_epsilon();
        add_study_mesh();
        add_study_quadrature();
        add_sweep();
        add_report();
        add_picture();
        for (const auto &[app, command] : commands)
          app->footer("Also: --json, -q, -v, --no-color, --allow-scripts, --log FILE, --set KEY=VALUE; see 'unilateral --help'.");
        add_help_commands();
      }

      std::vector<CommandDescription> describe() const
      {
        std::vector<CommandDescription> all;
        describe(program, "", all);
        return all;
      }

      std::variant<Options, int> parse(const int argc, char **argv)
      {
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
          return usage_error(explanation(e));
        }
        for (const auto &[app, command] : commands)
          if (app->parsed())
            options.command = command;
        if (const std::string error = read_texts(); !error.empty())
          return usage_error(error);
        return options;
      }

    private:
      void add_general_options()
      {
        program.footer("Exit codes: 0 solved and every expectation holds, 1 internal error, 2 bad input or usage, 3 not converged,\n"
                       "            4 solved but an expectation fails, 130 interrupted.");
        program.require_subcommand(1);
        program.fallthrough();
        program.set_version_flag("--version", "unilateral " UNILATERAL_VERSION " (deal.II " UNILATERAL_DEALII_VERSION ")");
        program.add_flag("--json", options.json, "Results as JSON on standard output, and nothing else there");
        program.add_flag("-q,--quiet", options.quiet, "Only warnings and errors");
        program.add_flag("-v,--verbose", options.verbose, "Every step of the solver");
        program.add_flag("--no-color", options.no_color, "Plain text also on a terminal");
        program.add_flag("--allow-scripts", options.allow_scripts, "Run a mesh script (.geo) even where the system cannot confine it");
        program.add_option("--log", options.log_file, "Write everything to this file as it happens")->type_name("FILE");
        // One value each: a list would swallow the case file after it.
        program.add_option("--set", settings, "Set a key of the case, e.g. --set mesh.refine=6; may be repeated")
          ->type_name("KEY=VALUE")
          ->allow_extra_args(false)
          ->expected(1)
          ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
      }

      CLI::App *add_command(CLI::App &parent, const std::string &name, const std::string &description, const Command command)
      {
        CLI::App *const app = parent.add_subcommand(name, description);
        app->add_option("CASE", options.case_path, "The case file (TOML)")->required()->type_name("");
        commands.emplace_back(app, command);
        return app;
      }

      /// To the command that was added last.
      void add_output(const std::string &description)
      {
        commands.back().first->add_option("-o,--output", options.directory, description)->type_name("DIR");
      }

      void add_infsup()
      {
        CLI::App *const infsup =
          add_command(program, "infsup", "Inf-sup constants of the element and the rule, level by level", Command::infsup);
        add_output("Folder of infsup.json and infsup.csv; default: <case name>.out in the current folder");
        add_latex();
        infsup->add_option("--levels", options.n_levels, "How many levels, from the coarse mesh on; default 5")
          ->check(CLI::Range(1, 20))
          ->type_name("N");
        auto *const zone = infsup->add_option("--zone", options.zone, "Where the pressure may live, e.g. \"x>1/3 && x<2/3\"");
        texts.emplace_back(zone->type_name("EXPRESSION"), &options.zone);
      }

      /// To the command that was added last.
      void add_latex()
      {
        commands.back().first->add_flag("--latex", options.latex, "Write the table for LaTeX, too: a .tex file beside the .csv");
      }

      CLI::App *add_study(const std::string &name, const std::string &description, const Command command)
      {
        CLI::App *const app = add_command(*study, name, description, command);
        add_output("Folder of the results; default: <case name>.out in the current folder");
        add_latex();
        return app;
      }

      void add_study_epsilon()
      {
        CLI::App *const app =
          add_study("epsilon", "Theorems 1 to 3: the penalty against the mixed method for many epsilon", Command::study_epsilon);
        auto *const list = app->add_option("--values", values, "Values of epsilon: 1e-1,1e-2,...")->type_name("LIST");
        auto *const first = app->add_option("--from", from, "Largest epsilon, with --to")->check(positive_number);
        auto *const last = app->add_option("--to", to, "Smallest epsilon")->check(positive_number);
        auto *const number_of_points =
          app->add_option("--points", n_points, "How many between --from and --to; default: one a decade")->check(CLI::Range(1, 1000));
        first->needs(last)->excludes(list)->type_name("A");
        last->needs(first)->type_name("B");
        number_of_points->needs(first)->type_name("N");
        texts.emplace_back(list, &values);
        add_processes(*app, "the values of epsilon");
      }

      void add_processes(CLI::App &app, const std::string &what = "the mesh")
      {
        app.add_option("-n,--processes", options.n_processes, "By several processes, which share " + what + "; mpirun starts them")
          ->check(CLI::Range(1, 100000))
          ->type_name("N");
      }

      void add_study_mesh()
      {
        CLI::App *const app = add_study("mesh", "Errors, or differences between levels, and their rates in h", Command::study_mesh);
        app->add_option("--levels", options.n_levels, "How many levels, from the coarse mesh on; default: as the case refines")
          ->check(CLI::Range(1, 20))
          ->type_name("N");
        app->add_option("--epsilon", options.epsilon, "The penalty parameter on the coarsest mesh")->check(positive_number)->type_name("E");
        app->add_option("--power", options.power, "epsilon ~ h^K; without it epsilon is the same on every mesh")
          ->check(exponent)
          ->type_name("K");
        app->add_flag("--adaptive", options.adaptive,
                      "Also meshes that are refined by the error, up to as many unknowns or as mesh.adapt says");
        add_processes(*app);
      }

      void add_study_quadrature()
      {
        CLI::App *const app = add_study("quadrature", "The rules I_G side by side", Command::study_quadrature);
        auto *const     list = app->add_option("--rules", rules, "Rules, e.g. \"nodal,gauss(1),gauss(2)\"; default: all that fit");
        texts.emplace_back(list->type_name("LIST"), &rules);
        add_processes(*app, "the rules");
      }

      void add_sweep()
      {
        CLI::App *const app = add_command(program, "sweep", "Run a case for many values of some keys, side by side", Command::sweep);
        add_output("Folder of sweep.csv, sweep.json, report.html and the runs; default: <case name>.sweep in the current folder");
        add_latex();
        app->add_option("--over", options.over, "Values of a key: KEY=FROM:TO:N or KEY=A,B,C; again for every combination with another key")
          ->required()
          ->type_name("KEY=VALUES")
          ->allow_extra_args(false)
          ->expected(1)
          ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
        app->add_option("--quantity", options.quantities, "A number for the table, a path into results.json; may be repeated")
          ->type_name("PATH")
          ->allow_extra_args(false)
          ->expected(1)
          ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
        app->add_option("--jobs", options.n_jobs, "Runs at a time; default: as many as there are processors")
          ->check(CLI::Range(1, 1024))
          ->type_name("N");
      }

      void add_report()
      {
        CLI::App *const app = program.add_subcommand("report", "Make report.html of the results in a folder, or of several side by side");
        app->add_option("DIR", options.folders, "Folders of results")->required()->type_name("");
        app->add_option("-o,--output", options.output_file, "The file; default: report.html in the folder, of several in the current one")
          ->type_name("FILE");
        commands.emplace_back(app, Command::report);
      }

      void add_picture()
      {
        CLI::App *const app = program.add_subcommand("picture", "Draw the results in a folder, without a screen");
        app->add_option("DIR", options.folders, "Folder of results")->required()->expected(1)->type_name("");
        app->add_option("-o,--output", options.output_file, "The file, .svg or .png; default: picture.svg in the folder")
          ->type_name("FILE");
        app
          ->add_option("--field", options.field,
                       "What colours show, e.g. von_mises; default: of a body the stress, else the contact pressure")
          ->type_name("NAME");
        commands.emplace_back(app, Command::picture);
      }

      CLI::App *add_help_command(const std::string &name, const std::string &description, const Command command)
      {
        CLI::App *const app = program.add_subcommand(name, description);
        commands.emplace_back(app, command);
        return app;
      }

      void add_help_commands()
      {
        CLI::App *const init =
          add_help_command("init", "Write a short commented case; without a name, list those that there are", Command::init);
        init->add_option("KIND", init_kind, "What to start from")->type_name("");
        init->add_option("FILE", init_file, "The file to write, - for standard output; default: KIND.toml")->type_name("");
        init->add_option("--mesh", options.mesh_file, "A mesh file, whose parts are listed in the case")->type_name("FILE");
        init->add_flag("--list", list_cases, "List the cases that there are");
        add_help_command("schema", "Print the JSON Schema of case files, for editors", Command::schema);
        add_help_command("explain", "Explain a message by the name at its end; without a name, list all", Command::explain)
          ->add_option("NAME", options.words, "The name")
          ->expected(0, 1)
          ->type_name("");
        add_help_command("completion", "Print the completion for a shell", Command::completion)
          ->add_option("SHELL", options.words, "bash, zsh or fish")
          ->required()
          ->expected(1)
          ->check(CLI::IsMember({"bash", "zsh", "fish"}))
          ->type_name("");
        CLI::App *const manual = add_help_command("manual", "Print a manual page", Command::manual);
        manual->add_option("PAGE", options.words, "unilateral or unilateral-case")
          ->required()
          ->expected(1)
          ->check(CLI::IsMember({"unilateral", "unilateral-case"}))
          ->type_name("");
        manual->group(""); // for the installation
      }

      static void describe(const CLI::App &app, const std::string &name, std::vector<CommandDescription> &all)
      {
        CommandDescription command{name, "", app.get_description(), {}};
        for (const CLI::Option *const option : app.get_options())
        {
          if (option->get_positional())
          {
            if (command.argument.empty())
              command.argument = option->get_name();
            continue;
          }
          const auto &short_names = option->get_snames();
          const bool  flag = option->get_items_expected_max() == 0;
          // Without the range that a check adds.
          const std::string value = option->get_type_name().substr(0, option->get_type_name().find(':'));
          command.options.push_back({"--" + option->get_lnames().at(0), short_names.empty() ? "" : "-" + short_names[0], flag ? "" : value,
                                     option->get_description()});
        }
        all.push_back(command);
        for (const CLI::App *const inner : app.get_subcommands([](const CLI::App *) { return true; }))
          if (!inner->get_group().empty())
            describe(*inner, name.empty() ? inner->get_name() : name + " " + inner->get_name(), all);
      }

      /// What is wrong with a command line that CLI11 refuses.
      std::string explanation(const CLI::ParseError &e) const
      {
        if (program.get_subcommands().empty())
          return missing_command(program);
        if (const std::vector<std::string> words = program.remaining(true); dynamic_cast<const CLI::ExtrasError *>(&e) && !words.empty())
          return unexpected(program, words);
        if (program.got_subcommand("sweep") && !options.case_path.empty() && options.over.empty())
          return "what is to change? --over KEY=FROM:TO:N or --over KEY=A,B,C";
        if (program.got_subcommand("completion") && options.words.empty())
          return "which shell? unilateral completion bash | zsh | fish";
        if (!options.case_path.empty() || !dynamic_cast<const CLI::RequiredError *>(&e))
          return e.what();
        std::string name = program.get_subcommands().front()->get_name();
        if (program.got_subcommand(study))
        {
          if (study->get_subcommands().empty())
            return missing_study(*study, program.remaining(true));
          name += " " + study->get_subcommands().front()->get_name();
        }
        if (program.got_subcommand("report") || program.got_subcommand("picture"))
          return fmt::format("the folder of the results is missing: unilateral {} case.out", name);
        return fmt::format("the case file is missing: unilateral {} CASE.toml{}", name,
                           program.got_subcommand("sweep") ? " --over KEY=FROM:TO:N" : "");
      }

      /// Lists and settings become what they mean; returns what is wrong with them.
      std::string read_texts()
      {
        for (const auto &[option, text] : texts)
          if (option->count() > 0 && text->find_first_not_of(" \t") == std::string::npos)
            return fmt::format("{} is given without a value", option->get_name());
        for (const std::string &word : {init_kind, init_file})
          if (!word.empty() && !list_cases)
            options.words.push_back(word);
        std::string error;
        if (!values.empty())
          options.epsilons = parse_values(values, error);
        if (!error.empty())
          return error;
        if (from > 0)
          options.epsilons = geometric_sequence(from, to, n_points > 0 ? n_points : 1 + std::lround(std::abs(std::log10(from / to))));
        if (!rules.empty())
          options.rules = split(rules);
        for (const std::string &setting : settings)
        {
          const std::size_t equals = setting.find('=');
          if (equals == std::string::npos || equals == 0)
            return fmt::format("--set takes KEY=VALUE, e.g. --set mesh.refine=6, not '{}'", setting);
          options.overrides.emplace_back(setting.substr(0, equals), setting.substr(equals + 1));
        }
        return "";
      }

      Options                                              options;
      CLI::App                                             program;
      CLI::App                                            *study = nullptr;
      std::vector<std::pair<CLI::App *, Command>>          commands;
      std::vector<std::pair<CLI::Option *, std::string *>> texts; ///< options whose text may not be blank
      std::vector<std::string>                             settings;
      std::string                                          values, rules, init_kind, init_file;
      double                                               from = 0, to = 0;
      unsigned                                             n_points = 0;
      bool                                                 list_cases = false;
    };
  } // namespace

  std::variant<Options, int> parse_command_line(const int argc, char **argv)
  {
    return CommandLine().parse(argc, argv);
  }

  std::vector<CommandDescription> describe_commands()
  {
    return CommandLine().describe();
  }
} // namespace unilateral
