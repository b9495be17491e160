// Runs that are killed, interrupted, without room, or not alone: what lies in the folder of the results is of one run, and whole.
#include "program_in_folder.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <array>
#include <chrono>
#include <csignal>
#include <ctime>
#include <random>
#include <thread>

#include <sys/mount.h>
#include <sys/resource.h>
#include <sys/stat.h>

namespace
{
  using program_in_folder::Outcome;
  using program_in_folder::read;
  using Json = nlohmann::json;
  using Clock = std::chrono::steady_clock;
  namespace fs = std::filesystem;

  const std::vector<std::string> all_files = {"case.toml", "constraint-points.vtu", "report.html", "results.json",
                                              "run.log",   "solution.vtu"};

  double seconds_since(const Clock::time_point begin)
  {
    return std::chrono::duration<double>(Clock::now() - begin).count();
  }

  void sleep(const double seconds)
  {
    std::this_thread::sleep_for(std::chrono::duration<double>(seconds));
  }

  /// What the processor has done for a process.
  double seconds_of_processor(const pid_t process)
  {
    clockid_t clock = {};
    timespec  used = {};
    return clock_getcpuclockid(process, &clock) == 0 && clock_gettime(clock, &used) == 0 ? double(used.tv_sec) + 1e-9 * double(used.tv_nsec)
                                                                                         : 0.;
  }

  /// The same for the children that are no more.
  double seconds_of_ended_processes()
  {
    rusage usage = {};
    getrusage(RUSAGE_CHILDREN, &usage);
    const auto seconds = [](const timeval &time) { return double(time.tv_sec) + 1e-6 * double(time.tv_usec); };
    return seconds(usage.ru_utime) + seconds(usage.ru_stime);
  }

  class Interruptions : public program_in_folder::ProgramInFolder
  {
  protected:
    void SetUp() override
    {
      ProgramInFolder::SetUp();
      write("case.toml", "[mesh]\nbox = [[-1, -1], [1, 1]]\ncells = 4\nrefine = 4\n[model]\nkind = \"membrane\"\nload = -10\n[boundary]\n"
                         "all = 0\n[constraint]\nlower = \"-0.3 + 0.1*x\"\n");
    }

    std::vector<std::string> arguments(const unsigned refine, const std::string &results = "results") const
    {
      return {"run", "case.toml", "-q", "-o", results, "--set", fmt::format("mesh.refine={}", refine)};
    }

    /// How many refinements the results in the folder are of; fails when they are not those of one run, each file whole.
    int refinements_of_results(const std::string &results = "results") const
    {
      EXPECT_EQ(files_of_results(results), all_files);
      const fs::path place = folder / "work" / results;
      const Json     json = Json::parse(read(place / "results.json"), nullptr, false);
      EXPECT_TRUE(json.is_object());
      if (!json.is_object())
        return -1;
      EXPECT_EQ(json["case"]["expanded"], read(place / "case.toml"));
      const int levels = json["mesh"]["n_levels"];
      EXPECT_NE(read(place / "case.toml").find(fmt::format("refine = {}\n", levels - 1)), std::string::npos) << levels;
      const std::string solution = read(place / "solution.vtu"), points = read(place / "constraint-points.vtu"),
                        log = read(place / "run.log");
      const std::size_t nodes = json["space"]["n_dofs"], n_points = json["constraint"][0]["n_points"];
      EXPECT_NE(solution.find(fmt::format("NumberOfPoints=\"{}\"", nodes)), std::string::npos);
      EXPECT_NE(points.find(fmt::format("NumberOfPoints=\"{}\"", n_points)), std::string::npos);
      EXPECT_NE(log.find(fmt::format("refine = {}\n", levels - 1)), std::string::npos);
      for (const std::string &text : {solution, points})
        EXPECT_NE(text.find("</VTKFile>"), std::string::npos);
      return levels - 1;
    }

    /// Without what a run that was killed has left for the next one to take away, or to go on.
    std::vector<std::string> files_of_results(const std::string &results = "results") const
    {
      auto names = files(results);
      std::erase_if(names, [](const std::string &name) { return name.starts_with(".unilateral.part-") || name.starts_with("restart"); });
      return names;
    }
  };
} // namespace

TEST_F(Interruptions, killed_runs_leave_old_results_or_new_ones)
{
  ASSERT_EQ(run(arguments(3)).exit_code, 0);
  const auto begin = Clock::now();
  ASSERT_EQ(run(arguments(5, "other")).exit_code, 0);
  const double     duration = seconds_since(begin);
  std::mt19937_64  random(7);
  int              refinements = 3;
  constexpr double share_of_output = 0.4; // the end of a run, where files are written, is where something can go wrong
  for (unsigned i = 0; i < 10; ++i)
  {
    const int    signal = std::array{SIGKILL, SIGKILL, SIGINT, SIGTERM}[i % 4], to_come = refinements == 5 ? 4 : 5;
    const double chance = double(random() >> 11) * 0x1p-53;
    const double moment = duration * (i % 2 == 0 ? chance : 1 - share_of_output * chance);
    SCOPED_TRACE(fmt::format("signal {} after {:.3f} of {:.3f} s", signal, moment, duration));
    const pid_t child = start(arguments(unsigned(to_come)));
    sleep(moment);
    kill(child, signal);
    const int code = finish(child).exit_code;
    // Before main() every signal is the end.
    EXPECT_TRUE(code == 0 || code == -1 || (signal != SIGKILL && code == 130)) << code;
    const int now = refinements_of_results();
    EXPECT_TRUE(now == refinements || now == to_come) << now;
    EXPECT_TRUE(code != 0 || now == to_come) << now;
    refinements = now;
  }
  ASSERT_EQ(run(arguments(3)).exit_code, 0);
  EXPECT_EQ(files("results"), all_files) << "what killed runs have left";
  EXPECT_EQ(refinements_of_results(), 3);
  EXPECT_EQ(files(), (std::vector<std::string>{"case.toml", "other", "results"}));
}

TEST_F(Interruptions, end_a_run_soon_wherever_it_is)
{
  ASSERT_EQ(run(arguments(3)).exit_code, 0);
  // A run of seconds, and where in it the solver and the certificate are at work.
  const auto begin = Clock::now();
  ASSERT_EQ(run(arguments(7, "other")).exit_code, 0);
  const double duration = seconds_since(begin);
  const Json   timing = Json::parse(read(folder / "work/other/results.json"))["timing"];
  const double certify = timing["certify"], output = timing["output"], certificate_ends = duration - output;
  unsigned     n_interrupted = 0, n_before_main = 0;
  for (const auto &[signal, moment] :
       {std::pair(SIGINT, 0.3 * duration), std::pair(SIGTERM, 0.5 * duration), std::pair(SIGINT, certificate_ends - 0.8 * certify),
        std::pair(SIGTERM, certificate_ends - 0.5 * certify)})
  {
    double at = moment;
    for (unsigned attempt = 0; attempt < 3; ++attempt, at *= 0.5)
    {
      SCOPED_TRACE(fmt::format("signal {} after {:.2f} of {:.2f} s", signal, at, duration));
      const pid_t child = start(arguments(7));
      sleep(at);
      // In the processor's time: others may keep it from the program.
      const double before = seconds_of_processor(child) + seconds_of_ended_processes();
      const auto   asked = Clock::now();
      kill(child, signal);
      const Outcome outcome = finish(child);
      // After SIGTERM it comes to a place from which it can be resumed.
      EXPECT_LT(seconds_of_ended_processes() - before, signal == SIGTERM ? 6 : 1.5);
      EXPECT_LT(seconds_since(asked), signal == SIGTERM ? 15 : 5);
      EXPECT_TRUE(outcome.exit_code == 130 || outcome.exit_code == 0 || outcome.exit_code == -1) << outcome.exit_code << outcome.err;
      n_before_main += outcome.exit_code == -1; // on a machine that others keep busy; every signal is the end there
      n_interrupted += outcome.exit_code == 130;
      // Where the machine was quicker this time, the run is over, and an earlier moment is tried.
      EXPECT_EQ(refinements_of_results(), outcome.exit_code == 0 ? 7 : 3);
      // A run that a second did not suffice to end in order leaves its unpublished files behind; the next run takes them away.
      EXPECT_EQ(files_of_results(), all_files);
      ASSERT_EQ(run(arguments(3)).exit_code, 0);
      EXPECT_EQ(files("results"), all_files);
      if (outcome.exit_code != 0)
        break;
    }
  }
  EXPECT_GE(n_interrupted, 2u);
  EXPECT_LE(n_before_main, 1u);
}

TEST_F(Interruptions, leave_the_solutions_on_adapted_meshes_that_were_finished)
{
  const std::vector<std::string> endless = {"run",
                                            "case.toml",
                                            "-v",
                                            "-o",
                                            "results",
                                            "--set",
                                            "mesh.refine=0",
                                            "--set",
                                            "mesh.adapt={ tolerance = 1e-6, max_unknowns = 100000000 }"};
  const pid_t                    child = start(endless);
  const auto                     meshes_so_far = [&]
  {
    std::size_t n = 0;
    if (fs::exists(folder / "work/results"))
      for (const auto &entry : fs::recursive_directory_iterator(folder / "work/results"))
        n += entry.path().filename().string().starts_with("solution.");
    return n;
  };
  for (const auto begin = Clock::now(); meshes_so_far() < 4 && seconds_since(begin) < 60;)
    sleep(0.02);
  kill(child, SIGINT);
  const Outcome outcome = finish(child);
  EXPECT_EQ(outcome.exit_code, 130);
  EXPECT_NE(outcome.err.find("interrupted on mesh"), std::string::npos) << outcome.err;
  const auto names = files_of_results();
  for (const char *const name : {"case.toml", "run.log", "solution.pvd", "constraint-points.pvd", "solution.0.vtu", "solution.2.vtu"})
    EXPECT_EQ(std::count(names.begin(), names.end(), name), 1) << name;
  const std::string pvd = read(folder / "work/results/solution.pvd");
  for (const std::string &name : names)
    EXPECT_EQ(name.starts_with("solution.") && name.ends_with(".vtu"), pvd.find('"' + name + '"') != std::string::npos) << name;

  // Results of a former run stay.
  ASSERT_EQ(run(arguments(3)).exit_code, 0);
  EXPECT_EQ(files("results"), all_files);
  const pid_t again = start(endless);
  for (const auto begin = Clock::now(); meshes_so_far() < 4 && seconds_since(begin) < 60;)
    sleep(0.02);
  kill(again, SIGINT);
  EXPECT_EQ(finish(again).exit_code, 130);
  EXPECT_EQ(refinements_of_results(), 3);

  // Neither a part that is cut short nor one that is missing is trusted.
  std::string part;
  for (const std::string &name : files("results"))
    if (name.starts_with("restart-"))
      part = name;
  ASSERT_FALSE(part.empty());
  std::vector<std::string> modest = endless;
  modest.back() = "mesh.adapt={ tolerance = 0.01, max_unknowns = 100000000 }";
  modest.push_back("--resume");
  const std::string bytes = read(folder / "work/results" / part);
  for (const std::string &damaged : {bytes.substr(0, bytes.size() / 2), bytes + "x", std::string(), "x" + bytes})
  {
    write("results/" + part, damaged);
    const Outcome refused = run(modest);
    EXPECT_EQ(refused.exit_code, 2);
    EXPECT_NE(refused.err.find("is missing, cut short or damaged; run the case without --resume"), std::string::npos) << refused.err;
  }
  write("results/" + part, bytes);

  // Either run goes on where it was left, with another tolerance as well.
  std::ifstream left(folder / "work/results/restart.json");
  const auto    number_of_mesh = Json::parse(left)["mesh"].get<unsigned>();
  EXPECT_GE(number_of_mesh, 2u);
  for (const std::string other : {"model.load=-11", "mesh.cells=5"})
  {
    std::vector<std::string> changed = modest;
    changed.insert(changed.end(), {"--set", other});
    const Outcome refused = run(changed);
    EXPECT_EQ(refused.exit_code, 2);
    EXPECT_NE(refused.err.find("is that of another case; run the case without --resume"), std::string::npos) << refused.err;
  }
  const Outcome resumed = run(modest);
  EXPECT_EQ(resumed.exit_code, 0) << resumed.err;
  EXPECT_NE(resumed.out.find("resumed with the mesh of "), std::string::npos) << resumed.out;
  std::ifstream results(folder / "work/results/results.json");
  const Json    with_resumption = Json::parse(results);
  EXPECT_FALSE(fs::exists(folder / "work/results/restart.json"));
  EXPECT_EQ(run(modest).exit_code, 2) << "there is nothing to resume";
  modest.pop_back();
  ASSERT_EQ(run(modest).exit_code, 0);
  std::ifstream from_the_start(folder / "work/results/results.json");
  const Json    without = Json::parse(from_the_start);
  EXPECT_LT(with_resumption["estimate"]["cycles"].size(), without["estimate"]["cycles"].size());
  const double energy = without["solution"]["energy"];
  EXPECT_NEAR(with_resumption["solution"]["energy"].get<double>(), energy, 1e-4 * std::abs(energy));
}

TEST_F(Interruptions, leave_the_iterate_of_the_level_at_hand)
{
  auto verbose = arguments(8);
  verbose[2] = "-v";
  const pid_t child = start(verbose);
  const auto  is_solving = [&] { return (read(folder / "out") + read(folder / "err")).find("solve: level 8") != std::string::npos; };
  for (const auto begin = Clock::now(); !is_solving() && seconds_since(begin) < 100;)
    sleep(0.01);
  kill(child, SIGTERM);
  const Outcome interrupted = finish(child);
  EXPECT_EQ(interrupted.exit_code, 130);
  EXPECT_NE((interrupted.err + interrupted.out).find("--resume goes on with level 8, by what is in results"), std::string::npos)
    << interrupted.err;
  EXPECT_EQ(files("results"), (std::vector<std::string>{"restart-8-0.bin", "restart.json"}));

  const auto resume_with = [&](const std::string &change)
  {
    auto again = arguments(8);
    again.insert(again.end(), {"--resume", "--set", change});
    return run(again);
  };
  const std::string bytes = read(folder / "work/results/restart-8-0.bin");
  write("results/restart-8-0.bin", bytes.substr(0, bytes.size() / 2));
  EXPECT_NE(resume_with("model.load=-10").err.find("is cut short or damaged; run the case without --resume"), std::string::npos);
  write("results/restart-8-0.bin", bytes);
  EXPECT_NE(resume_with("model.load=-11").err.find("is that of another case; run the case without --resume"), std::string::npos);
  EXPECT_NE(resume_with("mesh.refine=7").err.find("had come to level 8, finer than what the case asks for"), std::string::npos);
  EXPECT_NE(resume_with("mesh.adapt={ tolerance = 0.01 }").err.find("a run without adapt in [mesh]"), std::string::npos);

  const Outcome resumed = resume_with("method.tolerance=1e-9");
  EXPECT_EQ(resumed.exit_code, 0) << resumed.err;
  EXPECT_EQ(refinements_of_results(), 8);
  const auto energy = [&] { return Json::parse(read(folder / "work/results/results.json"))["solution"]["energy"].get<double>(); };
  const Json results = Json::parse(read(folder / "work/results/results.json"));
  EXPECT_EQ(results["solver"]["levels"].size(), 1u) << "coarser levels are not solved again";
  const double with_resumption = energy();
  EXPECT_EQ(resume_with("model.load=-10").exit_code, 2) << "there is nothing to resume";
  ASSERT_EQ(run(arguments(8)).exit_code, 0);
  EXPECT_NEAR(with_resumption, energy(), 1e-8 * std::abs(energy()));
}

TEST_F(Interruptions, damaged_meshes_are_not_resumed)
{
  write("case.toml", "[mesh]\nbox = [[-1, -1], [1, 1]]\ncells = 4\nadapt = { tolerance = 0.01 }\n[model]\nkind = \"membrane\"\nload = -10\n"
                     "[boundary]\nall = 0\n[constraint]\nlower = \"-0.3 + 0.1*x\"\n");
  fs::create_directories(folder / "work/case.out");
  const auto refusal = [&](const std::string &json, const std::string &part)
  {
    write("case.out/restart.json", json);
    write("case.out/restart-2-0.bin", part);
    const Outcome outcome = run({"run", "case.toml", "--resume"});
    EXPECT_EQ(outcome.exit_code, 2) << outcome.err;
    return outcome.err;
  };
  EXPECT_NE(refusal("{", "").find("is damaged or of another version"), std::string::npos);
  EXPECT_NE(refusal(R"({"version": 1, "parts": [], "cases": ["a"], "steps": [1]})", "").find("is a load history"), std::string::npos);
  EXPECT_NE(refusal(R"({"version": 1, "parts": ["restart-2-0.bin"], "mesh": 2, "case": "0"})", "").find("is that of another case"),
            std::string::npos);
}

/// METIS has a handler of SIGTERM that jumps out of malloc: no thread that computes may ever run it.
TEST_F(Interruptions, sigterm_is_blocked_where_it_is_not_waited_for)
{
  const auto blocks_sigterm = [](const fs::path &task)
  {
    std::ifstream      file(task / "status");
    std::string        word;
    unsigned long long blocked = 0;
    while (file >> word)
      if (word == "SigBlk:")
        file >> std::hex >> blocked;
    return (blocked >> (SIGTERM - 1)) % 2 == 1;
  };
  const pid_t    child = start(arguments(7));
  const fs::path tasks = fmt::format("/proc/{}/task", child);
  for (unsigned k = 0; k < 1000 && !blocks_sigterm(tasks / std::to_string(child)); ++k)
    sleep(0.01);
  unsigned n_open = 0;
  for (const auto &task : fs::directory_iterator(tasks))
    n_open += !blocks_sigterm(task.path());
  EXPECT_TRUE(blocks_sigterm(tasks / std::to_string(child)));
  EXPECT_LE(n_open, 1u); // that which waits
  kill(child, SIGTERM);
  EXPECT_EQ(finish(child).exit_code, 130);
}

TEST_F(Interruptions, files_that_may_not_grow_leave_the_old_results)
{
  ASSERT_EQ(run(arguments(3)).exit_code, 0);
  for (const auto &limited : {std::pair(true, rlim_t(1000)), std::pair(false, rlim_t(100000))})
  {
    const bool   ignored = limited.first;
    const rlim_t largest = limited.second;
    SCOPED_TRACE(fmt::format("{} bytes, the signal {}", largest, ignored ? "ignored" : "as usual"));
    const Outcome outcome = run(arguments(5),
                                [&]
                                {
                                  std::signal(SIGXFSZ, ignored ? SIG_IGN : SIG_DFL);
                                  const rlimit limit = {largest, largest};
                                  setrlimit(RLIMIT_FSIZE, &limit);
                                });
    EXPECT_EQ(outcome.exit_code, 1) << outcome.err;
    EXPECT_EQ(outcome.err.find("internal error"), std::string::npos) << outcome.err;
    EXPECT_NE(outcome.err.find("results"), std::string::npos) << outcome.err;
    EXPECT_EQ(files("results"), all_files);
    EXPECT_EQ(refinements_of_results(), 3);
  }
}

TEST_F(Interruptions, a_full_disk_leaves_the_old_results)
{
  // A small disk of its own, where the system lets one be made.
  if (std::system("unshare -rm true 2>/dev/null") != 0)
    GTEST_SKIP() << "no file systems of one's own";
  const fs::path place = folder / "work";
  fs::create_directory(place / "disk");
  const auto on_disk = [&](const std::string &commands)
  {
    const int status =
      std::system(fmt::format("cd '{}' && unshare -rm sh -c 'mount -t tmpfs -o size=1200k none disk || exit 77; {}' >../out 2>../err",
                              place.string(), commands)
                    .c_str());
    return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
  };
  const std::string command = PROGRAM " run case.toml -q -o disk/results --set mesh.refine=";
  // The second run does not fit; what the first one left is copied to where it can be looked at.
  const int code = on_disk(command + "2 || exit 78; " + command + "6; code=$?; cp -r disk/results results; exit $code");
  if (code == 77)
    GTEST_SKIP() << "no small disk can be made";
  const std::string err = read(folder / "err");
  EXPECT_EQ(code, 1) << err;
  EXPECT_NE(err.find("No space left"), std::string::npos) << err;
  EXPECT_EQ(err.find("internal error"), std::string::npos) << err;
  EXPECT_EQ(refinements_of_results(), 2);
  EXPECT_EQ(files("results"), all_files);
}

TEST_F(Interruptions, two_runs_at_once_leave_the_files_of_one)
{
  for (unsigned i = 0; i < 2; ++i)
  {
    const pid_t first = start(arguments(4)), second = start(arguments(5));
    EXPECT_EQ(finish(first).exit_code, 0);
    EXPECT_EQ(finish(second).exit_code, 0);
    const int refinements = refinements_of_results();
    EXPECT_TRUE(refinements == 4 || refinements == 5) << refinements;
    EXPECT_EQ(files("results"), all_files);
  }
}

namespace
{
  /// Not what has ended and waits for its parent, process 1 by then, to take notice.
  bool runs(const pid_t process)
  {
    std::ifstream file(fmt::format("/proc/{}/stat", process));
    std::string   line;
    if (!std::getline(file, line))
      return false;
    const auto state = line.find_last_of(')'); // of the name, which may contain anything
    return state != std::string::npos && line.substr(state).find(" Z ") != 1;
  }
} // namespace

TEST_F(Interruptions, of_several_processes_none_goes_on_alone)
{
  ASSERT_EQ(run(arguments(3)).exit_code, 0);
  // The processes write their numbers to files before they become the program.
  write("start",
        "#!/bin/sh\necho $$ > process.$OMPI_COMM_WORLD_RANK\nexec '" PROGRAM "' run case.toml -q -o results --set mesh.refine=9\n");
  for (const int victim : {1, 0})
  {
    SCOPED_TRACE(victim);
    for (const int rank : {0, 1})
      fs::remove(folder / "work" / fmt::format("process.{}", rank));
    const pid_t child = fork();
    ASSERT_GE(child, 0);
    if (child == 0)
    {
      if (chdir((folder / "work").c_str()) != 0)
        _exit(99);
      // A clean environment: this test is itself a process of MPI, and mpirun would take its settings over.
      execl("/bin/sh", "sh", "-c",
            "exec env -i PATH=\"$PATH\" HOME=\"${HOME:-/}\" OMPI_ALLOW_RUN_AS_ROOT=1 OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1 "
            "OMPI_MCA_rmaps_base_oversubscribe=1 OMPI_MCA_btl_vader_single_copy_mechanism=none mpirun -n 2 sh start >../out 2>../err",
            nullptr);
      _exit(98);
    }
    std::array<pid_t, 2> processes = {0, 0};
    for (unsigned tenths = 0; tenths < 200 && (processes[0] == 0 || processes[1] == 0); ++tenths)
    {
      sleep(0.1);
      for (const int rank : {0, 1})
        std::ifstream(folder / "work" / fmt::format("process.{}", rank)) >> processes[std::size_t(rank)];
    }
    ASSERT_TRUE(processes[0] > 0 && processes[1] > 0) << read(folder / "err");
    sleep(1.); // at work on their parts
    kill(processes[std::size_t(victim)], SIGKILL);
    const auto begin = Clock::now();
    int        status = 0;
    while (waitpid(child, &status, WNOHANG) == 0 && seconds_since(begin) < 20)
      sleep(0.02);
    EXPECT_LT(seconds_since(begin), 10) << "the other process goes on";
    EXPECT_FALSE(WIFEXITED(status) && WEXITSTATUS(status) == 0);
    for (unsigned tenths = 0; tenths < 20 && runs(processes[std::size_t(1 - victim)]); ++tenths)
      sleep(0.1);
    EXPECT_FALSE(runs(processes[std::size_t(1 - victim)])) << "the other process is still there";
    EXPECT_EQ(files_of_results(), all_files);
    EXPECT_EQ(refinements_of_results(), 3);
  }
  ASSERT_EQ(run(arguments(2)).exit_code, 0);
  EXPECT_EQ(files("results"), all_files);
}
