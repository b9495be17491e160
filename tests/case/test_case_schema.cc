// The specification of the case file, the reader and doc/case-file.md name the same keys.
#include "unilateral/case/case_schema.h"
#include "unilateral/case/json_schema.h"
#include "unilateral/case/read_case.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <fstream>
#include <map>
#include <optional>
#include <regex>
#include <set>

using namespace unilateral;

namespace
{
  using Names = std::set<std::string>;
  using Content = std::vector<std::pair<std::string, std::string>>; ///< keys and values

  std::string braces(const Content &content)
  {
    std::string text;
    for (const auto &[key, value] : content)
      text += (text.empty() ? "{ " : ", ") + key + " = " + value;
    return text + " }";
  }

  void set(Content &content, const std::string &key, const std::string &value)
  {
    for (auto &entry : content)
      if (entry.first == key)
      {
        entry.second = value;
        return;
      }
    content.emplace_back(key, value);
  }

  /// A case of @p kind in which the table @p name has @p key besides what it needs; nothing when this kind does not read the table.
  std::optional<std::string> case_with(const std::string &kind, const std::string &name, const std::string &key, const std::string &value)
  {
    Content mesh = {{"box", kind == "beam" ? "[[0], [1]]" : kind == "elasticity" ? "[[0, 0, 0], [1, 1, 1]]" : "[[0, 0], [1, 1]]"}};
    Content model = {{"kind", '"' + kind + '"'}};
    if (kind == "elasticity")
      model.insert(model.end(), {{"young", "1"}, {"poisson", "0.3"}});
    Content    top;
    const auto with_key = [&](Content content)
    {
      set(content, key, value);
      return braces(content);
    };
    const std::map<std::string, std::string> conditions = {
      {"membrane condition", "membrane"}, {"elastic condition", "elasticity"}, {"bending condition", "beam or plate"}};
    const std::map<std::string, Content> shapes = {{"plane", {{"point", "[0, 0, 0]"}, {"normal", "[0, 0, 1]"}}},
                                                   {"sphere", {{"center", "[0, 0, 0]"}}},
                                                   {"cylinder", {{"point", "[0, 0, 0]"}, {"axis", "[0, 0, 1]"}}}};
    const std::map<std::string, Content> sections = {{"material", {{"region", "\"domain\""}}},
                                                     {"periodic", {{"parts", "[\"left\", \"right\"]"}}},
                                                     {"support", {{"at", "0"}}},
                                                     {"point_load", {{"at", kind == "plate" ? "[0, 0]" : "0"}}},
                                                     {"constraint", {}},
                                                     {"method", {}},
                                                     {"exact", {}},
                                                     {"output", {}},
                                                     {"expect", {{"quantity", "\"solution.energy\""}}}};
    if (name == "mesh")
    {
      if (key == "ball" || key == "shell" || key == "file")
        mesh.clear();
      set(mesh, key, value);
    }
    else if (name == "mesh.local")
      set(mesh, "local", "[" + with_key({{"where", "\"x < 1\""}}) + "]");
    else if (name == "ball" || name == "shell")
      mesh = {{name, with_key({{"center", "[0, 0]"}})}};
    else if (name == "model")
      set(model, key, value);
    else if (name == "raster" || name == "profile" || name == "run" || name == "previous")
    {
      if (kind == "elasticity")
        return {};
      set(model, "load", with_key({{name, name == "previous" ? "\"u\"" : "\"a.csv\""}}));
    }
    else if (name == "case")
      set(top, key, value);
    else if (const auto condition = conditions.find(name); condition != conditions.end())
    {
      if (condition->second.find(kind) == std::string::npos)
        return {};
      top.emplace_back("boundary", "{ left = " + with_key({}) + " }");
    }
    else if (name == "surface" || shapes.count(name) > 0)
    {
      if (kind != "elasticity")
        return {};
      const bool needs_stl = key != "plane" && key != "sphere" && key != "cylinder";
      top.emplace_back("constraint", "{ on = \"left\", gap = " +
                                       (name != "surface" ? "{ " + name + " = " + with_key(shapes.at(name)) + " }"
                                        : needs_stl       ? with_key({{"stl", "\"tool.stl\""}})
                                                          : with_key({})) +
                                       " }");
    }
    else if (const auto section = sections.find(name); section != sections.end())
      top.emplace_back(name, with_key(section->second));
    else
      return {}; // [parameters] and [boundary] have keys of the user's
    if (key != "mesh")
      set(top, "mesh", braces(mesh));
    if (key != "model")
      set(top, "model", braces(model));
    std::string text;
    for (const auto &[section_name, section_text] : top)
      text += section_name + " = " + section_text + "\n";
    return text;
  }

  std::vector<Diagnostic> messages_of(const std::string &text)
  {
    Diagnostics diagnostics;
    try
    {
      parse_case(text, "case.toml", {}, diagnostics);
    }
    catch (const InputError &e)
    {
      return e.diagnostics;
    }
    return {};
  }

  bool is_unknown(const std::string &key, const std::string &text)
  {
    const auto messages = messages_of(text);
    return std::any_of(messages.begin(), messages.end(),
                       [&](const Diagnostic &d) { return d.message.find("unknown key '" + key + "'") != std::string::npos; });
  }

  constexpr const char *nonsense = "qqqqqqqqqqqqqqqqqqqqqqqq";

  /// What the reader offers in place of a key that is nothing like one.
  Names offered(const std::string &text)
  {
    for (const Diagnostic &message : messages_of(text))
      if (message.message.find(nonsense) != std::string::npos)
      {
        const std::size_t list = message.message.find("; known: ");
        EXPECT_NE(list, std::string::npos) << message.message;
        Names             names;
        const std::string words = message.message.substr(list + 9);
        const std::regex  word("[a-z_]+");
        for (std::sregex_iterator it(words.begin(), words.end(), word), end; it != end; ++it)
          names.insert(it->str());
        return names;
      }
    ADD_FAILURE() << "no message about an unknown key in\n" << text;
    return {};
  }

  Names keys_of(const std::string &table, const std::string &kind = "")
  {
    Names names;
    for (const KeyDescription &key : case_table(table).keys)
      if (key.name != KeyDescription::any_name && (kind.empty() || holds_for(key.kinds, kind)))
        names.insert(key.name);
    return names;
  }

  /// The names in backticks, or before a `=` in them.
  void add_names(const std::string &cell, const std::regex &name, Names &names)
  {
    const std::regex code("`([^`]*)`");
    for (std::sregex_iterator it(cell.begin(), cell.end(), code), end; it != end; ++it)
    {
      const std::string span = (*it)[1];
      for (std::sregex_iterator found(span.begin(), span.end(), name); found != end; ++found)
        names.insert((*found)[1]);
    }
  }

  struct Page
  {
    std::map<std::string, Names> keys; ///< by heading
    Names                        inner;
    std::string                  headings, text;
  };

  /// doc/case-file.md up to where it is about results.
  Page read_page()
  {
    Page             page;
    std::ifstream    file(PROJECT_DIR "/doc/case-file.md");
    std::string      line, heading, header;
    const std::regex whole("^([a-z_]+)$"), assigned("([a-z_]+) = ");
    while (std::getline(file, line) && line.find("## Setting keys") != 0)
    {
      page.text += line + "\n";
      if (line.find("## ") == 0)
      {
        heading = line.substr(3);
        page.headings += heading + "\n";
      }
      if (line.empty() || line.front() != '|')
        header.clear();
      else if (header.empty())
        header = line;
      else
      {
        const std::size_t first = line.find(" |");
        if (header.find("| key |") == 0)
          add_names(line.substr(0, first), whole, page.keys[heading]);
        add_names(line, assigned, page.inner);
      }
    }
    return page;
  }

  Names united(const std::vector<std::string> &tables)
  {
    Names all;
    for (const std::string &table : tables)
      all.merge(keys_of(table));
    return all;
  }
} // namespace

TEST(CaseSchema, the_reader_knows_every_key_of_the_specification)
{
  for (const TableDescription &table : case_tables())
    for (const KeyDescription &key : table.keys)
      for (const std::string &kind : kinds_of_problems())
        if (const auto text = case_with(kind, table.name, key.name, key.example);
            text && key.name != KeyDescription::any_name && holds_for(key.kinds, kind))
        {
          EXPECT_FALSE(is_unknown(key.name, *text)) << table.name << ", " << kind << "\n" << *text;
        }
}

TEST(CaseSchema, the_specification_has_every_key_that_the_reader_knows)
{
  for (const TableDescription &table : case_tables())
    for (const std::string &kind : kinds_of_problems())
    {
      const auto text = case_with(kind, table.name, nonsense, "1");
      if (!text || (table.name == "support" && kind != "beam"))
        continue;
      Names       known = offered(*text), specified = keys_of(table.name, kind);
      const Names sampled = {"raster", "profile", "run", "previous"};
      if (sampled.count(table.name) > 0)
        std::erase_if(known, [&](const std::string &key) { return key != table.name && sampled.count(key) > 0; }); // one reader for all
      if (table.name == "case")
        known.insert({"mesh", "model"});
      for (const std::string &key : specified)
        EXPECT_TRUE(known.count(key) > 0) << key << " is not known in " << table.name << " of kind " << kind;
      for (const std::string &key : known)
      {
        if (specified.count(key) > 0)
          continue;
        // Known, but of no use here: there must be an error.
        const auto &keys = table.keys;
        const auto  entry = std::find_if(keys.begin(), keys.end(), [&](const KeyDescription &k) { return k.name == key; });
        ASSERT_NE(entry, keys.end()) << key << " is not specified in " << table.name;
        EXPECT_FALSE(messages_of(*case_with(kind, table.name, key, entry->example)).empty())
          << key << " in " << table.name << " of " << kind;
      }
    }
}

TEST(CaseSchema, the_documentation_names_every_key_and_no_other)
{
  const Page                                            page = read_page();
  const std::map<std::string, std::vector<std::string>> tables = {{"[mesh] (required)", {"mesh", "mesh.local"}},
                                                                  {"[model] (required)", {"model"}},
                                                                  {"[[material]]", {"material"}},
                                                                  {"[[periodic]]", {"periodic"}},
                                                                  {"[[support]], [[point_load]]", {"support", "point_load"}},
                                                                  {"[[constraint]], or [constraint] for a single one", {"constraint"}},
                                                                  {"[method]", {"method"}},
                                                                  {"[exact]", {"exact"}},
                                                                  {"[output]", {"output"}},
                                                                  {"[[expect]]", {"expect"}}};
  for (const auto &[heading, names] : tables)
  {
    ASSERT_TRUE(page.keys.count(heading) > 0) << heading;
    Names specified = united(names);
    if (page.text.find("\n`[[mesh.local]]`") != std::string::npos)
      specified.erase("local"); // a table of its own
    EXPECT_EQ(page.keys.at(heading), specified) << heading;
  }
  const Names in_braces = {
    "membrane condition", "elastic condition", "bending condition", "ball", "shell", "surface", "plane", "sphere", "cylinder"};
  for (const TableDescription &table : case_tables())
    for (const KeyDescription &key : table.keys)
    {
      const bool in_a_table = page.keys.at("Top level").count(key.name) > 0;
      EXPECT_TRUE(table.name != "case" || in_a_table || page.headings.find("[" + key.name + "]") != std::string::npos) << key.name;
      EXPECT_TRUE(in_braces.count(table.name) == 0 || page.inner.count(key.name) > 0) << key.name << " of " << table.name;
    }
  Names samples = page.keys.at("Values");
  samples.insert({"raster", "profile", "run", "previous"});
  EXPECT_EQ(samples, united({"raster", "profile", "run", "previous"}));
}

TEST(CaseSchema, every_key_has_an_example_and_a_sentence)
{
  for (const TableDescription &table : case_tables())
    for (const KeyDescription &key : table.keys)
    {
      EXPECT_FALSE(key.example.empty()) << table.name << " " << key.name;
      EXPECT_TRUE(!key.description.empty() && (key.description.back() == '.')) << table.name << " " << key.name;
    }
}

TEST(CaseSchema, the_json_schema_has_defaults_and_hover_texts_and_refuses_unknown_keys)
{
  const auto json = json_schema();
  EXPECT_EQ(json["properties"]["mesh"]["description"].is_string(), true);
  EXPECT_EQ(json["definitions"]["mesh"]["properties"]["refine"]["default"], 0);
  EXPECT_EQ(json["definitions"]["method"]["properties"]["epsilon"]["default"], "auto");
  EXPECT_EQ(json["definitions"]["mesh"]["additionalProperties"], false);
  const auto keys = settable_keys();
  for (const std::string key : {"mesh.refine", "model.element", "constraint.0.lower", "method.epsilon", "mesh.ball.radius"})
    EXPECT_TRUE(std::find(keys.begin(), keys.end(), key) != keys.end()) << key;
}
