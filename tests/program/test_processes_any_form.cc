// Forms, conditions and meshes of every kind on several processes: the numbers do not know how many there were.
#include "block_of_cells.h"
#include "several_processes.h"
#include "text_file.h"

#include <string>

namespace
{
  using namespace several_processes;

  std::string plate(const std::string &boundary, const unsigned cells, const unsigned refine)
  {
    return "mesh.box = [[0, 0], [1000, 700]]\nmesh.cells = " + std::to_string(cells) + "\nmesh.refine = " + std::to_string(refine) +
           "\n[model]\nkind = \"plate\"\nelement = \"hermite\"\nyoung = 70000\npoisson = 0.33\nthickness = 3\n"
           "load = \"-1e-4*(1 + x/1000)\"\n[boundary]\n" +
           boundary + "[constraint]\nlower = -0.2\n[output]\nprobes = [[500, 350], [500, 100], [250, 400]]\n";
  }

  /// Inside a cell, and at a node in the middle, where a cut may be.
  const std::string forces_at_points = "[[point_load]]\nat = [212.3, 333]\nforce = -20\n[[point_load]]\nat = [500, 350]\nforce = 10\n";

  std::string wavy(const std::string &element, const unsigned refine)
  {
    return "mesh.box = [[0, 0], [1, 1.5]]\nmesh.cells = [28, 42]\nmesh.refine = " + std::to_string(refine) +
           "\nmodel = { kind = \"elasticity\", element = \"" + element +
           "\", young = 100, poisson = 0.3 }\nboundary.top.pressure = 0.1\nconstraint.on = \"bottom\"\n"
           "constraint.gap = \"0.001*(1 - cos(2*pi*(x - 0.0625)))\"\noutput.probes = [[0.5, 1.5], [0, 0.3], [1, 0.3]]\n"
           "[[periodic]]\nparts = [\"left\", \"right\"]\n";
  }

  std::string pad(const std::string &element, const std::string &cells)
  {
    return "mesh.box = [[-5, -5, 0], [5, 5, 4]]\nmesh.cells = " + cells + "\n[model]\nkind = \"elasticity\"\nelement = \"" + element +
           "\"\nyoung = 20\npoisson = 0.3\n[boundary]\n"
           "\"z+\" = { rigid = true, force = [0, 0, -100], about = [1, 0.5, 4] }\n[constraint]\non = \"z-\"\n"
           "gap = \"0.01*(x^2 + y^2)/25\"\n[method]\nformulation = \"mixed\"\n";
  }
} // namespace

TEST(ProcessesAnyForm, ShareAPlateAndItsFactors)
{
  const CaseFile file(plate("all = \"simply supported\"\nleft = \"clamped\"\n", 24, 2));
  expect_independence(file.name, "--set method.solver=direct", 1e-6, {2});
  EXPECT_NE(run(2, file.name, "--set method.solver=direct").run_log.find("MUMPS"), std::string::npos);
}

TEST(ProcessesAnyForm, ShareAPlateUnderForcesAtItsEdges)
{
  const CaseFile file(plate("left = \"clamped\"\nright = { force = -0.01, moment = 1, spring = 1e-4 }\n", 24, 2) + forces_at_points);
  expect_independence(file.name, "--set method.solver=direct", 1e-6, {2});
  // The free edges bear nothing, nor are they listed.
  const ProgramRun two = run(2, file.name, "--set method.solver=direct");
  ASSERT_EQ(two.results["reactions"].size(), 1u) << two.results["reactions"];
  EXPECT_EQ(two.results["reactions"][0]["on"], "left");
}

TEST(ProcessesAnyForm, SharePlatesWithTermsBetweenCells)
{
  const std::string direct = "--set method.solver=direct --set model.element=";
  const CaseFile    held(plate("all = \"simply supported\"\nleft = \"clamped\"\nright = { value = 0.1, slope = -2e-4 }\n", 56, 0) +
                         "[exact]\nu = \"1e-4*x*sin(y/300)\"\n"); // a function to be held against, whatever it is
  expect_independence(held.name, direct + "c0ip2", 1e-6, {2});
  expect_independence(held.name, direct + "c0ip2-triangles", 1e-6, {3});
  const CaseFile bent(plate("left = \"clamped\"\nright = { force = -0.01, moment = 1, spring = 1e-4 }\n", 36, 0) + forces_at_points);
  expect_independence(bent.name, direct + "c0ip3-triangles", 1e-6, {2});
}

TEST(ProcessesAnyForm, ShareARoundPlateWithTermsBetweenCells)
{
  const CaseFile file("[mesh]\nball = { center = [0, 0], radius = 1 }\nrefine = 5\n[model]\nkind = \"plate\"\nelement = \"c0ip2\"\n"
                      "rigidity = 1\npoisson = 0.3\nload = -64\n[boundary]\nall = \"clamped\"\n[constraint]\nlower = \"-0.3 + 0.1*x\"\n"
                      "[method]\nsolver = \"direct\"\n");
  expect_independence(file.name, "", 1e-6, {2});
}

TEST(ProcessesAnyForm, ShareAPlateWithTermsBetweenCellsThatIsRefinedInPlaces)
{
  const CaseFile file("[mesh]\nbox = [[-1, -1], [1, 1]]\ncells = [66, 62]\n[[mesh.local]]\nwhere = \"hypot(abs(x) - 0.4, y) < 0.25\"\n"
                      "[model]\nkind = \"plate\"\nelement = \"c0ip2\"\nrigidity = 1\npoisson = 0.3\nload = -64\n"
                      "[boundary]\nall = \"clamped\"\n[constraint]\nlower = \"-0.3 + 0.1*x\"\n[method]\nsolver = \"direct\"\n");
  expect_shared_in_places(file, 1e-5, {2}); // the cut passes between the two places
}

TEST(ProcessesAnyForm, ShareAVelocityWithAssembledMatrices)
{
  const CaseFile file("mesh.box = [[0, 0], [1, 1]]\nmesh.cells = [28, 28]\nmesh.refine = 2\n"
                      "model = { kind = \"membrane\", element = \"Q2\", load = -1, velocity = [20, -10] }\n"
                      "boundary.all = 0\nconstraint.lower = -0.02\noutput.probes = [[0.5, 0.5], [0.9, 0.2]]\n");
  expect_independence(file.name, "--set method.solver=direct", 1e-6);
  expect_independence(file.name, "--set method.solver=amg --set method.tolerance=1e-10", 1e-6, {2});
}

TEST(ProcessesAnyForm, SharePeriodicParts)
{
  const CaseFile squares(wavy("Q1", 2)), triangles(wavy("P2", 1));
  expect_independence(squares.name, "--set method.solver=amg --set method.tolerance=1e-10", 1e-5);
  expect_independence(triangles.name, "--set method.solver=amg --set method.tolerance=1e-10", 1e-5, {2});
}

TEST(ProcessesAnyForm, ShareABodyUnderARigidPlaten)
{
  const CaseFile file(pad("P2", "[9, 9, 8]"));
  expect_independence(file.name, "--set method.solver=amg --set method.tolerance=1e-10", 1e-5);
}

TEST(ProcessesAnyForm, ShareHexahedraInPlacesWithAssembledMatrices)
{
  const CaseFile file("[mesh]\nbox = [[-1, -1, 0], [1, 1, 1]]\ncells = [20, 20, 10]\n"
                      "[[mesh.local]]\nwhere = \"(x^2 + y^2 < 0.4)*(z < 0.5)\"\n[[mesh.local]]\nwhere = \"(x^2 + y^2 < 0.1)*(z < 0.25)\"\n"
                      "[model]\nkind = \"elasticity\"\nelement = \"Q1\"\nyoung = 1000\npoisson = 0.3\n"
                      "[boundary]\n\"z+\" = [0, 0, -0.02]\n[constraint]\non = \"z-\"\ngap = \"0.1*(x^2 + y^2)\"\n"
                      "[method]\nsolver = \"amg\"\nformulation = \"mixed\"\n");
  expect_shared_in_places(file, 3e-3, {2});
}

TEST(ProcessesAnyForm, ShareCurvedCellsThatAreRefinedInPlaces)
{
  const std::string rest = "[boundary]\nall = 0\n[constraint]\nlower = -0.3\n[method]\nformulation = \"mixed\"\n";
  const CaseFile    disc("[mesh]\nball = { center = [0, 0], radius = 1 }\nrefine = 5\n[[mesh.local]]\nwhere = \"x > 0.2\"\n"
                            "[[mesh.local]]\nwhere = \"hypot(x - 0.5, y) < 0.3\"\n[model]\nkind = \"membrane\"\nelement = \"Q2\"\nload = -5\n" +
                         rest + "solver = \"multigrid\"\n");
  expect_shared_in_places(disc, 1e-3, {2});
  const CaseFile triangles("[mesh]\nball = { center = [0, 0], radius = 1 }\nrefine = 5\n[[mesh.local]]\nwhere = \"x > 0.2\"\n"
                           "[model]\nkind = \"membrane\"\nelement = \"P2\"\nload = -5\n" +
                           rest + "solver = \"amg\"\n");
  expect_shared_in_places(triangles, 1e-3, {2});
}

TEST(ProcessesAnyForm, ShareTetrahedraOfAShellThatAreRefinedInPlaces)
{
  const CaseFile file("mesh.shell = { center = [0, 0, 0], inner = 0.5 }\nmesh.refine = 2\n[[mesh.local]]\nwhere = \"z < -0.9\"\n"
                      "[model]\nkind = \"elasticity\"\nelement = \"P1\"\nyoung = 100\npoisson = 0.3\n"
                      "[boundary]\ninner = { pressure = 1, spring = 3 }\n[constraint]\non = \"outer\"\n"
                      "gap = { plane = { point = [0, 0, -1.001], normal = [0, 0, 1] } }\n[method]\nsolver = \"amg\"\n");
  expect_shared_in_places(file, 1e-3, {2});
}

TEST(ProcessesAnyForm, GetTheirPartsOfAMeshFromTheFirst)
{
  const CaseFile   file(pad("P2", "[9, 9, 8]"));
  const ProgramRun two = run(2, file.name, "--set method.solver=amg");
  EXPECT_EQ(two.exit_code, 0) << two.log;
  EXPECT_NE(two.run_log.find("which the first one has made"), std::string::npos) << two.run_log;
  EXPECT_NEAR(number(two.results, "/constraint/0/total_contact_force"), 100, 1e-5);
  const ProgramRun wrong = run(2, file.name, "--set method.solver=amg --set constraint.on=nowhere");
  EXPECT_EQ(wrong.exit_code, 2) << wrong.log;
  const auto said = wrong.log.find("error:");
  ASSERT_NE(said, std::string::npos) << wrong.log;
  EXPECT_EQ(wrong.log.find("error:", said + 1), std::string::npos) << wrong.log;
}

TEST(ProcessesAnyForm, ReadAMeshFileInPieces)
{
  const BlockOfTetrahedra block(9);
  const std::string       rest = "[model]\nkind = \"elasticity\"\nelement = \"P1\"\nyoung = 100\npoisson = 0.3\n"
                                 "[boundary]\n\"z+\" = { pressure = 1 }\n\"x-\" = { x = 0 }\n\"y-\" = { y = 0 }\n"
                                 "[constraint]\non = \"z-\"\ngap = \"0.01*((x - 0.3)^2 + (y - 0.4)^2)\"\n"
                                 "[method]\nsolver = \"amg\"\ntolerance = 1e-10\n[output]\nprobes = [[0.2, 0.3, 0.9]]\n";
  const auto              case_with = [&](const TextFile &mesh) { return "mesh.file = \"" + mesh.name + "\"\n" + rest; };
  const TextFile          plain(".msh", block.text());
  const CaseFile          file(case_with(plain));
  expect_independence(file.name, "", 1e-5);
  EXPECT_NE(run(3, file.name).run_log.find("of which each has read a part"), std::string::npos);

  // What is wrong at cuts is said as by one process.
  auto folded = block, hanging = block;
  folded.cells.push_back(block.faces.at("x-")[40]);
  folded.cells.back().push_back(block.cells.back().front());
  const auto cut = block.cells[6 * 364]; // beside the middle, where the mesh is cut
  hanging.nodes.push_back({0, 0, 0});
  for (unsigned d = 0; d < 3; ++d)
    hanging.nodes.back()[d] = (block.nodes[cut[0]][d] + block.nodes[cut[1]][d]) / 2;
  hanging.cells[6 * 364][0] = hanging.nodes.size() - 1;
  hanging.cells.push_back(cut);
  hanging.cells.back()[1] = hanging.nodes.size() - 1;
  for (const auto &wrong : {folded, hanging})
  {
    const TextFile   text(".msh", wrong.text());
    const CaseFile   with_mistake(case_with(text));
    const ProgramRun one = run(1, with_mistake.name), two = run(2, with_mistake.name);
    EXPECT_EQ(one.exit_code, 2) << one.log;
    EXPECT_EQ(two.exit_code, 2) << two.log;
    const auto message = [](const std::string &log) { return log.substr(std::min(log.find("error:"), log.size())); };
    EXPECT_EQ(message(two.log).substr(0, 80), message(one.log).substr(0, 80));
  }
}

TEST(ProcessesAnyForm, ReadHexahedraInPieces)
{
  BlockOfHexahedra block(15);
  for (auto &x : block.nodes)
    x = {x[0] + 0.02 * std::sin(6 * x[1] * x[2]), x[1] + 0.1 * x[0] * x[2], x[2] + 0.05 * std::sin(3 * x[0]) * (1 - x[2]) * x[2]};
  const TextFile mesh(".msh", block.text_of_format_2());
  const CaseFile file(
    "mesh.file = \"" + mesh.name +
    "\"\n[[part]]\nname = \"foot\"\nwhere = \"z < 1e-9 && x > 0.2\"\n[model]\nkind = \"elasticity\"\nyoung = 100\npoisson = 0.3\n"
    "[boundary]\n\"z+\" = { pressure = 1 }\n\"x-\" = { x = 0, y = 0 }\n"
    "[constraint]\non = \"foot\"\ngap = \"0.01*((x - 0.3)^2 + (y - 0.4)^2)\"\n"
    "[method]\nsolver = \"amg\"\ntolerance = 1e-10\n[output]\nprobes = [[0.2, 0.3, 0.9]]\n");
  expect_independence(file.name, "", 1e-5);
  EXPECT_NE(run(3, file.name).run_log.find("of which each has read a part"), std::string::npos);
}

TEST(ProcessesAnyForm, ShareABodyOfWhichAPartBeginsAtTheCut)
{
  // The process with the smaller x owns nodes of the part, but has no face of it.
  const CaseFile file("mesh.box = [[0, 0, 0], [2, 1, 1]]\nmesh.cells = [20, 10, 10]\n[[part]]\nname = \"foot\"\n"
                      "where = \"z < 1e-9 && x > 1\"\n[model]\nkind = \"elasticity\"\nyoung = 100\npoisson = 0.3\n"
                      "[boundary]\n\"z+\" = { pressure = 1 }\n\"x-\" = [0, 0, 0]\n[constraint]\non = \"foot\"\ngap = 0\n"
                      "[method]\nsolver = \"amg\"\ntolerance = 1e-10\n");
  expect_independence(file.name, "", 1e-5, {2}, 0.01);
}

TEST(ProcessesAnyForm, DoNotShareASlabOfWhichOneWouldHaveAllCells)
{
  const CaseFile   file(pad("Q1", "[50, 50, 1]"));
  const ProgramRun two = run(2, file.name, "--set method.solver=amg");
  EXPECT_EQ(two.exit_code, 0) << two.log;
  EXPECT_NE(two.run_log.find("those at rigid and periodic parts"), std::string::npos) << two.run_log;
  EXPECT_EQ(two.files.count("solution.pvtu"), 0u);
}

TEST(ProcessesAnyForm, ShareALoadHistoryThatChangesWhatHoldsAPlaten)
{
  // The platen is loaded, then moved; only one process has it.
  const CaseFile file("mesh.box = [[0, 0], [2, 1]]\nmesh.cells = [64, 32]\n[model]\nkind = \"elasticity\"\nelement = \"Q2\"\nyoung = 20\n"
                      "poisson = 0.3\n[boundary]\nleft = { x = 0 }\ntop = { rigid = true, force = [0, -1] }\n"
                      "[constraint]\non = \"bottom\"\ngap = \"0.02*x^2\"\n[method]\nsolver = \"amg\"\ntolerance = 1e-10\n"
                      "[[step]]\n[[step]]\nset = { \"boundary.top\" = { rigid = true, y = -0.1 } }\n");
  expect_independence(file.name, "", 1e-5, {2});
}

TEST(ProcessesAnyForm, GetPartsOfNearlyIncompressibleTetrahedraFromTheFirst)
{
  const CaseFile file("mesh.box = [[0, 0, 0], [2, 1, 1]]\nmesh.cells = [10, 7, 6]\n"
                      "model = { kind = \"elasticity\", element = \"P1\", young = 100, poisson = 0.48 }\n"
                      "[boundary]\n\"z+\" = { pressure = 0.3 }\n\"x-\" = \"clamped\"\n[constraint]\non = \"z-\"\n"
                      "gap = { sphere = { center = [0.9, 0.5, -5], radius = 4.98 } }\n[method]\nsolver = \"amg\"\ntolerance = 1e-10\n");
  expect_independence(file.name, "", 1e-5, {2});
}

TEST(ProcessesAnyForm, ExchangeCellsWhereTheErrorAsksForOtherParts)
{
  // The first mesh is divided before anything is known of the error, which is in one corner.
  const CaseFile file(
    "mesh.box = [[0, 0, 0], [1, 1, 1]]\nmesh.cells = [12, 12, 9]\nmesh.adapt = { tolerance = 0.05, max_unknowns = 20000 }\n"
    "[model]\nkind = \"elasticity\"\nelement = \"P1\"\nyoung = 100\npoisson = 0.3\n[boundary]\nback = [0, 0, 0]\n"
    "[constraint]\non = \"front\"\ngap = \"((x - 0.9)^2 + (y - 0.9)^2)/0.4 - 0.03\"\n"
    "[method]\nsolver = \"amg\"\ntolerance = 1e-10\n");
  const ProgramRun one = run(1, file.name);
  for (const unsigned n : {2u, 3u})
  {
    const ProgramRun several = run(n, file.name);
    EXPECT_NE(several.run_log.find("is divided anew"), std::string::npos) << several.run_log;
    const auto largest = largest_parts(several);
    ASSERT_GT(largest.size(), 1u);
    EXPECT_LT(largest.back(), 1.4);
    // The bound on the first meshes is that of the parts, and chooses other cells.
    EXPECT_NEAR(number(several.results, "/mesh/n_cells"), number(one.results, "/mesh/n_cells"),
                0.15 * number(one.results, "/mesh/n_cells"));
    const double force = number(one.results, "/constraint/0/total_contact_force");
    EXPECT_NEAR(number(several.results, "/constraint/0/total_contact_force"), force, 5e-3 * force);
  }
}

TEST(ProcessesAnyForm, CountTheCellsThatLocalRefinementsWillMake)
{
  const CaseFile   file("mesh.box = [[0, 0, 0], [1, 1, 1]]\nmesh.cells = [10, 10, 8]\n[[mesh.local]]\nwhere = \"x < 0.3\"\n"
                          "[[mesh.local]]\nwhere = \"x < 0.2\"\n[model]\nkind = \"elasticity\"\nelement = \"P1\"\nyoung = 100\npoisson = 0.3\n"
                          "[boundary]\nback = [0, 0, 0]\n[constraint]\non = \"front\"\ngap = \"x/10 - 0.03\"\n[method]\nsolver = \"amg\"\n");
  const ProgramRun two = run(2, file.name);
  EXPECT_EQ(two.exit_code, 0) << two.log;
  const auto largest = largest_parts(two);
  ASSERT_EQ(largest.size(), 3u);
  EXPECT_GT(largest.front(), 1.5); // of the coarse mesh
  EXPECT_LT(largest.back(), 1.2);
  // Where nodes hang, cuts through the place that is refined again and again must not make many cells.
  const CaseFile   graded("mesh.box = [[0, 0], [1, 1]]\nmesh.cells = 64\n[[mesh.local]]\nwhere = \"hypot(x - 0.37, y - 0.29) < 0.3\"\n"
                            "[[mesh.local]]\nwhere = \"hypot(x - 0.37, y - 0.29) < 0.15\"\ntimes = 2\n"
                            "[model]\nkind = \"membrane\"\nelement = \"Q1\"\nload = -8\n[boundary]\nall = 0\n[constraint]\nlower = -0.03\n");
  const ProgramRun alone = run(1, graded.name), several = run(3, graded.name);
  EXPECT_EQ(several.exit_code, 0) << several.log;
  ASSERT_FALSE(largest_parts(several).empty());
  EXPECT_LT(largest_parts(several).back(), 1.15);
  EXPECT_LT(number(several.results, "/mesh/n_cells"), 1.01 * number(alone.results, "/mesh/n_cells"));
}

TEST(ProcessesAnyForm, DivideTheMeshOfAHistoryAgainWhereContactHasMovedOn)
{
  const CaseFile   file("parameters.c = -1\nmesh.box = [[-2, -2], [2, 2]]\nmesh.cells = 8\n"
                          "mesh.adapt = { tolerance = 0.008, max_unknowns = 300000 }\n"
                          "model = { kind = \"membrane\", element = \"Q1\" }\nboundary.all = 0\n"
                          "constraint.lower = \"0.3 - 2*((x-c)^2 + y^2)\"\n[[step]]\nc = -1\n[[step]]\nc = -0.5\n[[step]]\nc = 0\n"
                          "[[step]]\nc = 0.5\n[[step]]\nc = 1\n");
  const ProgramRun one = run(1, file.name), several = run(4, file.name, "-v");
  EXPECT_EQ(several.exit_code, 0) << several.log;
  EXPECT_NE(several.run_log.find("times as many cells of the mesh of the step before"), std::string::npos) << several.run_log;
  const double force = number(one.results, "/constraint/0/total_contact_force");
  EXPECT_NEAR(number(several.results, "/constraint/0/total_contact_force"), force, 2e-3 * force);
}

TEST(ProcessesAnyForm, TakeTheStepBeforeWhereCellsAreThoseOfOthersNow)
{
  // A step begins with the coarse mesh and another division: its load needs the solution of the step before on cells that another had.
  const CaseFile file(
    "parameters.c = -1\nparameters.before = { previous = \"u\", initial = 0 }\nmesh.box = [[-2, -2], [2, 2]]\nmesh.cells = 8\n"
    "mesh.adapt = { tolerance = 0.01, max_unknowns = 300000 }\n"
    "model = { kind = \"membrane\", element = \"Q1\", load = \"-0.01*before\" }\nboundary.all = 0\n"
    "constraint.lower = \"0.3 - 2*((x-c)^2 + y^2)\"\n[[step]]\nc = -1\n[[step]]\nc = -0.5\n[[step]]\nc = 0\n"
    "[[step]]\nc = 0.5\n[[step]]\nc = 1\n");
  const ProgramRun one = run(1, file.name), two = run(2, file.name, "-v");
  ASSERT_EQ(two.exit_code, 0) << two.log;
  EXPECT_NE(two.run_log.find("this step begins with the coarse mesh"), std::string::npos) << two.run_log;
  ASSERT_EQ(two.results["steps"].size(), 5u);
  for (unsigned k = 0; k < 5; ++k)
  {
    const std::string key = "/steps/" + std::to_string(k) + "/constraint/0/total_contact_force";
    EXPECT_NEAR(number(two.results, key), number(one.results, key), 1e-5) << key;
  }
}
