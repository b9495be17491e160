#include "cli/completion.h"

#include "cli/command_description.h"
#include "cli/init.h"

#include "unilateral/case/case_schema.h"
#include "unilateral/case/explanations.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

namespace unilateral
{
  namespace
  {
    std::vector<std::string> words_of(const CommandDescription &command)
    {
      std::vector<std::string> words;
      for (const OptionDescription &option : command.options)
      {
        words.push_back(option.name);
        if (!option.short_name.empty())
          words.push_back(option.short_name);
      }
      return words;
    }

    /// What can stand in the place of the argument of a command; empty: a case file.
    std::vector<std::string> argument_words(const std::string &argument)
    {
      std::vector<std::string> words;
      if (argument == "KIND")
        for (const CaseTemplate &known : case_templates())
          words.push_back(known.name);
      if (argument == "NAME")
        for (const Explanation &known : explanations())
          words.push_back(known.name);
      if (argument == "SHELL")
        words = {"bash", "zsh", "fish"};
      return words;
    }

    std::vector<std::string> assignments()
    {
      std::vector<std::string> words;
      for (const std::string &key : settable_keys())
        words.push_back(key + "=");
      return words;
    }

    /// The commands below @p parent, "" for the first word.
    std::vector<const CommandDescription *> commands_below(const std::vector<CommandDescription> &all, const std::string &parent)
    {
      std::vector<const CommandDescription *> found;
      const std::string                       prefix = parent.empty() ? "" : parent + " ";
      for (const CommandDescription &command : all)
        if (!command.name.empty() && command.name.starts_with(prefix) && command.name.find(' ', prefix.size()) == std::string::npos)
          found.push_back(&command);
      return found;
    }

    /// The options with a value, as a pattern of the shells' `case`: "--log|--set".
    std::string options_with_value(const std::vector<CommandDescription> &all)
    {
      std::vector<std::string> names;
      for (const CommandDescription &command : all)
        for (const OptionDescription &option : command.options)
          for (const std::string &name : {option.name, option.short_name})
            if (!option.value.empty() && !name.empty() && std::find(names.begin(), names.end(), name) == names.end())
              names.push_back(name);
      return fmt::format("{}", fmt::join(names, "|"));
    }

    /// For each command the lines of a `case` that set `words` (what can follow) and `files` (1: case files can, 2: folders).
    std::string command_cases(const std::vector<CommandDescription> &all)
    {
      std::string text;
      for (const CommandDescription &command : all)
      {
        std::vector<std::string> words;
        for (const CommandDescription *const inner : commands_below(all, command.name))
          words.push_back(inner->name.substr(command.name.empty() ? 0 : command.name.size() + 1));
        const auto arguments = argument_words(command.argument);
        words.insert(words.end(), arguments.begin(), arguments.end());
        // Every command takes the options of the program.
        for (const CommandDescription *const described : {&command, &all.front()})
          for (const std::string &option : words_of(*described))
            if (std::find(words.begin(), words.end(), option) == words.end())
              words.push_back(option);
        text += fmt::format("    '{}') words='{}'; files={} ;;\n", command.name, fmt::join(words, " "),
                            command.argument == "CASE" || command.argument == "KIND" ? 1
                            : command.argument == "DIR"                              ? 2
                                                                                     : 0);
      }
      return text;
    }

    std::string parents(const std::vector<CommandDescription> &all)
    {
      std::vector<std::string> names;
      for (const CommandDescription &command : all)
        if (!command.name.empty() && !commands_below(all, command.name).empty())
          names.push_back(command.name);
      return fmt::format("{}", fmt::join(names, "|"));
    }

    std::string bash_script(const std::vector<CommandDescription> &all)
    {
      std::string names;
      for (const CommandDescription *const command : commands_below(all, ""))
        names += (names.empty() ? "" : "|") + command->name;
      return fmt::format(R"(# bash completion of unilateral: source <(unilateral completion bash)
_unilateral()
{{
  local current=${{COMP_WORDS[COMP_CWORD]}} previous=${{COMP_WORDS[COMP_CWORD-1]}} command='' words='' files=0 skip=0 i word
  COMPREPLY=()
  # bash takes = for a word of its own.
  for ((i = 1; i < COMP_CWORD; ++i)); do
    word=${{COMP_WORDS[i]}}
    if [ $skip = 1 ]; then skip=0; continue; fi
    case $word in
    {0}) skip=1 ;;
    -*|=) ;;
    {1}) if [ -z "$command" ]; then command=$word; fi ;;
    *) case $command in {2}) command="$command $word" ;; esac ;;
    esac
  done
  if [ "$previous" = = ] || [ "$current" = = ]; then return; fi
  case $previous in
  --set|--over)
    COMPREPLY=($(compgen -W '{3}' -- "$current"))
    compopt -o nospace 2>/dev/null
    return ;;
  -o|--output)
    COMPREPLY=($(compgen -d -- "$current"))
    compopt -o filenames 2>/dev/null
    return ;;
  --log|--mesh)
    COMPREPLY=($(compgen -f -- "$current"))
    compopt -o filenames 2>/dev/null
    return ;;
  {0}) return ;;
  esac
  case $command in
{4}  esac
  COMPREPLY=($(compgen -W "$words" -- "$current"))
  if [ $files != 0 ] && [[ $current != -* ]]; then
    compopt -o filenames 2>/dev/null
    local IFS=$'\n'
    if [ $files = 1 ]; then COMPREPLY+=($(compgen -f -X '!*.toml' -- "$current")); fi
    COMPREPLY+=($(compgen -d -- "$current"))
  fi
}}
complete -F _unilateral unilateral
)",
                         options_with_value(all), names, parents(all), fmt::join(assignments(), " "), command_cases(all));
    }

    std::string zsh_script(const std::vector<CommandDescription> &all)
    {
      std::string names;
      for (const CommandDescription *const command : commands_below(all, ""))
        names += (names.empty() ? "" : "|") + command->name;
      return fmt::format(R"(#compdef unilateral
# zsh completion of unilateral: source <(unilateral completion zsh), or as a file _unilateral in a folder of $fpath
_unilateral()
{{
  local command='' words_before word previous=${{words[CURRENT-1]}} list='' files=0 skip=0
  for word in ${{words[2,CURRENT-1]}}; do
    if [[ $skip = 1 ]]; then skip=0; continue; fi
    case $word in
    {0}) skip=1 ;;
    -*) ;;
    {1}) if [[ -z $command ]]; then command=$word; fi ;;
    *) case $command in {2}) command="$command $word" ;; esac ;;
    esac
  done
  case $previous in
  --set|--over) compadd -S '' -- ${{=:-'{3}'}}; return ;;
  -o|--output) _files -/; return ;;
  --log|--mesh) _files; return ;;
  {0}) return ;;
  esac
  _unilateral_words
  compadd -- ${{=list}}
  if [[ $files = 1 ]]; then _files -g '*.toml'; fi
  if [[ $files = 2 ]]; then _files -/; fi
}}
_unilateral_words()
{{
  local words=''
  case $command in
{4}  esac
  list=$words
}}
if [[ ${{funcstack[1]}} = _unilateral ]]; then _unilateral "$@"; else compdef _unilateral unilateral; fi
)",
                         options_with_value(all), names, parents(all), fmt::join(assignments(), " "), command_cases(all));
    }

    std::string fish_quoted(const std::string &text)
    {
      std::string quoted = "'";
      for (const char c : text)
      {
        if (c == '\'' || c == '\\')
          quoted += '\\';
        quoted += c;
      }
      return quoted + "'";
    }

    std::string fish_option(const OptionDescription &option, const std::string &condition)
    {
      std::string text = fmt::format("complete -c unilateral{} -l {}", condition, option.name.substr(2));
      if (!option.short_name.empty())
        text += " -s " + option.short_name.substr(1);
      if (option.name == "--set" || option.name == "--over")
        text += fmt::format(" -x -a {}", fish_quoted(fmt::format("{}", fmt::join(assignments(), " "))));
      else if (option.name == "--output")
        text += " -x -a '(__fish_complete_directories)'";
      else if (option.value == "FILE")
        text += " -r -F";
      else if (!option.value.empty())
        text += " -x";
      return text + " -d " + fish_quoted(option.description) + "\n";
    }

    std::string fish_script(const std::vector<CommandDescription> &all)
    {
      std::string text = "# fish completion of unilateral: unilateral completion fish | source\ncomplete -c unilateral -f\n";
      for (const CommandDescription &command : all)
      {
        std::string       condition;
        const std::size_t blank = command.name.find(' ');
        if (!command.name.empty())
          condition = fmt::format(" -n '__fish_seen_subcommand_from {}{}'", command.name.substr(0, blank),
                                  blank == std::string::npos ? "" : "; and __fish_seen_subcommand_from " + command.name.substr(blank + 1));
        const auto  inner = commands_below(all, command.name);
        std::string inner_names;
        for (const CommandDescription *const candidate : inner)
          inner_names += " " + candidate->name.substr(command.name.empty() ? 0 : command.name.size() + 1);
        for (const CommandDescription *const candidate : inner)
          text +=
            fmt::format("complete -c unilateral -n '{}not __fish_seen_subcommand_from{}' -a {} -d {}\n",
                        command.name.empty() ? "" : "__fish_seen_subcommand_from " + command.name + "; and ", inner_names,
                        candidate->name.substr(command.name.empty() ? 0 : command.name.size() + 1), fish_quoted(candidate->description));
        for (const OptionDescription &option : command.options)
          if (command.name.empty() || option.name != "--help")
            text += fish_option(option, condition);
        if (const auto words = argument_words(command.argument); !words.empty())
          text += fmt::format("complete -c unilateral{} -a {}\n", condition, fish_quoted(fmt::format("{}", fmt::join(words, " "))));
        if (command.argument == "DIR")
          text += fmt::format("complete -c unilateral{} -a '(__fish_complete_directories)'\n", condition);
        if (command.argument == "CASE")
          text += fmt::format("complete -c unilateral{} -k -a '(__fish_complete_suffix .toml)'\n", condition);
      }
      return text;
    }
  } // namespace

  std::string completion_script(const std::string &shell)
  {
    const std::vector<CommandDescription> all = describe_commands();
    return shell == "bash" ? bash_script(all) : shell == "zsh" ? zsh_script(all) : fish_script(all);
  }
} // namespace unilateral
