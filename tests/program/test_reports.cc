// Reports, pictures and sweeps, as a user starts them.
#include "program_in_folder.h"

#include <nlohmann/json.hpp>

#include <fmt/format.h>

#include <chrono>
#include <csignal>
#include <fstream>
#include <thread>

namespace
{
  using namespace program_in_folder;
  using Json = nlohmann::ordered_json;

  const std::string string_case = R"(title = "A <b>string</b> & \"more\""
mesh = { box = [[0], [1]], cells = 16, refine = 1 }
model = { kind = "membrane", load = 1 }
boundary.all = 0
constraint.upper = 0.05
)";

  class Reports : public ProgramInFolder
  {
  protected:
    void SetUp() override
    {
      ProgramInFolder::SetUp();
      write("case.toml", string_case);
    }
    Json json(const std::string &file) const { return Json::parse(read(work() / file)); }
  };

  std::string between(const std::string &text, const std::string &from, const std::string &to)
  {
    const std::size_t begin = text.find(from) + from.size();
    return text.substr(begin, text.find(to, begin) - begin);
  }

  TEST_F(Reports, AreWrittenByRunsAndCanBeRebuilt)
  {
    ASSERT_EQ(run({"run", "case.toml", "-q"}).exit_code, 0);
    const std::string page = read(work() / "case.out/report.html");
    EXPECT_NE(page.find("<section id=\"verdict\">"), std::string::npos);
    EXPECT_NE(page.find("A &lt;b&gt;string&lt;/b&gt; &amp; &quot;more&quot;"), std::string::npos);
    const Json data = Json::parse(between(page, "id=\"data\">", "</script>"));
    EXPECT_EQ(data["runs"][0]["title"], "A <b>string</b> & \"more\"");
    EXPECT_EQ(data["runs"][0]["scene"]["dimension"], 1);

    fs::remove(work() / "case.out/report.html");
    ASSERT_EQ(run({"report", "case.out"}).exit_code, 0);
    EXPECT_EQ(read(work() / "case.out/report.html"), page);
  }

  TEST_F(Reports, HoldTheStudiesOfTheirFolder)
  {
    ASSERT_EQ(run({"run", "case.toml", "-q"}).exit_code, 0);
    ASSERT_EQ(run({"study", "epsilon", "case.toml", "-q"}).exit_code, 0);
    ASSERT_EQ(run({"infsup", "case.toml", "--levels", "2", "-q"}).exit_code, 0);
    const std::string page = read(work() / "case.out/report.html");
    for (const char *const section : {"verdict", "epsilon-study", "infsup-study", "downloads"})
      EXPECT_NE(page.find("<section id=\"" + std::string(section) + "\">"), std::string::npos) << section;
  }

  TEST_F(Reports, SayWhereAStudyIsOfOtherSettingsThanTheRun)
  {
    const char *const note = "The study is with --set (mesh.refine=1), other than the run.";
    ASSERT_EQ(run({"run", "case.toml", "-q"}).exit_code, 0);
    ASSERT_EQ(run({"infsup", "case.toml", "--levels", "2", "-q"}).exit_code, 0);
    EXPECT_EQ(read(work() / "case.out/report.html").find(note), std::string::npos);
    ASSERT_EQ(run({"study", "quadrature", "case.toml", "-q", "--set", "mesh.refine=1"}).exit_code, 0);
    EXPECT_NE(read(work() / "case.out/report.html").find(note), std::string::npos);
  }

  TEST_F(Reports, TakeSettingsInAnotherOrderForTheSame)
  {
    const std::string note = "other than the run", load = "model.load=1", refine = "mesh.refine=1";
    ASSERT_EQ(run({"run", "case.toml", "-q", "--set", load, "--set", refine}).exit_code, 0);
    ASSERT_EQ(run({"infsup", "case.toml", "--levels", "2", "-q", "--set", refine, "--set", load}).exit_code, 0);
    EXPECT_EQ(read(work() / "case.out/report.html").find(note), std::string::npos);
    ASSERT_EQ(run({"infsup", "case.toml", "--levels", "2", "-q", "--set", refine, "--set", "model.load=2"}).exit_code, 0);
    EXPECT_NE(read(work() / "case.out/report.html").find(note), std::string::npos);
  }

  TEST_F(Reports, OfASmallerSweepHaveNoStepsOfALargerOne)
  {
    ASSERT_EQ(run({"sweep", "case.toml", "--over", "model.load=1,2,3", "-q"}).exit_code, 0);
    fs::create_directory(work() / "case.sweep/step-of-somebody-else");
    ASSERT_EQ(run({"sweep", "case.toml", "--over", "model.load=1,2", "-q"}).exit_code, 0);
    EXPECT_TRUE(fs::exists(work() / "case.sweep/step-002"));
    EXPECT_FALSE(fs::exists(work() / "case.sweep/step-003"));
    EXPECT_TRUE(fs::exists(work() / "case.sweep/step-of-somebody-else"));
  }

  TEST_F(Reports, OfSweepsNameTheOptionInMessages)
  {
    const Outcome outcome = run({"sweep", "case.toml", "--over", "modl.load=1,2"});
    EXPECT_EQ(outcome.exit_code, 2);
    EXPECT_EQ(outcome.err.find("--over modl.load"), 0u) << outcome.err;
  }

  TEST_F(Reports, SetSeveralRunsSideBySide)
  {
    ASSERT_EQ(run({"run", "case.toml", "-q", "-o", "a"}).exit_code, 0);
    ASSERT_EQ(run({"run", "case.toml", "-q", "-o", "b", "--set", "mesh.refine=3"}).exit_code, 0);
    ASSERT_EQ(run({"report", "a", "b", "-o", "both.html"}).exit_code, 0);
    const Json data = Json::parse(between(read(work() / "both.html"), "id=\"data\">", "</script>"));
    EXPECT_EQ(data["kind"], "comparison");
    EXPECT_EQ(data["runs"].size(), 2);
  }

  TEST_F(Reports, SayWhatIsWrongWithAFolder)
  {
    EXPECT_EQ(run({"report", "nowhere"}).exit_code, 2);
    fs::create_directory(work() / "empty");
    EXPECT_EQ(run({"report", "empty"}).exit_code, 2);
    fs::create_directory(work() / "damaged");
    write("damaged/results.json", "{");
    const Outcome outcome = run({"report", "damaged"});
    EXPECT_EQ(outcome.exit_code, 2);
    EXPECT_NE(outcome.err.find("results.json"), std::string::npos);
    EXPECT_EQ(run({"report"}).exit_code, 2);
  }

  TEST_F(Reports, AndFieldsCanBeLeftOut)
  {
    ASSERT_EQ(run({"run", "case.toml", "-q", "--set", "output.vtu=false", "--set", "output.report=false"}).exit_code, 0);
    EXPECT_FALSE(fs::exists(work() / "case.out/report.html"));
    EXPECT_FALSE(fs::exists(work() / "case.out/solution.vtu"));
    ASSERT_EQ(run({"report", "case.out"}).exit_code, 0);
    const Outcome picture = run({"picture", "case.out"});
    EXPECT_EQ(picture.exit_code, 2);
    EXPECT_NE(picture.err.find("output.vtu"), std::string::npos);
  }

  TEST_F(Reports, ComeWithPictures)
  {
    ASSERT_EQ(run({"run", "case.toml", "-q"}).exit_code, 0);
    ASSERT_EQ(run({"picture", "case.out"}).exit_code, 0);
    EXPECT_EQ(read(work() / "case.out/picture.svg").rfind("<svg", 0), 0);
    ASSERT_EQ(run({"picture", "case.out", "-o", "string.png"}).exit_code, 0);
    EXPECT_EQ(read(work() / "string.png").substr(1, 3), "PNG");
    EXPECT_EQ(run({"picture", "case.out", "-o", "string.jpg"}).exit_code, 2);
  }

  TEST_F(Reports, OfSweepsHaveARowForEachRun)
  {
    const Outcome outcome = run({"sweep", "case.toml", "--over", "constraint.upper=0.04:0.06:3", "--over", "model.load=1,2", "--quantity",
                                 "constraint.0.total_contact_force"});
    ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
    const Json sweep = json("case.sweep/sweep.json");
    ASSERT_EQ(sweep["rows"].size(), 6);
    EXPECT_EQ(sweep["rows"][3]["parameters"]["constraint.upper"], 0.05);
    EXPECT_EQ(sweep["rows"][3]["parameters"]["model.load"], 2);
    // The first key is the slowest; a lower ceiling and a larger load press more.
    const auto force = [&](const std::size_t k)
    { return sweep["rows"][k]["quantities"]["constraint.0.total_contact_force"].get<double>(); };
    EXPECT_GT(force(0), force(2));
    EXPECT_GT(force(1), force(0));
    // The string at the ceiling s: it leaves at a = sqrt(2 s / f), and the pressure is f between.
    EXPECT_NEAR(force(3), 2 * (1 - 2 * std::sqrt(2 * 0.05 / 2)), 0.1);
    EXPECT_EQ(json("case.sweep/step-004/results.json")["constraint"][0]["total_contact_force"].get<double>(), force(3));
    const std::string csv = read(work() / "case.sweep/sweep.csv");
    EXPECT_EQ(csv.rfind("folder,constraint.upper,model.load,constraint.0.total_contact_force,status,seconds\n", 0), 0);
    EXPECT_EQ(std::count(csv.begin(), csv.end(), '\n'), 7);
    const std::string page = read(work() / "case.sweep/report.html");
    const Json        data = Json::parse(between(page, "id=\"data\">", "</script>"));
    EXPECT_EQ(data["kind"], "sweep");
    EXPECT_EQ(data["steps"].size(), 6);
    // The page's script begins with the step that has a figure; in 1-D that is the plot along the line.
    EXPECT_NE(page.find("<figure class=\"section-plot\" data-run=\"5\">"), std::string::npos);
    EXPECT_EQ(page.find("<figure class=\"viewer\""), std::string::npos);
  }

  TEST_F(Reports, OfSweepsSayWhichKeyHasNoEffect)
  {
    const Outcome outcome = run({"sweep", "case.toml", "--over", "parameters.unused=1,2", "--over", "model.load=1,2"});
    ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
    EXPECT_NE(outcome.out.find("'parameters.unused' changes none of these quantities"), std::string::npos) << outcome.out;
    EXPECT_EQ(outcome.out.find("'model.load' changes none"), std::string::npos);
  }

  TEST_F(Reports, OfSweepsKeepWhatFails)
  {
    const Outcome outcome = run({"sweep", "case.toml", "--over", "constraint.upper=0.05,-1"});
    EXPECT_EQ(outcome.exit_code, 2);
    const Json rows = json("case.sweep/sweep.json")["rows"];
    EXPECT_EQ(rows[0]["status"], "solved");
    EXPECT_EQ(rows[1]["status"], "bad input");
    EXPECT_FALSE(rows[1]["message"].get<std::string>().empty());
  }

  TEST_F(Reports, OfSweepsAskForWhatIsMissing)
  {
    EXPECT_EQ(run({"sweep", "case.toml"}).exit_code, 2);
    EXPECT_EQ(run({"sweep", "case.toml", "--over", "mesh.refine"}).exit_code, 2);
    EXPECT_EQ(run({"sweep", "case.toml", "--over", "mesh.refine=1,,2"}).exit_code, 2);
    EXPECT_EQ(run({"sweep", "case.toml", "--over", "mesh.refin=1,2"}).exit_code, 2);
    EXPECT_EQ(run({"sweep", "case.toml", "--over", "mesh.refine=1:2:1000000"}).exit_code, 2);
    EXPECT_FALSE(fs::exists(work() / "case.sweep"));
  }

  TEST_F(Reports, OfSweepsThatAreInterruptedLeaveNobodyRunning)
  {
    const pid_t child = start({"sweep", "case.toml", "--over", "constraint.upper=0.04:0.06:40", "--set", "mesh.refine=12", "-o", "s"});
    // Not before it has started a run: until then a busy machine may still be loading its libraries.
    const auto has_started_a_run = [&]
    {
      std::ifstream children(fmt::format("/proc/{0}/task/{0}/children", child));
      pid_t         first = 0;
      return bool(children >> first);
    };
    for (unsigned tenths = 0; tenths < 600 && !has_started_a_run(); ++tenths)
      std::this_thread::sleep_for(std::chrono::milliseconds(100));
    std::this_thread::sleep_for(std::chrono::milliseconds(500));
    kill(child, SIGTERM);
    EXPECT_EQ(finish(child).exit_code, 130);
    EXPECT_FALSE(fs::exists(work() / "s/sweep.json"));
  }
} // namespace
