// Every message has a name, every name an explanation, and every explanation a message.
#include "unilateral/case/explanations.h"
#include "unilateral/case/read_case.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <map>
#include <regex>
#include <set>
#include <sstream>

using namespace unilateral;

namespace
{
  namespace fs = std::filesystem;

  /// The sources of the library and the program, but for the texts of the explanations.
  const std::map<std::string, std::string> &sources()
  {
    static const std::map<std::string, std::string> texts = []
    {
      std::map<std::string, std::string> found;
      for (const std::string folder : {"unilateral", "cli"})
        for (const auto &entry : fs::recursive_directory_iterator(fs::path(PROJECT_DIR) / folder))
          if (const std::string name = entry.path().filename(); name.ends_with(".cc") && name != "explanations.cc")
          {
            std::ostringstream text;
            text << std::ifstream(entry.path()).rdbuf();
            found[entry.path().string()] = text.str();
          }
      return found;
    }();
    return texts;
  }

  std::set<std::string> matches(const std::string &pattern)
  {
    std::set<std::string> found;
    const std::regex      expression(pattern);
    for (const auto &[file, text] : sources())
      for (std::sregex_iterator it(text.begin(), text.end(), expression), end; it != end; ++it)
        found.insert((*it)[1]);
    return found;
  }

  /// From the parenthesis at @p begin to the one that closes it.
  std::string call(const std::string &text, const std::size_t begin)
  {
    int  depth = 0;
    bool quoted = false;
    for (std::size_t i = begin; i < text.size(); ++i)
    {
      if (quoted && text[i] == '\\')
        ++i;
      else if (text[i] == '"')
        quoted = !quoted;
      else if (!quoted && text[i] == '(')
        ++depth;
      else if (!quoted && text[i] == ')' && --depth == 0)
        return text.substr(begin, i - begin);
    }
    return text.substr(begin);
  }
} // namespace

TEST(MessageNames, every_name_in_the_code_has_an_explanation_and_every_explanation_a_place_in_the_code)
{
  std::set<std::string> explained;
  for (const Explanation &entry : explanations())
    EXPECT_TRUE(explained.insert(entry.name).second) << entry.name << " is there twice";
  std::set<std::string> used = matches("MessageName\\(\"([a-z-]+)\"\\)");
  used.merge(matches("\\[(not-converged)\\]"));
  // The verdicts on stability, as they are printed.
  for (std::string verdict : matches("return \"(stable|weakly unstable|kernel)\""))
    used.insert(std::regex_replace(verdict, std::regex(" "), "-"));
  EXPECT_EQ(used, explained);
}

TEST(MessageNames, every_error_and_warning_has_a_name)
{
  const std::regex message("(diagnostics(\\.|->)(error|warning)|throw InputError)(?=\\()");
  unsigned         n = 0;
  for (const auto &[file, text] : sources())
    for (std::sregex_iterator it(text.begin(), text.end(), message), end; it != end; ++it, ++n)
    {
      const std::string arguments = call(text, static_cast<std::size_t>(it->position() + it->length()));
      const bool        named = arguments.find("MessageName(") != std::string::npos || arguments.find("name)") != std::string::npos ||
                         arguments.find(".name") != std::string::npos || arguments.find("e.diagnostics") != std::string::npos;
      // The last two read results, not cases.
      const bool excepted =
        file.ends_with("base/diagnostics.cc") || file.find("/report/") != std::string::npos || file.find("/output/") != std::string::npos;
      EXPECT_TRUE(named || excepted) << file << ": " << arguments;
    }
  EXPECT_GT(n, 200u);
}

TEST(MessageNames, explanations_are_complete)
{
  for (const Explanation &entry : explanations())
  {
    EXPECT_TRUE(entry.sort == "error" || entry.sort == "warning" || entry.sort == "verdict") << entry.name;
    for (const std::string &text : {entry.summary, entry.cause, entry.example, entry.remedy})
      EXPECT_FALSE(text.empty()) << entry.name;
  }
}

TEST(MessageNames, a_message_ends_with_its_name_in_brackets)
{
  EXPECT_EQ(to_string({{"a.toml", 3, 4}, Severity::error, "m", MessageName("unknown-key")}), "a.toml:3:4: error: m [unknown-key]");
  Diagnostics diagnostics;
  try
  {
    parse_case("mesh.box = [[0], [1]]\nmodel.kind = \"membrane\"\nmodel.lod = \"sinn(x)\"\nboundary.top = 0\nmodel.load = \"sinn(x)\"\n",
               "case.toml", {}, diagnostics);
    FAIL();
  }
  catch (const InputError &e)
  {
    std::set<std::string> names;
    for (const Diagnostic &message : e.diagnostics)
      names.insert(message.name.text);
    EXPECT_EQ(names, (std::set<std::string>{"unknown-key", "unknown-part", "unknown-function"}));
  }
}
