#include "cli/help_commands.h"

#include "cli/command_description.h"
#include "cli/completion.h"
#include "cli/init.h"
#include "cli/manual.h"

#include "unilateral/base/diagnostics.h"
#include "unilateral/case/explanations.h"
#include "unilateral/case/json_schema.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>

namespace unilateral
{
  namespace
  {
    using HelpJson = nlohmann::ordered_json;

    std::string explanation_list(const bool json)
    {
      HelpJson    list = HelpJson::array();
      std::string text;
      for (const char *const sort : {"error", "warning", "verdict"})
      {
        text += fmt::format("{}{}s\n", text.empty() ? "" : "\n", sort);
        for (const Explanation &entry : explanations())
          if (entry.sort == sort)
          {
            text += fmt::format("  {:<26}{}\n", entry.name, entry.summary);
            list.push_back({{"name", entry.name}, {"sort", sort}, {"summary", entry.summary}});
          }
      }
      return json ? list.dump(2) + "\n" : text;
    }

    std::string explain(const std::string &name, const bool json)
    {
      if (name.empty())
        return explanation_list(json);
      const auto &all = explanations();
      // As it stands in a message, in brackets, or as a verdict is written, with blanks.
      std::string wanted = name;
      if (wanted.size() > 2 && wanted.front() == '[' && wanted.back() == ']')
        wanted = wanted.substr(1, wanted.size() - 2);
      std::replace(wanted.begin(), wanted.end(), ' ', '-');
      std::replace(wanted.begin(), wanted.end(), '_', '-');
      const auto entry = std::find_if(all.begin(), all.end(), [&](const Explanation &candidate) { return candidate.name == wanted; });
      if (entry == all.end())
      {
        std::vector<std::string> names;
        for (const Explanation &candidate : all)
          names.push_back(candidate.name);
        const std::string nearest = did_you_mean(wanted, names);
        throw InputError({},
                         fmt::format("there is no message called '{}'; {}", name,
                                     nearest.empty() ? "'unilateral explain' lists them" : "did you mean '" + nearest + "'?"),
                         MessageName("unknown-choice"));
      }
      if (json)
        return HelpJson{{"name", entry->name},   {"sort", entry->sort},       {"summary", entry->summary},
                        {"cause", entry->cause}, {"example", entry->example}, {"remedy", entry->remedy}}
                 .dump(2) +
               "\n";
      std::string text =
        fmt::format("{} ({}): {}\n\n{}\n\nFor example\n\n", entry->name, entry->sort, entry->summary, wrapped(entry->cause, 80));
      std::size_t begin = 0;
      while (begin < entry->example.size())
      {
        const std::size_t end = std::min(entry->example.find('\n', begin), entry->example.size());
        text += "    " + entry->example.substr(begin, end - begin) + "\n";
        begin = end + 1;
      }
      return text + "\nRemedy\n\n" + wrapped(entry->remedy, 80) + "\n";
    }
  } // namespace

  bool is_help_command(const Command command)
  {
    return command == Command::schema || command == Command::init || command == Command::completion || command == Command::explain ||
           command == Command::manual;
  }

  std::string run_help_command(const Options &options, const CaseWithMesh case_with_mesh)
  {
    switch (options.command)
    {
    case Command::schema:
      return json_schema().dump(2) + "\n";
    case Command::init:
      return init(options.words.empty() ? "" : options.words[0], options.words.size() > 1 ? options.words[1] : "", options.mesh_file,
                  case_with_mesh);
    case Command::completion:
      return completion_script(options.words.at(0));
    case Command::explain:
      return explain(options.words.empty() ? "" : options.words[0], options.json);
    default:
      return manual_page(options.words.at(0));
    }
  }
} // namespace unilateral
