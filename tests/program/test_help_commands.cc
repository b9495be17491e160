// init, completion, explain and the manual pages, as a user meets them.
#include "program_in_folder.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <regex>
#include <sstream>

namespace
{
  using program_in_folder::Outcome;
  using program_in_folder::read;
  namespace fs = std::filesystem;

  class HelpCommands : public program_in_folder::ProgramInFolder
  {
  protected:
    std::vector<std::string> lines_of(const std::vector<std::string> &arguments) const
    {
      std::istringstream       text(run(arguments).out);
      std::vector<std::string> lines;
      for (std::string line; std::getline(text, line);)
        lines.push_back(line);
      return lines;
    }

    /// The cases that init lists.
    std::vector<std::string> cases() const
    {
      std::vector<std::string> names;
      const std::regex         entry("^  ([a-z]+) +.*");
      std::smatch              match;
      for (const std::string &line : lines_of({"init"}))
        if (std::regex_match(line, match, entry))
          names.push_back(match[1]);
      return names;
    }

    /// What bash offers after these words, the last of which is being typed.
    std::string offered(const std::vector<std::string> &words) const
    {
      std::string list;
      for (const std::string &word : words)
        list += " '" + word + "'";
      write("ask", "PATH=$PATH:" + fs::path(PROGRAM).parent_path().string() + "\nsource ./completion.bash\nCOMP_WORDS=(" + list +
                     ")\nCOMP_CWORD=$((${#COMP_WORDS[@]} - 1))\n_unilateral\nfor word in \"${COMPREPLY[@]}\"; do echo \"<$word>\"; done\n");
      const int status = std::system(("cd '" + work().string() + "' && bash ask > answer 2> errors").c_str());
      EXPECT_EQ(status, 0);
      EXPECT_EQ(read(work() / "errors"), "");
      return read(work() / "answer");
    }
  };

  bool contains(const std::string &text, const std::string &part)
  {
    return text.find(part) != std::string::npos;
  }
} // namespace

TEST_F(HelpCommands, every_case_of_init_runs_as_it_is_written)
{
  const auto names = cases();
  EXPECT_GE(names.size(), 10u);
  for (const std::string &name : names)
  {
    EXPECT_EQ(run({"init", name}).exit_code, 0) << name;
    const Outcome outcome = run({"run", name + ".toml", "-q"});
    EXPECT_EQ(outcome.exit_code, 0) << name << "\n" << outcome.err;
  }
}

TEST_F(HelpCommands, init_overwrites_nothing)
{
  write("beam.toml", "mine");
  const Outcome outcome = run({"init", "beam"});
  EXPECT_EQ(outcome.exit_code, 2);
  EXPECT_TRUE(contains(outcome.err, "beam.toml"));
  EXPECT_EQ(read(work() / "beam.toml"), "mine");
  EXPECT_EQ(run({"init", "beam", "second.toml"}).exit_code, 0);
  EXPECT_TRUE(fs::exists(work() / "second.toml"));
}

TEST_F(HelpCommands, init_prints_a_case_where_a_dash_stands_for_the_file)
{
  const Outcome outcome = run({"init", "beam", "-"});
  EXPECT_EQ(outcome.exit_code, 0);
  EXPECT_TRUE(contains(outcome.out, "kind")) << outcome.out;
  EXPECT_FALSE(fs::exists(work() / "-"));
  ASSERT_EQ(run({"init", "beam"}).exit_code, 0);
  EXPECT_EQ(read(work() / "beam.toml"), outcome.out);
}

TEST_F(HelpCommands, init_suggests_the_nearest_case)
{
  const Outcome outcome = run({"init", "membran"});
  EXPECT_EQ(outcome.exit_code, 2);
  EXPECT_TRUE(contains(outcome.err, "'membrane'"));
  EXPECT_TRUE(files().empty());
}

TEST_F(HelpCommands, init_lists_the_parts_of_a_mesh_and_the_case_runs)
{
  write_copy(PROJECT_DIR "/examples/data/plate-with-hole.msh", "part.msh");
  for (const std::string kind : {"membrane", "elasticity", "plate"})
  {
    ASSERT_EQ(run({"init", kind, "--mesh", "part.msh"}).exit_code, 0) << kind;
    const std::string text = read(work() / (kind + ".toml"));
    const auto        check = nlohmann::json::parse(run({"check", kind + ".toml", "--json"}).out);
    EXPECT_FALSE(check["mesh"]["parts"].empty());
    for (const std::string part : check["mesh"]["parts"])
      EXPECT_TRUE(contains(text, "\n" + part + " = ")) << text;
    for (const std::string region : check["mesh"]["regions"])
      EXPECT_TRUE(contains(text, region)) << text;
    const Outcome outcome = run({"run", kind + ".toml", "-q"});
    EXPECT_EQ(outcome.exit_code, 0) << outcome.err << text;
  }
  EXPECT_EQ(run({"init", "beam", "--mesh", "part.msh"}).exit_code, 2);
  EXPECT_EQ(run({"init", "hertz", "--mesh", "part.msh"}).exit_code, 2);
  EXPECT_EQ(run({"init", "membrane", "other.toml", "--mesh", "missing.msh"}).exit_code, 2);
  EXPECT_FALSE(fs::exists(work() / "other.toml"));
}

TEST_F(HelpCommands, bash_completes_commands_options_cases_keys_and_names)
{
  write("completion.bash", run({"completion", "bash"}).out);
  write("a case.toml", "");
  write("notes.txt", "");
  fs::create_directory(work() / "ball.out");
  EXPECT_EQ(offered({"unilateral", "ru"}), "<run>\n");
  EXPECT_EQ(offered({"unilateral", "study", "qu"}), "<quadrature>\n");
  EXPECT_EQ(offered({"unilateral", "run", "a"}), "<a case.toml>\n");
  EXPECT_FALSE(contains(offered({"unilateral", "run", ""}), "notes.txt"));
  EXPECT_EQ(offered({"unilateral", "run", "case.toml", "--out"}), "<--output>\n");
  EXPECT_EQ(offered({"unilateral", "study", "mesh", "case.toml", "--pow"}), "<--power>\n");
  EXPECT_EQ(offered({"unilateral", "run", "case.toml", "--set", "mesh.ref"}), "<mesh.refine=>\n");
  EXPECT_EQ(offered({"unilateral", "--set", "mesh.refine=3", "chec"}), "<check>\n");
  EXPECT_EQ(offered({"unilateral", "init", "hert"}), "<hertz>\n");
  EXPECT_EQ(offered({"unilateral", "explain", "unknown-k"}), "<unknown-key>\n");
  EXPECT_EQ(offered({"unilateral", "completion", "fi"}), "<fish>\n");
  EXPECT_EQ(offered({"unilateral", "run", "case.toml", "--levels"}), "");
  EXPECT_EQ(offered({"unilateral", "picture", "ba"}), "<ball.out>\n");
  EXPECT_EQ(offered({"unilateral", "sweep", "case.toml", "--over", "mesh.ref"}), "<mesh.refine=>\n");
}

TEST_F(HelpCommands, zsh_and_fish_can_read_their_completions)
{
  for (const std::string shell : {"zsh", "fish"})
  {
    const Outcome outcome = run({"completion", shell});
    EXPECT_EQ(outcome.exit_code, 0);
    EXPECT_TRUE(contains(outcome.out, "mesh.refine="));
    write("completion", outcome.out);
    if (std::system(("command -v " + shell + " > /dev/null").c_str()) == 0)
    {
      EXPECT_EQ(std::system((shell + " -n '" + (work() / "completion").string() + "'").c_str()), 0) << shell;
    }
  }
  EXPECT_EQ(run({"completion", "tcsh"}).exit_code, 2);
  EXPECT_EQ(run({"completion"}).exit_code, 2);
}

TEST_F(HelpCommands, explain_tells_of_every_name_that_it_lists)
{
  const auto list = nlohmann::json::parse(run({"explain", "--json"}).out);
  EXPECT_GT(list.size(), 40u);
  for (const std::string name : {"unknown-key", "[unknown-key]", "weakly unstable"})
  {
    const Outcome outcome = run({"explain", name});
    EXPECT_EQ(outcome.exit_code, 0);
    EXPECT_TRUE(contains(outcome.out, "Remedy")) << outcome.out;
  }
  const Outcome outcome = run({"explain", "unknown-kye"});
  EXPECT_EQ(outcome.exit_code, 2);
  EXPECT_TRUE(contains(outcome.err, "'unknown-key'"));
}

TEST_F(HelpCommands, manual_pages_are_roff_and_name_every_command)
{
  for (const std::string page : {"unilateral", "unilateral-case"})
  {
    const Outcome outcome = run({"manual", page});
    ASSERT_EQ(outcome.exit_code, 0);
    write(page, outcome.out);
    if (std::system("command -v groff > /dev/null") == 0)
    {
      EXPECT_EQ(
        std::system(
          ("groff -ww -man -Tascii '" + (work() / page).string() + "' > /dev/null 2> '" + (work() / "errors").string() + "'").c_str()),
        0);
      EXPECT_EQ(read(work() / "errors"), "");
    }
  }
  const std::string page = read(work() / "unilateral");
  for (const std::string command : {"run", "check", "expand", "infsup", "study mesh", "init", "schema", "explain", "completion"})
    EXPECT_TRUE(contains(page, ".SS " + command)) << command;
}
