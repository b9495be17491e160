// The program as a user starts it: exit codes, files, what goes to which stream.
#include "program_in_folder.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <chrono>
#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>
#include <thread>
#include <vector>

#include <fcntl.h>
#include <sys/wait.h>
#include <unistd.h>

namespace
{
  namespace fs = std::filesystem;
  using Json = nlohmann::ordered_json;

  const std::string membrane = R"(title = "A loaded membrane above a plane"

[mesh]
box = [[-1, -1], [1, 1]]
cells = 4
refine = 2

[model]
kind = "membrane"
load = -10

[boundary]
all = 0

[constraint]
lower = -0.3

[output]
probes = [[0, 0]]
)";

  using program_in_folder::Outcome;
  using program_in_folder::read;
  using CommandLine = program_in_folder::ProgramInFolder;

  bool contains(const std::string &text, const std::string &part)
  {
    return text.find(part) != std::string::npos;
  }

  std::string last_line(std::string text)
  {
    while (!text.empty() && text.back() == '\n')
      text.pop_back();
    return text.substr(text.rfind('\n') + 1);
  }
} // namespace

TEST_F(CommandLine, version_and_help_need_nothing_else)
{
  const Outcome version = run({"--version"});
  EXPECT_EQ(version.exit_code, 0);
  EXPECT_TRUE(contains(version.out, "unilateral "));
  EXPECT_EQ(version.err, "");
  for (const std::vector<std::string> &arguments : {std::vector<std::string>{"--help"}, {"run", "--help"}, {"check", "--help"}})
  {
    const Outcome help = run(arguments);
    EXPECT_EQ(help.exit_code, 0);
    EXPECT_FALSE(help.out.empty());
    EXPECT_EQ(help.err, "");
  }
}

TEST_F(CommandLine, usage_errors_exit_with_2_and_say_why)
{
  write("case.toml", membrane);
  write("part.msh", "$MeshFormat\n");
  const std::vector<std::pair<std::vector<std::string>, std::string>> wrong = {
    {{}, "command"},
    {{"rnu", "case.toml"}, "run"},
    {{"case.toml"}, "unilateral run case.toml"},
    {{"run"}, "case file"},
    {{"run", "nowhere.toml"}, "nowhere.toml"},
    {{"run", "-"}, "standard input"},
    {{"check", "-"}, "standard input"},
    {{"expand", "-"}, "standard input"},
    {{"run", "case.toml", "other.toml"}, "other.toml"},
    {{"run", "case.toml", "--jsn"}, "--json"},
    {{"run", "case.toml", "--set", "mesh.refine"}, "KEY=VALUE"},
    {{"study", "quadrature", "case.toml", "--levels", "2"}, "'infsup', 'study mesh' have it"},
    {{"run", "case.toml", "--rules=nodal"}, "'study quadrature' has it"},
    {{"study", "mesh", "case.toml", "--leves", "2"}, "did you mean '--levels'?"},
    {{"study", "mash", "case.toml"}, "did you mean 'mesh'?"},
    {{"study", "case.toml"}, "what is to be studied?"},
    {{"sweep", "case.toml", "--over", "model.load=1:2"}, "--over model.load: error: FROM:TO:N is wanted"},
    {{"sweep", "case.toml", "--over", "mesh.refine=a:2:3"}, "FROM:TO:N is wanted"},
    {{"run", "case.toml", "--log", "no/such/folder/log"}, "no/such/folder/log"},
    {{"run", "case.toml", "-o", "case.toml"}, "case.toml"},
    {{"run", "case.toml", "-o", "case.toml/below/a/file"}, "another folder"},
    {{"run", "case.toml", "-o", "/proc/nothing-here"}, "another folder"},
    {{"run", "case.toml", "-o", std::string(300, 'x')}, "another folder"},
    {{"run", "case.toml", "-n", "0"}, "--processes"},
    {{"run", "case.toml", "-n", "9999"}, "start at most"},
    {{"run", "part.msh"}, "unilateral init KIND --mesh"},
    {{"run", "case.toml", "--foo"}, "unknown option '--foo'\n"},
    {{"sweep", "case.toml", "--over", "mesh.refine=1,2", "-o", "case.toml"}, "this is a file"},
    {{"sweep", "case.toml", "--over", "mesh.refine=1,2", "-o", "case.toml/below"}, "[cannot-write]"},
    {{"sweep", "case.toml", "--over", "mesh.refine=1,2", "-o", "/proc/nothing-here"}, "[cannot-write]"},
    {{"run", "case.toml", "--set", "model.kind=elastic"}, "did you mean 'elasticity'?"},
    {{"run", "case.toml", "--set", "model.load=3 kN"}, "numbers have none"},
  };
  for (const auto &[arguments, hint] : wrong)
  {
    const Outcome outcome = run(arguments);
    EXPECT_EQ(outcome.exit_code, 2) << hint;
    EXPECT_EQ(outcome.out, "") << hint;
    EXPECT_TRUE(contains(outcome.err, hint)) << outcome.err;
  }
}

TEST_F(CommandLine, run_leaves_every_file_in_the_folder_named_after_the_case)
{
  write("case.toml", membrane);
  const Outcome outcome = run({"run", "case.toml"});
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_EQ(files("case.out"),
            (std::vector<std::string>{"case.toml", "constraint-points.vtu", "report.html", "results.json", "run.log", "solution.vtu"}));
  EXPECT_TRUE(contains(last_line(outcome.out), "solved"));
  EXPECT_TRUE(contains(last_line(outcome.out), "case.out"));
  EXPECT_FALSE(contains(outcome.out + outcome.err, "\033")) << "colour or animation in a pipe";

  const Json results = Json::parse(read(work() / "case.out/results.json"));
  EXPECT_EQ(results["status"], "converged");
  EXPECT_NEAR(results["solution"]["probes"][0]["value"].get<double>(), -0.3, 1e-3);
  EXPECT_GT(results["constraint"][0]["total_contact_force"].get<double>(), 0);
}

TEST_F(CommandLine, the_log_holds_the_parameters_and_the_steps_even_when_quiet)
{
  write("case.toml", membrane);
  const Outcome outcome = run({"-q", "run", "case.toml", "--log", "live.log"});
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_EQ(outcome.out, "");
  EXPECT_EQ(outcome.err, "");
  const std::string log = read(work() / "case.out/run.log");
  EXPECT_TRUE(contains(log, "tolerance"));
  EXPECT_TRUE(contains(log, "Newton"));
  EXPECT_EQ(log, read(work() / "live.log"));
}

TEST_F(CommandLine, json_alone_is_on_standard_output)
{
  write("case.toml", membrane);
  const Outcome outcome = run({"run", "case.toml", "--json", "-v", "-o", "there"});
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  ASSERT_TRUE(Json::accept(outcome.out)) << outcome.out;
  EXPECT_EQ(outcome.out, read(work() / "there/results.json"));
  EXPECT_TRUE(contains(outcome.err, "solved"));
}

TEST_F(CommandLine, set_overrides_the_case)
{
  write("case.toml", membrane);
  const Outcome outcome = run({"run", "--set", "mesh.refine=1", "--set", "model.load=-20", "case.toml", "--json", "-q"});
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  ASSERT_TRUE(Json::accept(outcome.out)) << outcome.err;
  EXPECT_EQ(Json::parse(outcome.out)["mesh"]["n_cells"], 64);
  EXPECT_TRUE(contains(read(work() / "case.out/case.toml"), "-20"));
}

TEST_F(CommandLine, the_expanded_case_gives_the_same_results)
{
  write("case.toml", membrane);
  const Outcome expanded = run({"expand", "case.toml"});
  EXPECT_EQ(expanded.exit_code, 0) << expanded.err;
  write("expanded.toml", expanded.out);
  EXPECT_EQ(run({"expand", "expanded.toml"}).out, expanded.out);

  Json a = Json::parse(run({"run", "case.toml", "--json", "-q"}).out), b = Json::parse(run({"run", "expanded.toml", "--json", "-q"}).out);
  for (Json *const json : {&a, &b})
    for (const char *const key : {"case", "timing", "memory"})
      json->erase(key);
  EXPECT_EQ(a, b);
}

TEST_F(CommandLine, bad_input_exits_with_2_with_places_and_leaves_no_folder)
{
  write("case.toml", membrane + "colour = 1\n[boundry]\nall = 0\n");
  for (const std::vector<std::string> &arguments :
       {std::vector<std::string>{"run", "case.toml"}, {"run", "case.toml", "--json"}, {"check", "case.toml"}})
  {
    const Outcome outcome = run(arguments);
    EXPECT_EQ(outcome.exit_code, 2);
    EXPECT_EQ(outcome.out, "");
    EXPECT_TRUE(contains(outcome.err, "case.toml:20:1: error: ")) << outcome.err;
    EXPECT_TRUE(contains(outcome.err, "boundary")) << outcome.err;
  }
  EXPECT_FALSE(fs::exists(work() / "case.out"));
}

TEST_F(CommandLine, an_unknown_part_is_bad_input_too)
{
  write("case.toml", membrane + "\n[[material]]\nregion = \"nowhere\"\nstiffness = 2\n");
  const Outcome outcome = run({"run", "case.toml"});
  EXPECT_EQ(outcome.exit_code, 2);
  EXPECT_TRUE(contains(outcome.err, "nowhere")) << outcome.err;
  EXPECT_FALSE(fs::exists(work() / "case.out"));
}

TEST_F(CommandLine, a_failed_expectation_exits_with_4_and_keeps_the_results)
{
  write("case.toml", membrane + "\n[[expect]]\nquantity = \"solution.energy\"\nmin = 1e6\n");
  const Outcome outcome = run({"run", "case.toml"});
  EXPECT_EQ(outcome.exit_code, 4) << outcome.err;
  EXPECT_TRUE(contains(outcome.out + outcome.err, "solution.energy"));
  const Json results = Json::parse(read(work() / "case.out/results.json"));
  EXPECT_EQ(results["status"], "converged");
  EXPECT_EQ(results["expect"][0]["passed"], false);
}

TEST_F(CommandLine, an_expectation_of_nothing_is_bad_input_before_anything_is_solved)
{
  write("case.toml", membrane + "\n[[expect]]\nquantity = \"solution.enrgy\"\nmin = 0\n");
  for (const std::string command : {"run", "check", "expand"})
  {
    const Outcome outcome = run({command, "case.toml", "-q"});
    EXPECT_EQ(outcome.exit_code, 2);
    EXPECT_TRUE(contains(outcome.err, "case.toml:22:12: error: ") && contains(outcome.err, "did you mean 'energy'?")) << outcome.err;
  }
  EXPECT_FALSE(fs::exists(work() / "case.out"));
}

TEST_F(CommandLine, a_quiet_run_still_says_what_failed)
{
  write("expect.toml", membrane + "\n[[expect]]\nquantity = \"solution.energy\"\nmin = 1e6\n");
  const Outcome expectation = run({"run", "expect.toml", "-q"});
  EXPECT_EQ(expectation.exit_code, 4);
  EXPECT_EQ(expectation.out, "");
  EXPECT_TRUE(contains(expectation.err, "expect.toml:22:12: error: solution.energy = -")) << expectation.err;

  write("certificate.toml", membrane + "\n[method]\nepsilon = 1\npenalty_tolerance = 1e-6\n");
  const Outcome certificate = run({"run", "certificate.toml", "-q"});
  EXPECT_EQ(certificate.exit_code, 4);
  EXPECT_TRUE(contains(certificate.err, "certificate does not hold")) << certificate.err;
}

TEST_F(CommandLine, a_mesh_beyond_the_memory_is_refused_at_once)
{
  // 10^12 bytes of memory at least, and more than a test machine has.
  write("case.toml",
        "[mesh]\nbox = [[0, 0, 0], [1, 1, 1]]\ncells = [100000, 1000, 9]\n[model]\nkind = \"membrane\"\nload = 1\n[boundary]\nall = 0\n"
        "[constraint]\nupper = 1\n");
  for (const std::string command : {"run", "check"})
  {
    const Outcome outcome = run({command, "case.toml", "-q"});
    EXPECT_EQ(outcome.exit_code, 2);
    EXPECT_TRUE(contains(outcome.err, "case.toml:3:9: error: ") && contains(outcome.err, "GB")) << outcome.err;
  }
}

TEST_F(CommandLine, no_convergence_exits_with_3_and_writes_the_last_state)
{
  write("case.toml", membrane);
  // On one mesh, since from level to level a step each can do.
  const Outcome outcome =
    run({"run", "case.toml", "--set", "method.max_iterations=1", "--set", "mesh.cells=16", "--set", "mesh.refine=0", "-q"});
  EXPECT_EQ(outcome.exit_code, 3) << outcome.err;
  EXPECT_TRUE(contains(last_line(outcome.err), "not converged")) << outcome.err;
  EXPECT_EQ(Json::parse(read(work() / "case.out/results.json"))["status"], "not_converged");
  EXPECT_TRUE(fs::exists(work() / "case.out/solution.vtu"));
}

TEST_F(CommandLine, numbers_that_were_not_computed_are_not_shown)
{
  write("case.toml", membrane);
  const Outcome outcome = run({"run", "case.toml", "--set", "model.load=1e300"});
  EXPECT_EQ(outcome.exit_code, 3) << outcome.err;
  EXPECT_FALSE(contains(outcome.out + outcome.err, "nan")) << outcome.out;
  EXPECT_TRUE(contains(last_line(outcome.err), "beyond the range of floating-point arithmetic; choose other units")) << outcome.err;
}

TEST_F(CommandLine, studies_write_their_tables)
{
  write("case.toml", membrane);
  const auto study = [&](std::vector<std::string> words)
  {
    words.insert(words.end(), {"--set", "mesh.refine=1", "--json"});
    const Outcome outcome = run(words);
    EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
    return Json::parse(outcome.out);
  };
  const Json epsilon = study({"study", "epsilon", "case.toml", "--from", "1e-2", "--to", "1e-6", "--points", "3"});
  ASSERT_EQ(epsilon["rows"].size(), 3u);
  EXPECT_DOUBLE_EQ(epsilon["rows"][1]["epsilon"].get<double>(), 1e-4);
  EXPECT_TRUE(epsilon["holds"]["theorem3_u"].get<bool>());
  EXPECT_GT(epsilon["constants"]["C_h"].get<double>(), 0);
  EXPECT_EQ(study({"study", "epsilon", "case.toml", "--values", "1e-3"})["rows"].size(), 1u);
  const Json mesh = study({"study", "mesh", "case.toml", "--levels", "3"});
  EXPECT_EQ(mesh["rows"].size(), 3u);
  EXPECT_EQ(mesh["rates"]["difference_L2"].size(), 2u);
  const Json quadrature = study({"study", "quadrature", "case.toml", "--rules", "nodal, gauss(2)"});
  EXPECT_EQ(quadrature["rows"][1]["verdict"], "kernel");
  EXPECT_EQ(files("case.out"), (std::vector<std::string>{"report.html", "study_epsilon.csv", "study_epsilon.json", "study_mesh.csv",
                                                         "study_mesh.json", "study_quadrature.csv", "study_quadrature.json"}));
}

TEST_F(CommandLine, studies_name_the_files_that_they_write)
{
  write("case.toml", membrane);
  for (const std::vector<std::string> &study : {std::vector<std::string>{"study", "epsilon", "--values", "1e-3"},
                                                {"study", "mesh", "--levels", "2"},
                                                {"study", "quadrature"},
                                                {"study", "mesh", "--levels", "2", "--adaptive", "--latex"},
                                                {"infsup", "--levels", "2"}})
  {
    std::vector<std::string> words = study;
    words.insert(words.end(), {"case.toml", "-o", "studied", "--set", "mesh.cells=3"});
    fs::remove_all(work() / "studied");
    const Outcome outcome = run(words);
    EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
    EXPECT_TRUE(contains(last_line(outcome.out), "results in studied: ")) << outcome.out;
    for (const std::string &file : files("studied"))
      EXPECT_TRUE(contains(last_line(outcome.out), " " + file)) << file << "\n" << outcome.out;
  }
}

TEST_F(CommandLine, tables_of_studies_have_no_column_without_an_entry)
{
  write("case.toml", membrane);
  const Outcome one = run({"study", "mesh", "case.toml", "--levels", "1"});
  EXPECT_FALSE(contains(one.out, "rate")) << one.out;
  EXPECT_FALSE(contains(one.out, "difference_L2")) << one.out;
  EXPECT_TRUE(contains(read(work() / "case.out/study_mesh.csv"), "rate_penalty_error_bound"));
  const Outcome two = run({"study", "mesh", "case.toml", "--levels", "2"});
  EXPECT_TRUE(contains(two.out, "difference_L2")) << two.out;
  // A body that contact holds has no bound by Theorem 3.
  write("body.toml",
        "mesh.box = [[0, 0], [1, 1]]\nmesh.cells = 2\nmodel = { kind = \"elasticity\", young = 1, poisson = 0.3, load = [0, -1] }\n"
        "boundary.left = \"symmetry\"\nconstraint = { on = \"bottom\", gap = 0 }\n");
  const Outcome body = run({"study", "epsilon", "body.toml", "--values", "1e-2,1e-3"});
  EXPECT_EQ(body.exit_code, 0) << body.err;
  EXPECT_FALSE(contains(body.out, "bound (22)")) << body.out;
  EXPECT_TRUE(contains(body.out, "penetration")) << body.out;
}

TEST_F(CommandLine, infsup_tells_that_settings_of_the_mesh_change_nothing)
{
  write("case.toml", membrane);
  const Outcome refined = run({"infsup", "case.toml", "--levels", "2", "--set", "mesh.refine=4"});
  EXPECT_EQ(refined.exit_code, 0) << refined.err;
  EXPECT_TRUE(contains(refined.err, "warning: 'mesh.refine' changes nothing here")) << refined.err;
  EXPECT_TRUE(contains(refined.err, "--levels")) << refined.err;
  EXPECT_EQ(run({"infsup", "case.toml", "--levels", "2", "--set", "mesh.cells=3"}).err, "");
}

TEST_F(CommandLine, studies_refuse_what_they_cannot_read)
{
  write("case.toml", membrane);
  const std::vector<std::vector<std::string>> mistakes = {{"study"},
                                                          {"study", "epsilon"},
                                                          {"study", "nothing", "case.toml"},
                                                          {"study", "epsilon", "case.toml", "--values", "1e-3,x"},
                                                          {"study", "epsilon", "case.toml", "--values", "-1"},
                                                          {"study", "epsilon", "case.toml", "--from", "1"},
                                                          {"study", "quadrature", "case.toml", "--rules", "nodle"},
                                                          {"study", "quadrature", "case.toml", "--rules", ""},
                                                          {"study", "quadrature", "case.toml", "--rules", "edges"},
                                                          {"study", "epsilon", "case.toml", "--from", "nan", "--to", "1"},
                                                          {"study", "mesh", "case.toml", "--epsilon", "nan"},
                                                          {"study", "mesh", "case.toml", "--power", "2000"},
                                                          {"infsup", "case.toml", "--zone", "x > 5"},
                                                          {"study", "mesh", "case.toml", "--epsilon", "0"}};
  for (const auto &words : mistakes)
    EXPECT_EQ(run(words).exit_code, 2) << words.back();
  EXPECT_FALSE(fs::exists(work() / "case.out"));
}

TEST_F(CommandLine, a_study_with_rows_that_did_not_converge_exits_with_3)
{
  write("case.toml", membrane);
  for (const std::string kind : {"mesh", "quadrature"})
  {
    const Outcome outcome = run({"study", kind, "case.toml", "--set", "method.max_iterations=1", "-q"});
    EXPECT_EQ(outcome.exit_code, 3) << outcome.err;
    EXPECT_TRUE(contains(last_line(outcome.err), "not converged")) << outcome.err;
  }
}

TEST_F(CommandLine, infsup_judges_the_rule_and_writes_its_table)
{
  write("case.toml", membrane);
  const auto verdict = [&](const std::string &rule)
  {
    const Outcome outcome =
      run({"infsup", "case.toml", "--levels", "3", "--json", "--set", "constraint.quadrature=" + rule, "--zone", "x > 0"});
    EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
    const Json json = Json::parse(outcome.out);
    EXPECT_EQ(json["rows"].size(), 3u);
    EXPECT_EQ(json["zone_rows"].size(), 3u);
    EXPECT_EQ(files("case.out"), (std::vector<std::string>{"infsup-mode.vtu", "infsup.csv", "infsup.json", "report.html"}));
    return json["verdict"].get<std::string>();
  };
  EXPECT_EQ(verdict("nodal"), "stable");
  EXPECT_EQ(verdict("midpoint"), "weakly unstable");
  EXPECT_EQ(verdict("gauss(2)"), "kernel");
  EXPECT_EQ(run({"infsup", "case.toml", "--zone", "x > foo"}).exit_code, 2);
}

TEST_F(CommandLine, check_shows_the_gap_and_solves_nothing)
{
  write("case.toml", membrane);
  const Outcome outcome = run({"check", "case.toml"});
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_EQ(files("."), std::vector<std::string>{"case.toml"});

  const Json report = Json::parse(run({"check", "case.toml", "--json"}).out);
  EXPECT_EQ(report["mesh"]["parts"], (Json{"left", "right", "bottom", "top"}));
  ASSERT_EQ(report["constraint"].size(), 1u);
  EXPECT_NEAR(report["constraint"][0]["gap_min"].get<double>(), 0.3, 1e-12);
  EXPECT_EQ(report["constraint"][0]["share_violated"], 0);
}

TEST_F(CommandLine, check_tells_parts_apart)
{
  write("case.toml",
        "[mesh]\nbox = [[0, 0], [2, 1]]\ncells = [4, 1]\nrefine = 1\n[model]\nkind = \"elasticity\"\nyoung = 1\npoisson = 0.3\n"
        "[[part]]\nname = \"foot\"\nwhere = \"y < 1e-6 && x < 0.5\"\n[boundary]\nfoot = \"clamped\"\n");
  const Json boundary = Json::parse(run({"check", "case.toml", "--json"}).out)["mesh"]["boundary"];
  ASSERT_EQ(boundary.size(), 5u);
  EXPECT_EQ(boundary[4]["part"], "foot");
  EXPECT_EQ(boundary[4]["n_faces"], 2);
  EXPECT_NEAR(boundary[4]["measure"].get<double>(), 0.5, 1e-12);
  EXPECT_NEAR(boundary[4]["centre"][0].get<double>(), 0.25, 1e-12);
  EXPECT_NEAR(boundary[4]["normal"][1].get<double>(), -1, 1e-12);
  EXPECT_NEAR(boundary[2]["measure"].get<double>(), 1.5, 1e-12) << "what is left of the bottom";
  EXPECT_NE(run({"check", "case.toml"}).out.find("(0.25, 0)"), std::string::npos);
}

TEST_F(CommandLine, an_interrupt_exits_with_130_and_touches_no_earlier_results)
{
  write("case.toml", membrane);
  ASSERT_EQ(run({"run", "case.toml", "-q"}).exit_code, 0);
  const std::string earlier = read(work() / "case.out/results.json");
  const auto        earlier_files = files("case.out");
  ASSERT_EQ(earlier_files.size(), 6u);

  for (const int signal : {SIGINT, SIGTERM})
  {
    const std::string log = "log" + std::to_string(signal);
    const pid_t       child = start({"run", "case.toml", "--set", "mesh.refine=8", "--log", log});
    for (unsigned tenths = 0; tenths < 300 && !contains(read(work() / log), "Newton"); ++tenths)
      std::this_thread::sleep_for(std::chrono::milliseconds(100));
    kill(child, signal);
    const Outcome outcome = finish(child);
    EXPECT_EQ(outcome.exit_code, 130) << outcome.err;
    EXPECT_TRUE(contains(last_line(outcome.err), "interrupted"));
    EXPECT_EQ(read(work() / "case.out/results.json"), earlier);
    // Beside the earlier results there is at most what --resume goes on with, depending on where the signal met the run.
    auto names = files("case.out");
    std::erase_if(names, [](const std::string &name) { return name.starts_with("restart"); });
    EXPECT_EQ(names, earlier_files);
  }
}

TEST_F(CommandLine, a_crash_ends_with_a_sentence)
{
  write("case.toml", membrane);
  const pid_t child = start({"run", "case.toml", "--set", "mesh.refine=8", "--log", "log"});
  for (unsigned tenths = 0; tenths < 300 && !contains(read(work() / "log"), "Newton"); ++tenths)
    std::this_thread::sleep_for(std::chrono::milliseconds(100));
  kill(child, SIGSEGV);
  const Outcome outcome = finish(child);
  EXPECT_EQ(outcome.exit_code, 1);
  EXPECT_TRUE(contains(outcome.err, "internal error")) << outcome.err;
  EXPECT_EQ(std::count(outcome.err.begin(), outcome.err.end(), '\n'), 1) << outcome.err;
}

TEST_F(CommandLine, parameters_that_only_an_option_uses_are_used)
{
  write("case.toml", "[parameters]\nedge = 0.5\n" + membrane.substr(membrane.find("[mesh]")));
  const std::string warning = "nothing in the case uses the parameter";
  EXPECT_TRUE(contains(run({"expand", "case.toml"}).err, warning));
  EXPECT_TRUE(contains(run({"infsup", "case.toml", "--levels", "2", "--zone", "x > 0.5"}).err, warning));
  EXPECT_FALSE(contains(run({"infsup", "case.toml", "--levels", "2", "--zone", "x > edge"}).err, warning));
  EXPECT_TRUE(contains(run({"sweep", "case.toml", "--over", "model.load=-10,-20"}).err, warning));
  EXPECT_FALSE(contains(run({"sweep", "case.toml", "--over", "model.load=-10,\"-20*edge\""}).err, warning));
}

TEST_F(CommandLine, output_that_cannot_be_written_is_told_plainly)
{
  write("case.toml", membrane);
  const std::string command = "cd '" + work().string() + "' && " PROGRAM " expand case.toml >/dev/full 2>err";
  EXPECT_EQ(WEXITSTATUS(std::system(command.c_str())), 1);
  EXPECT_FALSE(read(work() / "err").empty());
}

TEST_F(CommandLine, the_results_are_complete_whoever_listens)
{
  write("case.toml", membrane);
  const auto shell = [&](const std::string &command)
  {
    fs::remove_all(work() / "case.out");
    const int status = std::system(("cd '" + work().string() + "' && exec 2>err && " + command).c_str());
    return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
  };
  const std::string run_case = PROGRAM " run case.toml", status = "; echo $? >status", no_reader = " | true";
  const auto        piped = [&](const std::string &options) // the exit code of the program, not of its reader
  {
    shell("{ sleep 0.2; " + run_case + options + status + "; }" + no_reader);
    return std::stoi(read(work() / "status"));
  };
  for (const std::string options : {"", " -v", " --json"})
  {
    EXPECT_EQ(piped(options), 0) << options << read(work() / "err");
    EXPECT_EQ(files("case.out").size(), 6u) << options;
  }
  for (const std::string stream : {" >/dev/full", " >&-"})
  {
    EXPECT_EQ(shell(run_case + stream), 0) << read(work() / "err");
    EXPECT_EQ(files("case.out").size(), 6u);
    EXPECT_EQ(shell(run_case + " --json" + stream), 1);
    EXPECT_TRUE(contains(read(work() / "err"), "standard output")) << read(work() / "err");
    EXPECT_EQ(files("case.out").size(), 6u);
    EXPECT_EQ(shell(PROGRAM " check case.toml" + stream), 1);
    EXPECT_EQ(shell(PROGRAM " expand case.toml" + stream), 1);
  }
}

TEST_F(CommandLine, results_that_cannot_be_written_are_told_plainly)
{
  write("case.toml", membrane);
  fs::create_directories(work() / "case.out/results.json/in-the-way");
  const Outcome outcome = run({"run", "case.toml"});
  EXPECT_EQ(outcome.exit_code, 1);
  EXPECT_TRUE(contains(outcome.err, "results.json")) << outcome.err;
  EXPECT_FALSE(contains(outcome.err, "internal error")) << outcome.err;
}

TEST_F(CommandLine, pictures_and_reports_that_cannot_be_written_are_bad_input)
{
  write("case.toml", membrane);
  ASSERT_EQ(run({"run", "case.toml", "-q"}).exit_code, 0);
  for (const std::vector<std::string> &arguments : {std::vector<std::string>{"picture", "case.out", "-o", "nowhere/x.svg"},
                                                    {"picture", "case.out", "-o", "/proc/x.svg"},
                                                    {"report", "case.out", "case.out", "-o", "nowhere/x.html"},
                                                    {"report", "case.out", "case.out", "-o", "case.out"}})
  {
    const Outcome outcome = run(arguments);
    EXPECT_EQ(outcome.exit_code, 2) << arguments[3];
    EXPECT_TRUE(contains(outcome.err, "[cannot-write]")) << outcome.err;
  }
}

TEST_F(CommandLine, a_kind_that_does_not_exist_is_the_only_thing_complained_of)
{
  write("case.toml", membrane);
  const Outcome outcome = run({"check", "case.toml", "--set", "model.kind=shell", "--set", "model.young=1"});
  EXPECT_EQ(outcome.exit_code, 2);
  EXPECT_TRUE(contains(outcome.err, "unknown kind 'shell'")) << outcome.err;
  EXPECT_EQ(std::count(outcome.err.begin(), outcome.err.end(), '\n'), 1) << outcome.err;
}

TEST_F(CommandLine, works_without_a_folder_for_temporary_files)
{
  write("case.toml", membrane);
  const std::string command = "cd '" + work().string() + "' && TMPDIR=/proc/nowhere " PROGRAM " run case.toml -q </dev/null >out 2>err";
  EXPECT_EQ(std::system(command.c_str()), 0);
  EXPECT_EQ(read(work() / "out") + read(work() / "err"), "");
}

TEST_F(CommandLine, works_without_a_home_a_terminal_or_an_environment)
{
  write("case.toml", membrane);
  const std::string command = "cd '" + work().string() + "' && env -i " PROGRAM " run case.toml -q </dev/null >out 2>err";
  EXPECT_EQ(std::system(command.c_str()), 0);
  EXPECT_EQ(read(work() / "out") + read(work() / "err"), "");
}
