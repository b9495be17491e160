// Load histories and solutions as fields, as a user starts them.
#include "program_in_folder.h"

#include <nlohmann/json.hpp>

#include <chrono>
#include <cmath>
#include <csignal>
#include <cstdlib>
#include <regex>
#include <thread>

namespace
{
  using namespace program_in_folder;
  using Json = nlohmann::ordered_json;

  const std::string string_case = R"([parameters]
f = 1
[steps]
f = [0.4, 1.6, 3.2]
[mesh]
box = [[0], [1]]
cells = 16
refine = 2
[model]
kind = "membrane"
load = "-f"
[boundary]
all = 0
[constraint]
lower = -0.1
)";

  /// What this process has of MPI would tell mpirun that it was started by another one.
  void without_mpi()
  {
    std::vector<std::string> names;
    for (char **entry = environ; *entry != nullptr; ++entry)
      if (const std::string text = *entry; text.starts_with("OMPI_") || text.starts_with("PMIX_"))
        names.push_back(text.substr(0, text.find('=')));
    for (const std::string &name : names)
      unsetenv(name.c_str());
    setenv("OMPI_MCA_btl_vader_single_copy_mechanism", "none", 1);
  }

  class LoadHistory : public ProgramInFolder
  {
  protected:
    Json json(const std::string &file) const { return Json::parse(read(work() / file)); }
  };

  using Names = std::vector<std::string>;

  TEST_F(LoadHistory, LeavesAFolderForEachStepATableAndTheNumbersOfTheLast)
  {
    write("case.toml", string_case);
    const Outcome outcome = run({"run", "case.toml"});
    ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
    EXPECT_EQ(files("case.out"),
              (Names{"case.toml", "constraint-points.pvd", "constraint-points.vtu", "report.html", "results.json", "run.log",
                     "solution.pvd", "solution.vtu", "step-001", "step-002", "step-003", "step_history.csv"}));
    EXPECT_EQ(files("case.out/step-002"), (Names{"constraint-points.vtu", "results.json", "solution.vtu"}));
    const Json results = json("case.out/results.json");
    ASSERT_EQ(results["steps"].size(), 3u);
    EXPECT_EQ(results["steps"][2]["constraint"], results["constraint"]);
    EXPECT_EQ(results["steps"][1]["constraint"], json("case.out/step-002/results.json")["constraint"]);
    EXPECT_EQ(results["steps"][1]["parameters"]["f"], 1.6);
    EXPECT_NEAR(results["constraint"][0]["total_contact_force"].get<double>(), 1.6, 0.02);
    const std::string table = read(work() / "case.out/step_history.csv");
    EXPECT_EQ(std::count(table.begin(), table.end(), '\n'), 4);
    EXPECT_EQ(table.find("step,f,constraint.0.total_contact_force,"), 0u) << table;
    EXPECT_NE(read(work() / "case.out/solution.pvd").find("timestep=\"3.2\" file=\"step-003/solution.vtu\""), std::string::npos);
    const std::string page = read(work() / "case.out/report.html");
    EXPECT_NE(page.find("<section id=\"steps\">"), std::string::npos);
    EXPECT_NE(page.find("step 2: f = 1.6"), std::string::npos);
    EXPECT_EQ(run({"report", "case.out/step-002"}).exit_code, 0);

    // The expanded case is the same history.
    const Outcome again = run({"run", "case.out/case.toml", "-o", "again", "-q"});
    ASSERT_EQ(again.exit_code, 0) << again.err;
    EXPECT_EQ(json("again/results.json")["steps"][1]["solution"], results["steps"][1]["solution"]);
  }

  TEST_F(LoadHistory, NothingIsGuaranteedThatTakesTheStepBeforeAsExact)
  {
    std::string text = string_case;
    text.replace(text.find("\"-f\""), 4, "{ previous = \"u\", initial = -1 }");
    write("case.toml", text);
    const Outcome outcome = run({"run", "case.toml"});
    ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
    const Json results = json("case.out/results.json");
    EXPECT_EQ(results["estimate"]["guaranteed"], false);
    EXPECT_NE(results["estimate"]["reason"].get<std::string>(), "");
  }

  TEST_F(LoadHistory, FilesOfFormerRunsGo)
  {
    write("case.toml", string_case);
    ASSERT_EQ(run({"run", "case.toml", "-q"}).exit_code, 0);
    ASSERT_EQ(run({"run", "case.toml", "-q", "--set", "steps.f=[1, 2]", "--set", "output.every=0"}).exit_code, 0);
    EXPECT_FALSE(fs::exists(work() / "case.out/step-001"));
    EXPECT_TRUE(fs::exists(work() / "case.out/step-002"));
    EXPECT_FALSE(fs::exists(work() / "case.out/step-003"));
    std::string single = string_case;
    single.erase(single.find("[steps]"), single.find("[mesh]") - single.find("[steps]"));
    write("case.toml", single);
    ASSERT_EQ(run({"run", "case.toml", "-q"}).exit_code, 0);
    EXPECT_EQ(files("case.out"), (Names{"case.toml", "constraint-points.vtu", "report.html", "results.json", "run.log", "solution.vtu"}));
  }

  TEST_F(LoadHistory, ExpectationsReadSteps)
  {
    write("case.toml", string_case + "[[expect]]\nquantity = \"steps.1.constraint.0.total_contact_force\"\nvalue = 0.46863\nrtol = 0.02\n");
    EXPECT_EQ(run({"run", "case.toml", "-q"}).exit_code, 0);
    EXPECT_EQ(run({"run", "case.toml", "-q", "--set", "expect.0.value=2"}).exit_code, 4);
    EXPECT_EQ(run({"run", "case.toml", "-q", "--set", "expect.0.quantity=steps.3.solution.max"}).exit_code, 2);
  }

  TEST_F(LoadHistory, AStepThatDoesNotConvergeIsTheLastAndMarked)
  {
    write("case.toml", R"([[step]]
[[step]]
set = { "method.max_iterations" = 1, "constraint.upper" = 0.001, "model.load" = 50 }
[[step]]
[mesh]
box = [[0, 0], [1, 1]]
cells = 16
[model]
kind = "membrane"
load = 1
[boundary]
all = 0
[constraint]
upper = 0.05
)");
    EXPECT_EQ(run({"run", "case.toml", "-q"}).exit_code, 3);
    const Json results = json("case.out/results.json");
    EXPECT_EQ(results["status"], "not_converged");
    ASSERT_EQ(results["steps"].size(), 2u);
    EXPECT_EQ(results["steps"][0]["status"], "converged");
    EXPECT_EQ(results["failed_step"]["number"], 2);
    EXPECT_EQ(results["failed_step"]["reason"], results["solver"]["reason"]);
  }

  TEST_F(LoadHistory, AnInterruptKeepsTheStepsBefore)
  {
    write("case.toml", R"(parameters = { f = 1 }
[steps]
f = "1:2:500"
[mesh]
box = [[0, 0], [1, 1]]
cells = 40
[model]
kind = "membrane"
load = "f"
[boundary]
all = 0
[constraint]
upper = 0.05
)");
    const pid_t child = start({"run", "case.toml", "-q"});
    for (unsigned k = 0; k < 3000 && !fs::exists(work() / "case.out/step-003/results.json"); ++k)
      std::this_thread::sleep_for(std::chrono::milliseconds(10));
    kill(child, SIGINT);
    const Outcome outcome = finish(child);
    EXPECT_EQ(outcome.exit_code, 130) << outcome.err;
    EXPECT_FALSE(fs::exists(work() / "case.out/results.json"));
    EXPECT_EQ(json("case.out/step-003/results.json")["status"], "converged");
    EXPECT_NE(outcome.err.find("interrupted in step"), std::string::npos) << outcome.err;
    EXPECT_GT(read(work() / "case.out/step_history.csv").size(), 20u);
  }

  /// A block that stands on its obstacle, pulled up at one side until it tips over.
  TEST_F(LoadHistory, AStepWithoutSolutionKeepsTheStepsBefore)
  {
    write("case.toml", R"(parameters = { F = 0 }
[steps]
F = [0.1, 0.5, 3]
[mesh]
box = [[0, 0], [2, 1]]
cells = [8, 4]
[model]
kind = "elasticity"
young = 1000
poisson = 0.3
load = [0, -1]
[boundary]
top = { traction = [0, "F*x"] }
[constraint]
on = "bottom"
gap = 0
[output]
every = 1
)");
    const Outcome checked = run({"check", "case.toml"});
    EXPECT_EQ(checked.exit_code, 2);
    EXPECT_NE(checked.err.find("in step 3: "), std::string::npos) << checked.err;
    const Outcome outcome = run({"run", "case.toml"});
    EXPECT_EQ(outcome.exit_code, 2);
    EXPECT_NE(outcome.err.find("in step 3: "), std::string::npos) << outcome.err;
    EXPECT_NE(outcome.out.find("step 3 of 3 has no solution; the numbers of those before it are in case.out/results.json"),
              std::string::npos)
      << outcome.out;
    EXPECT_EQ(json("case.out/step-002/results.json")["status"], "converged");
    const std::string table = read(work() / "case.out/step_history.csv");
    EXPECT_EQ(std::count(table.begin(), table.end(), '\n'), 3) << table;
    const Json results = json("case.out/results.json");
    EXPECT_EQ(results["status"], "not_converged");
    ASSERT_EQ(results["steps"].size(), 2u);
    EXPECT_EQ(results["steps"][1]["status"], "converged");
    EXPECT_EQ(results["failed_step"]["number"], 3);
    EXPECT_NE(results["failed_step"]["reason"].get<std::string>().find("in step 3: "), std::string::npos);
    EXPECT_EQ(files("case.out"), (Names{"case.toml", "constraint-points.pvd", "report.html", "restart.json", "results.json", "run.log",
                                        "solution.pvd", "step-001", "step-002", "step_history.csv"}));
    EXPECT_EQ(run({"report", "case.out"}).exit_code, 0);

    // With another third step it goes on, and with another second one it does not.
    std::string text = read(work() / "case.toml");
    write("changed.toml", std::regex_replace(text, std::regex("0.5, 3"), "0.4, 0.6"));
    const Outcome changed = run({"run", "changed.toml", "--resume", "-o", "case.out"});
    EXPECT_EQ(changed.exit_code, 2);
    EXPECT_NE(changed.err.find("step 2 of the case is not the one that 'case.out' has"), std::string::npos) << changed.err;
    write("case.toml", std::regex_replace(text, std::regex("0.5, 3"), "0.5, 0.6"));
    const Outcome resumed = run({"run", "case.toml", "--resume"});
    EXPECT_EQ(resumed.exit_code, 0) << resumed.err;
    EXPECT_NE(resumed.out.find("resumed after step 2 of 3"), std::string::npos) << resumed.out;
    EXPECT_EQ(run({"run", "case.toml", "-o", "whole"}).exit_code, 0);
    const Json once = json("whole/results.json"), in_two = json("case.out/results.json");
    ASSERT_EQ(in_two["steps"].size(), 3u);
    for (std::size_t k = 0; k < 3; ++k)
      EXPECT_NEAR(in_two["steps"][k]["constraint"][0]["total_contact_force"].get<double>(),
                  once["steps"][k]["constraint"][0]["total_contact_force"].get<double>(), 1e-9);
    EXPECT_EQ(files("case.out"), files("whole"));
    const Outcome again = run({"run", "case.toml", "--resume"});
    EXPECT_EQ(again.exit_code, 2);
    EXPECT_NE(again.err.find("there is nothing to resume in 'case.out'"), std::string::npos) << again.err;
  }

  /// Time steps, each of which takes the solution of the one before: to the last bit from a file, and on any number of processes.
  TEST_F(LoadHistory, AnInterruptedOneIsResumed)
  {
    write("case.toml", R"([parameters]
t = 0
dt = 0.01
u_old = { previous = "u", initial = 0 }
[steps]
t = "0.01:0.2:20"
[mesh]
box = [[0, 0], [1, 1]]
cells = 8
refine = 3
[model]
kind = "membrane"
element = "Q2"
reaction = "1/dt"
load = "u_old/dt - 1"
[boundary]
left = "t"
[constraint]
lower = 0
[output]
every = 5
probes = [[0.2, 0.5]]
[method]
solver = "multigrid"
)");
    ASSERT_EQ(run({"run", "case.toml", "-q", "-o", "whole"}).exit_code, 0);
    for (const char *const n : {"1", "2"})
    {
      const pid_t child = start({"run", "case.toml", "-q", "-n", n}, without_mpi);
      for (unsigned k = 0; k < 3000 && !fs::exists(work() / "case.out/step-005/results.json"); ++k)
        std::this_thread::sleep_for(std::chrono::milliseconds(10));
      kill(child, SIGTERM);
      EXPECT_EQ(finish(child).exit_code, 130);
      ASSERT_TRUE(fs::exists(work() / "case.out/restart.json"));
      EXPECT_EQ(run({"run", "case.toml", "-q", "--resume", "-n", n[0] == '1' ? "2" : "1"}, without_mpi).exit_code, 0);
      const Json once = json("whole/results.json"), in_two = json("case.out/results.json");
      ASSERT_EQ(in_two["steps"].size(), 20u);
      EXPECT_NEAR(in_two["solution"]["probes"][0]["value"].get<double>(), once["solution"]["probes"][0]["value"].get<double>(), 1e-8);
      EXPECT_NEAR(in_two["solution"]["energy"].get<double>(), once["solution"]["energy"].get<double>(),
                  1e-8 * std::abs(once["solution"]["energy"].get<double>()));
      EXPECT_FALSE(fs::exists(work() / "case.out/restart.json"));
      fs::remove_all(work() / "case.out");
    }
  }

  TEST_F(LoadHistory, WhatIsResumedInVainCanBeResumedAgain)
  {
    const std::string text = R"([parameters]
d = -0.1
u_old = { previous = "u", initial = 0 }
[steps]
d = [-0.1, -0.05, 0.2]
[mesh]
box = [[0], [1]]
cells = 16
[model]
kind = "membrane"
load = "-2 + 5*u_old"
[boundary]
all = 0
[constraint]
lower = "d"
[output]
every = 1
)";
    write("case.toml", text);
    EXPECT_EQ(run({"run", "case.toml", "-q"}).exit_code, 2); // the floor is above the ends
    const std::string results = read(work() / "case.out/results.json"), restart = read(work() / "case.out/restart.json");
    for (unsigned k = 0; k < 2; ++k)
    {
      EXPECT_EQ(run({"run", "case.toml", "-q", "--resume"}).exit_code, 2);
      EXPECT_EQ(read(work() / "case.out/results.json"), results);
      EXPECT_EQ(read(work() / "case.out/restart.json"), restart);
    }
    // More steps, whose folders have longer names.
    std::string more = "-0.1, -0.05";
    for (unsigned k = 0; k < 998; ++k)
      more += ", -0.02";
    write("case.toml", std::regex_replace(text, std::regex("-0.1, -0.05, 0.2"), more));
    EXPECT_EQ(run({"run", "case.toml", "-q", "--resume", "--set", "output.every=500"}).exit_code, 0);
    for (const char *const step : {"step-0001", "step-0002", "step-0500", "step-1000"})
      EXPECT_TRUE(fs::exists(work() / "case.out" / step / "results.json")) << step;
    EXPECT_FALSE(fs::exists(work() / "case.out/step-001"));

    write("case.toml", text);
    EXPECT_EQ(run({"run", "case.toml", "-q"}).exit_code, 2);
    write("case.toml", std::regex_replace(text, std::regex("-0.1, -0.05, 0.2"), "-0.1, -0.05, -0.02"));
    EXPECT_EQ(run({"run", "case.toml", "-q", "--resume", "--set", "title='other'"}).exit_code, 0);
    EXPECT_EQ(run({"run", "case.toml", "-q", "-o", "whole"}).exit_code, 0);
    EXPECT_NEAR(json("case.out/results.json")["solution"]["energy"].get<double>(),
                json("whole/results.json")["solution"]["energy"].get<double>(), 1e-12);
    EXPECT_EQ(files("case.out"), files("whole"));
  }

  TEST_F(LoadHistory, DamagedFilesAreNotResumed)
  {
    write("case.toml", std::regex_replace(string_case, std::regex("load = \"-f\""), "load = \"-f + u_old\"") +
                         "[parameters.u_old]\nprevious = \"u\"\ninitial = 0\n[method]\nmax_iterations = 1\n");
    std::string text = read(work() / "case.toml");
    ASSERT_EQ(run({"run", "case.toml", "-q"}).exit_code, 3);
    ASSERT_TRUE(fs::exists(work() / "case.out/restart.json")) << "the first steps are to be solved, and one is not";
    for (const auto &entry : fs::directory_iterator(work() / "case.out"))
      if (const std::string name = entry.path().filename(); name.starts_with("restart-"))
        fs::resize_file(entry.path(), 100);
    const Outcome cut = run({"run", "case.toml", "--resume"});
    EXPECT_EQ(cut.exit_code, 2);
    EXPECT_NE(cut.err.find("is cut short or damaged; run the case without --resume"), std::string::npos) << cut.err;
    write("case.out/restart.json", "{\"version\": 1");
    EXPECT_EQ(run({"run", "case.toml", "--resume"}).exit_code, 2);
    write("other.toml", "[mesh]\nbox = [[0], [1]]\n[model]\nkind = \"membrane\"\n[boundary]\nall = 0\n");
    const Outcome other = run({"run", "other.toml", "--resume"});
    EXPECT_EQ(other.exit_code, 2);
    EXPECT_NE(other.err.find("there is nothing to resume in 'other.out'"), std::string::npos) << other.err;
  }

  TEST_F(LoadHistory, TheSolutionOfARunIsAField)
  {
    write("first.toml", "[mesh]\nbox = [[0, 0], [1, 1]]\ncells = 4\n[model]\nkind = \"membrane\"\n[boundary]\nall = \"1 + x - 2*y\"\n");
    ASSERT_EQ(run({"run", "first.toml", "-q"}).exit_code, 0);
    // The bound is the other solution, on another mesh: exact, since it is linear.
    write("second.toml", "[mesh]\nbox = [[0, 0], [1, 1]]\ncells = 7\n[model]\nkind = \"membrane\"\nload = 100\n[boundary]\nall = { run = "
                         "\"first.out\", scale = 2 }\n[constraint]\nupper = { run = \"first.out\", scale = 2, offset = 0.25 }\n"
                         "[method]\nformulation = \"mixed\"\n[output]\nprobes = [[0.5, 0.5]]\n[[expect]]\nquantity = "
                         "\"solution.probes.0.value\"\nvalue = 1.25\nrtol = 1e-9\n");
    Outcome outcome = run({"run", "second.toml", "-q"});
    EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
    write("third.toml",
          "[mesh]\nbox = [[0, 0], [2, 1]]\n[model]\nkind = \"membrane\"\nload = { run = \"first.out\" }\n[boundary]\nall = 0\n");
    outcome = run({"run", "third.toml", "-q"});
    EXPECT_EQ(outcome.exit_code, 2);
    EXPECT_NE(outcome.err.find("third.toml:5:"), std::string::npos) << outcome.err;
    EXPECT_NE(outcome.err.find("outside its mesh"), std::string::npos) << outcome.err;
    outcome = run({"run", "third.toml", "-q", "--set", "model.load.quantity=stress_xx"});
    EXPECT_EQ(outcome.exit_code, 2);
    EXPECT_NE(outcome.err.find("has no 'stress_xx'"), std::string::npos) << outcome.err;
    EXPECT_EQ(run({"run", "third.toml", "-q", "--set", "model.load.run=nowhere"}).exit_code, 2);
  }

  TEST_F(LoadHistory, ChecksAndSweepsWork)
  {
    write("case.toml", string_case);
    EXPECT_EQ(run({"check", "case.toml", "-q"}).exit_code, 0);
    EXPECT_EQ(run({"study", "mesh", "case.toml", "--levels", "2", "-q"}).exit_code, 0);
    ASSERT_EQ(run({"sweep", "case.toml", "--over", "mesh.refine=1,2", "-q"}).exit_code, 0);
    EXPECT_EQ(json("case.sweep/step-002/results.json")["steps"].size(), 3u);
  }
} // namespace
