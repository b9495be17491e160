// The same cases on one, two and three processes: the numbers do not know how many there were.
#include "several_processes.h"

#include <algorithm>
#include <chrono>
#include <csignal>
#include <functional>
#include <sstream>
#include <thread>
#include <vector>

#include <unistd.h>

namespace
{
  using namespace several_processes;
} // namespace

TEST(Processes, ShareAMembraneOnASquare)
{
  // The way to the solution is not quite the same: where the free boundary crosses a cut, relaxation does not go from node to node.
  expect_independence(example("membrane-over-ball"), "--set mesh.refine=5 --set method.tolerance=1e-10", 1e-8);
  expect_independence(example("membrane-over-ball"), "--set mesh.refine=5", 2e-7); // the default, 1e-8
}

TEST(Processes, DivideAMeshInSteps)
{
  const CaseFile triangles("mesh.box = [[-1, -1], [1, 1]]\nmesh.cells = [10, 8]\nmesh.refine = 5\nmodel = { kind = \"membrane\", element = "
                           "\"P1\", load = -4 }\nboundary.all = 0\nconstraint.lower = \"-0.3 - x^2 - y^2\"\nmethod = { solver = "
                           "\"multigrid\", tolerance = 1e-10 }\n");
  const ProgramRun one = run(1, triangles.name), twenty = run(20, triangles.name);
  ASSERT_EQ(twenty.exit_code, 0) << twenty.log;
  EXPECT_NE(twenty.run_log.find("5 groups of 4 processes share the mesh of 10240 cells"), std::string::npos) << twenty.run_log;
  EXPECT_NE(twenty.run_log.find("20 processes share the mesh of 40960 cells"), std::string::npos);
  expect_same(one.results, twenty.results, 1e-8, the_way);
  expect_as_many_steps(one.results, twenty.results);
  // Twenty parts have many cuts, which the bound pays for.
  EXPECT_TRUE(twenty.results["estimate"]["guaranteed"].get<bool>());
  EXPECT_NEAR(number(twenty.results, "/estimate/total"), number(one.results, "/estimate/total"),
              0.1 * number(one.results, "/estimate/total"));
}

TEST(Processes, StudyMeshesTogether)
{
  // Differences of levels, of which the finest two are divided, the one before is divided for its difference, the coarser ones never are.
  const std::string box =
    "mesh.box = [[0, 0], [1, 1]]\nmesh.cells = 8\nmesh.refine = 4\nmodel = { kind = \"membrane\", load = -4, element = \"";
  for (const std::string element : {"Q2", "P1"})
  {
    const CaseFile   membrane(box + element +
                              "\" }\nboundary.all = 0\nconstraint.lower = -0.1\nmethod = { solver = \"multigrid\", tolerance = 1e-10 }\n");
    const ProgramRun one = run(1, membrane.name, "", false, "study mesh"), two = run(2, membrane.name, "", true, "study mesh");
    ASSERT_EQ(two.exit_code, 0) << two.log;
    ASSERT_EQ(one.results["rows"].size(), 5u);
    const std::set<std::string> skip = {"seconds", "newton_iterations", "linear_iterations", "penalty_error_bound", "rates"};
    expect_same(one.results["rows"], two.results["rows"], 1e-6, skip);
    EXPECT_GT(number(two.results, "/rows/3/differences/H1_semi"), 0);
  }
  const ProgramRun adaptive = run(2, example("membrane-to-a-tolerance"), "--adaptive --levels 4", false, "study mesh");
  EXPECT_EQ(adaptive.exit_code, 0) << adaptive.log;
  EXPECT_EQ(adaptive.files.count("study_mesh_adaptive.csv"), 1u);
  const ProgramRun others = run(2, example("string-over-parabola"), "--levels 2", false, "infsup");
  EXPECT_EQ(others.exit_code, 0) << others.log;
  EXPECT_NE(others.log.find("this command is work for one process: of 2 the first does it"), std::string::npos) << others.log;
}

TEST(Processes, TakeSomeOfTheValuesOrRulesOfAStudy)
{
  const std::set<std::string> skip = {"seconds", "newton_iterations", "linear_iterations"};
  for (const unsigned n : {2, 3})
  {
    const std::string options = "--values 1e-1,1e-2,1e-3,1e-4,1e-6";
    const ProgramRun  one = run(1, example("string-over-parabola"), options, false, "study epsilon"),
                     several = run(n, example("string-over-parabola"), options, false, "study epsilon");
    ASSERT_EQ(several.exit_code, 0) << several.log;
    ASSERT_EQ(several.results["rows"].size(), 5u);
    for (const std::string key : {"rows", "reference", "constants", "slopes"})
      if (one.results.contains(key))
        expect_same(one.results[key], several.results[key], 1e-6, skip, key);
    EXPECT_TRUE(several.results.contains("constants")) << several.results;
  }
  // More processes than rules, one of which the element does not take.
  const std::string rules = "--rules \"nodal,gauss(1),edges\"";
  const CaseFile    membrane("mesh.box = [[0, 0], [1, 1]]\nmesh.cells = 16\nmodel.kind = \"membrane\"\nmodel.load = -4\nboundary.all = 0\n"
                                "constraint.lower = -0.1\n");
  const ProgramRun  one = run(1, membrane.name, rules, false, "study quadrature"),
                   four = run(4, membrane.name, rules, false, "study quadrature");
  ASSERT_EQ(four.exit_code, one.exit_code) << four.log;
  ASSERT_EQ(four.results["rows"].size(), 3u);
  expect_same(one.results["rows"], four.results["rows"], 1e-9, skip);
}

TEST(Processes, AreStartedByAnOption)
{
  const CaseFile   membrane("mesh.box = [[0, 0], [1, 1]]\nmesh.cells = 8\nmesh.refine = 4\nmodel.kind = \"membrane\"\nmodel.load = -4\n"
                              "boundary.all = 0\nconstraint.lower = -0.1\n");
  const ProgramRun two = run(2, membrane.name, "", true);
  EXPECT_EQ(two.exit_code, 0) << two.log;
  EXPECT_EQ(two.results["program"]["mpi_ranks"], 2);
  EXPECT_EQ(two.log.find("\x1b["), std::string::npos) << two.log;
  const ProgramRun contradiction = run(2, membrane.name, "-n 3");
  EXPECT_EQ(contradiction.exit_code, 2);
  EXPECT_NE(contradiction.log.find("mpirun has started 2 processes, and -n says 3"), std::string::npos) << contradiction.log;
}

namespace
{
  std::string text_of(const fs::path &file)
  {
    std::ostringstream text;
    text << std::ifstream(file, std::ios::binary).rdbuf();
    return text.str();
  }

  bool wait_until(const std::function<bool()> &condition)
  {
    for (unsigned i = 0; i < 600; ++i, std::this_thread::sleep_for(std::chrono::milliseconds(100)))
      if (condition())
        return true;
    return false;
  }

  /// The process that was started last of those that are this program and have @p word among their arguments; 0: none.
  pid_t last_process_with(const std::string &word)
  {
    pid_t           last = 0;
    std::error_code gone;
    for (const auto &entry : fs::directory_iterator("/proc", gone))
      if (const std::string name = entry.path().filename(), arguments = text_of(entry.path() / "cmdline");
          name.find_first_not_of("0123456789") == std::string::npos && arguments.starts_with(PROGRAM) &&
          arguments.find(word) != std::string::npos)
        last = std::max(last, pid_t(std::stol(name)));
    return last;
  }
} // namespace

TEST(Processes, AreAllEndedWithOneMessageWhenOneDies)
{
  const CaseFile    membrane("mesh.box = [[0, 0], [1, 1]]\nmesh.cells = 8\nmesh.refine = 9\nmodel.kind = \"membrane\"\nmodel.load = -4\n"
                                "boundary.all = 0\nconstraint.lower = -0.1\n");
  const std::string log = membrane.name + ".log", folder = membrane.name + ".out";
  const std::string command = "(env -i PATH=\"$PATH\" HOME=\"${HOME:-/}\" OMPI_MCA_btl_vader_single_copy_mechanism=none '" PROGRAM
                              "' run -n 2 '" +
                              membrane.name + "' -o '" + folder + "' > '" + log + "' 2>&1; echo \"code $?\" >> '" + log + "') &";
  ASSERT_EQ(std::system(command.c_str()), 0);
  ASSERT_TRUE(wait_until([&] { return text_of(log).find("    3  ") != std::string::npos; })) << text_of(log); // a row of the table
  const pid_t victim = last_process_with(membrane.name);
  ASSERT_GT(victim, 0);
  kill(victim, SIGKILL);
  ASSERT_TRUE(wait_until([&] { return text_of(log).find("code ") != std::string::npos; })) << text_of(log);
  EXPECT_NE(text_of(log).find("a process was ended by signal 9 (Killed), and the others with it: the results are not complete"),
            std::string::npos)
    << text_of(log);
  EXPECT_NE(text_of(log).find("code 1\n"), std::string::npos) << text_of(log);
  EXPECT_FALSE(fs::exists(folder));
  fs::remove(log);
}

namespace
{
  /// A run that two processes leave and three go on with.
  class ResumedRun
  {
  public:
    explicit ResumedRun(const std::string &text, const std::string &options = "") : file(text), folder(file.name + ".out"), options(options)
    {
    }
    ~ResumedRun()
    {
      fs::remove_all(folder);
      fs::remove(log_file());
    }

    /// By SIGINT, as soon as @p ready; @p change: options of this run alone.
    template <typename Ready>
    void interrupt(const std::string &change, const Ready &ready) const
    {
      ASSERT_EQ(std::system(("(" + command(2) + change + to_log() + "; echo \"code $?\" >> '" + log_file() + "') &").c_str()), 0);
      ASSERT_TRUE(wait_until(ready)) << log();
      kill(last_process_with(file.name), SIGINT);
      ASSERT_TRUE(wait_until([&] { return log().find("code ") != std::string::npos; })) << log();
      EXPECT_NE(log().find("code 130\n"), std::string::npos) << log();
    }

    /// The results are those of one process.
    void resume(const std::string &said, const double tolerance) const
    {
      EXPECT_EQ(std::system((command(3) + " --resume" + to_log()).c_str()), 0) << log();
      EXPECT_NE(log().find(said), std::string::npos) << log();
      EXPECT_FALSE(fs::exists(folder + "/restart.json"));
      const Json resumed = Json::parse(std::ifstream(folder + "/results.json")), alone = run(1, file.name).results;
      for (const std::string pointer : {"/solution/energy", "/constraint/0/total_contact_force"})
        EXPECT_NEAR(number(resumed, pointer), number(alone, pointer), tolerance * std::abs(number(alone, pointer))) << pointer;
    }

    std::string log() const { return text_of(log_file()); }

  private:
    std::string log_file() const { return file.name + ".log"; }
    std::string to_log() const { return " > '" + log_file() + "' 2>&1"; }
    std::string command(const unsigned n) const
    {
      return clean_environment + "mpirun -n " + std::to_string(n) + " '" PROGRAM "' run '" + file.name + "' -o '" + folder + "'" + options;
    }

  public:
    const CaseFile    file;
    const std::string folder;

  private:
    const std::string options;
  };
} // namespace

TEST(Processes, GoOnWithTheMeshThatOthersHaveLeft)
{
  const ResumedRun membrane("mesh.box = [[0, 0], [1, 1]]\nmesh.cells = 8\nmesh.adapt = { tolerance = 0.01 }\nmodel.kind = \"membrane\"\n"
                            "model.load = -4\nboundary.all = 0\nconstraint.lower = -0.1\n");
  const auto       mesh_left = [&]
  {
    const Json restart = Json::parse(text_of(membrane.folder + "/restart.json"), nullptr, false);
    return restart.is_object() ? restart["mesh"].get<unsigned>() : 0;
  };
  membrane.interrupt(" --set 'mesh.adapt={ tolerance = 1e-9, max_unknowns = 100000000 }'", [&] { return mesh_left() >= 6; });
  EXPECT_TRUE(fs::exists(membrane.folder + "/restart-" + std::to_string(mesh_left()) + "-1.bin"))
    << "the second process has left its cells";
  membrane.resume("resumed with the mesh of ", 2e-3);
}

TEST(Processes, GoOnWithTheLevelThatOthersHaveLeft)
{
  const ResumedRun body(
    "mesh.box = [[0, 0, 0], [1, 1, 1]]\nmesh.cells = 4\nmesh.refine = 4\nmodel.kind = \"elasticity\"\nmodel.young = 100\n"
    "model.poisson = 0.3\nboundary.top.pressure = 1\nboundary.left = { x = 0, y = 0 }\n"
    "constraint = { on = \"bottom\", gap = \"0.005*((x - 0.3)^2 + (y - 0.4)^2)\" }\n",
    " -v");
  body.interrupt("", [&] { return body.log().find("solve: level 4") != std::string::npos; });
  EXPECT_TRUE(fs::exists(body.folder + "/restart-4-1.bin")) << "the second process has left its part";
  body.resume("resumed on level 4", 1e-7);
}

TEST(Processes, ShareADisc)
{
  // The pressure is what the penalty makes of the last digits of u: they have to be there.
  expect_independence(example("disc-under-ceiling"), "--set mesh.refine=5 --set method.tolerance=1e-10", 1e-7);
}

TEST(Processes, ShareARuleWithPointsInsideTheCells)
{
  expect_independence(example("membrane-over-ball"),
                      "--set mesh.refine=4 --set method.solver=multigrid --set constraint.quadrature='gauss(2)'", 1e-6);
}

TEST(Processes, ShareABody)
{
  expect_independence(example("hertz-line"), "--set mesh.refine=4 --set method.solver=multigrid", 1e-6);
}

TEST(Processes, ShareABodyThatNotAllOfThemSeeInContact)
{
  // A tall body on the ground: the upper half has no face there.
  const CaseFile body("mesh.box = [[0, 0], [1, 4]]\nmesh.cells = [4, 16]\nmesh.refine = 4\n"
                      "model.kind = \"elasticity\"\nmodel.young = 1\nmodel.poisson = 0.3\n"
                      "boundary.top = [0, -0.05]\nconstraint.on = \"bottom\"\nconstraint.gap = \"0.1*x^2\"\n");
  expect_independence(body.name, "--set method.solver=multigrid", 1e-6);
}

TEST(Processes, ShareAFormThatIsNotSymmetric)
{
  const CaseFile velocity("mesh.box = [[0, 0], [1, 1]]\nmesh.cells = [8, 8]\nmesh.refine = 4\n"
                          "model.kind = \"membrane\"\nmodel.load = -1\nmodel.velocity = [20, -10]\n"
                          "boundary.all = 0\nconstraint.lower = -0.02\noutput.probes = [[0.5, 0.5], [0.9, 0.2]]\n");
  expect_independence(velocity.name, "--set method.solver=multigrid", 1e-6, {2, 3, 4});
}

TEST(Processes, ShareABodyThatOnlyContactHolds)
{
  // Contact does not feel a translation along x, which a side condition stops at one node: on whichever process that is.
  const CaseFile body("mesh.box = [[0, 0], [1, 1]]\nmesh.cells = [8, 8]\nmesh.refine = 4\n"
                      "model.kind = \"elasticity\"\nmodel.young = 1\nmodel.poisson = 0.3\n"
                      "boundary.top = { traction = [0, \"-0.05*(1 + 0.2*x)\"] }\n"
                      "constraint.on = \"bottom\"\nconstraint.gap = \"0.1*(x - 0.5)^2\"\n"
                      "output.probes = [[0, 1], [1, 1], [0.5, 0]]\n");
  expect_independence(body.name, "--set method.solver=multigrid", 1e-6);
  const ProgramRun two = run(2, body.name, "--set method.solver=multigrid");
  // The whole load is on the obstacle, and the side condition bears nothing.
  EXPECT_NEAR(two.results["constraint"][0]["total_contact_force"].get<double>(), 0.055, 1e-7) << two.results["constraint"];
  EXPECT_LT(two.results["balance"]["side_conditions"].get<double>(), 1e-8) << two.results["balance"];
}

TEST(Processes, ShareAMembraneThatOnlyAnObstacleHolds)
{
  const CaseFile membrane("mesh.box = [[0, 0], [1, 1]]\nmesh.cells = [8, 8]\nmesh.refine = 4\n"
                          "model.kind = \"membrane\"\nmodel.load = -1\nconstraint.lower = \"-0.2*((x - 0.4)^2 + (y - 0.5)^2)\"\n"
                          "output.probes = [[0, 0], [1, 1]]\n");
  expect_independence(membrane.name, "--set method.solver=multigrid", 1e-6);
}

namespace
{
  /// A block that is pressed down on a round bump, on one side more than on the other.
  std::string block_on_bump(const std::string &element, const std::string &cells, const unsigned refine)
  {
    return "mesh.box = [[0, 0, 0], [1, 1, 1]]\nmesh.cells = " + cells + "\nmesh.refine = " + std::to_string(refine) +
           "\nmodel.kind = \"elasticity\"\nmodel.element = \"" + element +
           "\"\nmodel.young = 1\nmodel.poisson = 0.3\n"
           "boundary.back = [0, 0, \"-0.02*(1 + 0.3*x)\"]\nboundary.left = { x = 0 }\n"
           "constraint.on = \"front\"\nconstraint.gap = \"0.03*((x - 0.4)^2 + (y - 0.5)^2)\"\n"
           "output.probes = [[0.5, 0.5, 0], [1, 1, 0]]\n";
  }
} // namespace

TEST(Processes, ShareQuadraticTetrahedraOfAMeshWithoutRefinement)
{
  const CaseFile block(block_on_bump("P2", "[8, 8, 10]", 0));
  expect_independence(block.name, "--set method.solver=amg", 1e-6);
}

TEST(Processes, ShareElementsOfDegree1ThatNobodyRefines)
{
  const CaseFile tetrahedra(block_on_bump("P1", "[8, 8, 10]", 0));
  expect_independence(tetrahedra.name, "--set method.solver=amg", 1e-6, {3}, 0.12);
  // Too large to be brought together as it is: aggregates on each part, and others on the cuts.
  const CaseFile hexahedra(block_on_bump("Q1", "[20, 20, 22]", 0));
  expect_independence(hexahedra.name, "--set method.solver=amg", 1e-6, {2});
  EXPECT_NE(run(2, hexahedra.name, "--set method.solver=amg").run_log.find("on 2 levels, divided among 2 processes"), std::string::npos);
}

TEST(Processes, ShareNearlyIncompressibleBodies)
{
  // Tensions at vertices, some of them on cuts.
  const CaseFile block(block_on_bump("P2", "[6, 6, 12]", 0));
  expect_independence(block.name, "--set method.solver=amg --set method.tolerance=1e-9 --set model.poisson=0.4999", 1e-4, {2});
  const ProgramRun two = run(2, block.name, "--set method.solver=amg --set model.poisson=0.499999");
  EXPECT_EQ(two.exit_code, 0) << two.log;
  EXPECT_LT(number(two.results, "/balance/residual"), 1e-6);
  EXPECT_NE(two.run_log.find("2 processes share the mesh"), std::string::npos) << two.run_log;
  // Of hexahedra they are projected cell by cell.
  const CaseFile hexahedra(block_on_bump("Q1", "[12, 12, 14]", 0));
  expect_independence(hexahedra.name, "--set method.solver=amg --set method.tolerance=1e-9 --set model.poisson=0.499", 1e-4, {2});
}

TEST(Processes, ShareLinearTetrahedraOfARefinedMesh)
{
  const CaseFile block(block_on_bump("P1", "[8, 8, 7]", 1));
  expect_independence(block.name, "--set method.solver=amg --set method.tolerance=1e-10", 1e-6, {2}); // the pressure has these digits
}

TEST(Processes, ShareHexahedraWithAssembledMatrices)
{
  const CaseFile block("mesh.box = [[0, 0], [1, 1]]\nmesh.cells = [50, 50]\nmodel.kind = \"elasticity\"\nmodel.element = \"Q2\"\n"
                       "model.young = 1\nmodel.poisson = 0.3\nboundary.top = [0, \"-0.02*(1 + 0.3*x)\"]\n"
                       "constraint.on = \"bottom\"\nconstraint.gap = \"0.05*(x - 0.4)^2\"\noutput.probes = [[0.5, 0], [1, 0.5]]\n");
  expect_independence(block.name, "--set method.solver=amg --set method.tolerance=1e-10", 1e-6, {2});
}

TEST(Processes, ShareTrianglesWithoutMatrices)
{
  const CaseFile membrane(
    "mesh.box = [[0, 0], [1, 1]]\nmesh.cells = [10, 10]\nmesh.refine = 4\nmodel.kind = \"membrane\"\nmodel.element = \"P2\"\n"
    "model.load = -1\nboundary.all = 0\nconstraint.lower = -0.02\noutput.probes = [[0.5, 0.5], [0.9, 0.2]]\n");
  expect_independence(membrane.name, "--set method.solver=multigrid", 1e-6);
}

TEST(Processes, ShareCurvedTriangles)
{
  expect_independence(example("disc-under-ceiling"),
                      "--set model.element=P2 --set mesh.refine=6 --set method.solver=amg --set method.tolerance=1e-10", 1e-6, {2});
}

TEST(Processes, ShareCurvedCellsOfADrawing)
{
  const CaseFile ball("mesh.file = \"" PROJECT_DIR
                      "/tests/data/ball.geo\"\nmesh.refine = 2\nmodel.kind = \"membrane\"\nmodel.element = \"P2\"\n"
                      "model.load = 6\nboundary.all = 0\nconstraint.upper = 0.3\noutput.probes = [[0.1, 0.2, 0.1], [0.5, 0.1, 0.2]]\n");
  expect_independence(ball.name, "--set method.solver=amg", 1e-6, {2});
}

TEST(Processes, ShareTetrahedraThatOnlyContactHolds)
{
  const CaseFile block("mesh.box = [[0, 0, 0], [1, 1, 1]]\nmesh.cells = [8, 8, 8]\nmodel.kind = \"elasticity\"\nmodel.element = \"P2\"\n"
                       "model.young = 1\nmodel.poisson = 0.3\n"
                       "boundary.back = { traction = [0, 0, \"-0.01*(1 + 0.5*x + 0.2*y)\"] }\n"
                       "constraint.on = \"front\"\nconstraint.gap = \"0.03*((x - 0.4)^2 + (y - 0.5)^2)\"\n"
                       "output.probes = [[0.5, 0.5, 1]]\n");
  expect_independence(block.name, "--set method.solver=amg", 1e-6, {2});
  expect_independence(block.name, "--set method.solver=amg --set model.element=P1 --set mesh.cells=10", 1e-6, {2});
}

TEST(Processes, FindOnPartsThatNothingStopsAMotion)
{
  // The error of one process, once: the load lifts the body.
  const CaseFile   body("mesh.box = [[0, 0], [1, 1]]\nmesh.cells = [8, 8]\nmesh.refine = 4\n"
                          "model.kind = \"elasticity\"\nmodel.young = 1\nmodel.poisson = 0.3\n"
                          "boundary.top = { traction = [0, 0.05] }\nconstraint.on = \"bottom\"\nconstraint.gap = \"0.1*(x - 0.5)^2\"\n");
  const ProgramRun two = run(2, body.name);
  EXPECT_EQ(two.exit_code, 2) << two.log;
  EXPECT_NE(two.log.find("nothing stops"), std::string::npos) << two.log;
}

TEST(Processes, SolveAloneWhatCannotBeShared)
{
  const ProgramRun two = run(2, example("string-over-parabola"));
  EXPECT_EQ(two.exit_code, 0) << two.log;
  // Which is said once.
  const auto said = two.run_log.find("every process solves the whole problem");
  ASSERT_NE(said, std::string::npos) << two.run_log;
  EXPECT_EQ(two.run_log.find("every process solves the whole problem", said + 1), std::string::npos) << two.run_log;
  EXPECT_EQ(two.files.count("solution.vtu"), 1u);
  EXPECT_EQ(two.files.count("solution.pvtu"), 0u);
}

TEST(Processes, ShareABodyOfCubicTriangles)
{
  // Unknowns at one node do not follow each other, and on cuts come in another order on the other side.
  const CaseFile body("mesh.box = [[0, 0], [2, 1]]\nmesh.cells = [48, 24]\n[model]\nkind = \"elasticity\"\nelement = \"P3\"\nyoung = 1\n"
                      "poisson = 0.3\n[boundary]\ntop = [0, \"-0.05*(1 + 0.1*x)\"]\n[constraint]\non = \"bottom\"\n"
                      "gap = \"0.1*(x - 0.9)^2\"\n");
  expect_independence(body.name, "--set method.solver=amg --set method.tolerance=1e-10", 1e-6, {2});
}

TEST(Processes, SayOnceWhatIsWrong)
{
  const ProgramRun two = run(2, example("membrane-over-ball"), "--set model.element=Q0");
  EXPECT_EQ(two.exit_code, 2) << two.log;
  const auto first = two.log.find("error:");
  ASSERT_NE(first, std::string::npos) << two.log;
  EXPECT_EQ(two.log.find("error:", first + 1), std::string::npos) << two.log;
}

TEST(Processes, ShareAMembraneThatIsRefinedByTheError)
{
  const CaseFile file("[mesh]\nbox = [[-1.5, -1.5], [1.5, 1.5]]\ncells = 48\nadapt = { tolerance = 0.012 }\n"
                      "[model]\nkind = \"membrane\"\nelement = \"Q1\"\nload = -2\n[boundary]\nall = 0\n"
                      "[constraint]\nlower = \"0.3 - (x - 0.2)^2 - 0.7*y^2\"\n[method]\nsolver = \"multigrid\"\n");
  expect_shared_in_places(file, 1e-3);
}

TEST(Processes, ShareAPlaneBodyThatIsRefinedInPlaces)
{
  // The second refinement meets hanging nodes where the mesh is to be divided.
  const CaseFile file("[mesh]\nbox = [[-1, 0], [1, 1]]\ncells = [64, 32]\n"
                      "[[mesh.local]]\nwhere = \"y < 0.5\"\n[[mesh.local]]\nwhere = \"x^2 + y^2 < 0.1\"\n"
                      "[[mesh.local]]\nwhere = \"x^2 + y^2 < 0.06\"\n"
                      "[model]\nkind = \"elasticity\"\nelement = \"Q2\"\nyoung = 100\npoisson = 0.3\n[boundary]\ntop = [0, -0.02]\n"
                      "[constraint]\non = \"bottom\"\ngap = \"0.3*x^2\"\n[method]\nsolver = \"multigrid\"\n");
  expect_shared_in_places(file, 1e-3, {2});
}

TEST(Processes, ShareTrianglesThatAreRefinedByTheError)
{
  const CaseFile file("[mesh]\nbox = [[-2, -2], [2, 2]]\ncells = 20\nadapt = { tolerance = 8e-4 }\n"
                      "[model]\nkind = \"membrane\"\nelement = \"P2\"\nload = -1\n[boundary]\nall = 0\n"
                      "[constraint]\nlower = \"-0.1 - 0.3*(x - 0.3)^2 - 0.2*y^2\"\n[method]\nsolver = \"amg\"\n");
  expect_shared_in_places(file, 1e-4);
}

TEST(Processes, ShareTetrahedraThatAreRefinedInPlaces)
{
  // All edges of the box are of equal length, so that it is decided at the cut which of them are bisected first.
  const CaseFile file("[mesh]\nbox = [[0, 0, 0], [1, 1, 1]]\ncells = 10\n"
                      "[[mesh.local]]\nwhere = \"(x - 0.5)^2 + (y - 0.5)^2 + (z - 1)^2 < 0.1\"\n"
                      "[model]\nkind = \"elasticity\"\nelement = \"P2\"\nyoung = 1000\npoisson = 0.3\n"
                      "[boundary]\nfront = \"clamped\"\n[constraint]\non = \"back\"\n"
                      "gap = \"2*((x - 0.4)^2 + (y - 0.45)^2) - 0.02\"\n[method]\nsolver = \"amg\"\n");
  expect_shared_in_places(file, 1e-3, {2});
}

namespace
{
  /// On a mesh that is refined for the error of a number: the number and its estimated error.
  void expect_same_goal(const CaseFile &file)
  {
    const ProgramRun alone = run(1, file.name), several = run(2, file.name);
    ASSERT_EQ(alone.exit_code, 0) << alone.log;
    ASSERT_EQ(several.exit_code, 0) << several.log;
    EXPECT_NE(several.run_log.find("processes share the mesh"), std::string::npos) << several.run_log;
    const double error = number(alone.results, "/estimate/goal/error");
    EXPECT_NEAR(number(several.results, "/estimate/goal/value"), number(alone.results, "/estimate/goal/value"), 0.1 * error);
    EXPECT_NEAR(number(several.results, "/estimate/goal/error"), error, 0.1 * error);
    EXPECT_NEAR(number(several.results, "/estimate/goal/correction"), number(alone.results, "/estimate/goal/correction"), 0.1 * error);
  }
} // namespace

TEST(Processes, ShareAMembraneThatIsRefinedForAForce)
{
  expect_same_goal(CaseFile("[mesh]\nbox = [[-2, -2], [2, 2]]\ncells = 64\nadapt = { tolerance = 3e-4, goal = \"contact_force\" }\n"
                            "[model]\nkind = \"membrane\"\nelement = \"Q1\"\nload = -1\n[boundary]\nall = \"-0.1*x^2\"\n"
                            "[constraint]\nlower = \"-0.1 - 0.3*(x - 0.3)^2 - 0.2*y^2\"\n[method]\nsolver = \"multigrid\"\n"));
}

TEST(Processes, ShareABodyThatIsRefinedForADisplacementOrAReaction)
{
  // Before the last refinements the mesh is divided. The probe lies near the cut in the middle.
  for (const std::string goal : {"solution.probes.0.value.1", "balance.reactions.0.force.1"})
    expect_same_goal(CaseFile("[mesh]\nbox = [[0, 0], [2, 1]]\ncells = [96, 48]\nadapt = { tolerance = 3e-4, goal = \"" + goal +
                              "\" }\n[model]\nkind = \"elasticity\"\nelement = \"Q1\"\nyoung = 1000\npoisson = 0.3\n"
                              "assumption = \"plane strain\"\n[boundary]\nleft = \"clamped\"\n[constraint]\non = \"top\"\n"
                              "gap = \"(x - 1.6)^2 - 0.03\"\n[output]\nprobes = [[1.003, 0.37]]\n[method]\nsolver = \"multigrid\"\n"));
}

TEST(Processes, BoundTheErrorOfABodyInSpaceThatOnlyContactHolds)
{
  // On a sphere, between nodes, of which some lie on cuts: faces are moved off it.
  const CaseFile body("mesh.box = [[0, 0, 0], [1, 1, 1]]\nmesh.cells = 13\nmodel.kind = \"elasticity\"\nmodel.young = 1\n"
                      "model.poisson = 0.3\nmesh.refine = 1\nboundary.back = { traction = [0, 0, \"-0.01*(1 + 0.2*x)\"] }\n"
                      "boundary.left = { x = 0 }\nboundary.bottom = { y = 0 }\n"
                      "constraint.on = \"front\"\nconstraint.gap = { sphere = { center = [0.4, 0.4, -5], radius = 4.98 } }\n");
  expect_independence(body.name, "--set method.solver=multigrid", 1e-6, {2});
}

TEST(Processes, BoundTheErrorOfABodyOfTwoMaterialsOnSprings)
{
  // With two processes the materials meet at the cut.
  const CaseFile body("mesh.box = [[-1, 0], [1, 1]]\nmesh.cells = [32, 16]\nmesh.refine = 2\nmodel.kind = \"elasticity\"\n"
                      "model.young = \"if(x < 0, 1, 3)\"\nmodel.poisson = 0.3\nboundary.top = { traction = [0.01, -0.05] }\n"
                      "boundary.left = { spring = [0.1, 0] }\nconstraint.on = \"bottom\"\nconstraint.gap = \"0.1*x^2\"\n");
  expect_independence(body.name, "--set method.solver=multigrid", 1e-6, {2});
}

TEST(Processes, ShareAMembraneInSpaceThatIsRefinedInPlaces)
{
  const CaseFile file("[mesh]\nbox = [[0, 0, 0], [1, 1, 1]]\ncells = 16\n[[mesh.local]]\nwhere = \"x + y + z < 0.8\"\n"
                      "[[mesh.local]]\nwhere = \"x + y + z < 0.5\"\n"
                      "[model]\nkind = \"membrane\"\nelement = \"Q1\"\nload = 10\n[boundary]\nall = 0\n"
                      "[constraint]\nupper = 0.2\n[method]\nsolver = \"multigrid\"\n");
  // The cut crosses what is refined twice, so that neither part is much larger than the other; that takes some cells beside it.
  expect_shared_in_places(file, 1e-3, {2}, 0.04);
  EXPECT_LT(largest_parts(run(2, file.name)).back(), 1.1);
}
