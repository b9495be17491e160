// A case read, overridden, expanded and read again.

#include "unilateral/base/sha256.h"
#include "unilateral/case/expectations.h"
#include "unilateral/case/read_case.h"
#include "unilateral/case/write_case.h"
#include "unilateral/functions/compile_field.h"

#include <gtest/gtest.h>

#include <unistd.h>

#include <filesystem>
#include <fstream>

using namespace unilateral;

namespace
{
  /// Everything a membrane can say.
  const char *const full_case = R"toml(
title = "Everything \"at once\""

[parameters]
A = 0.5
r = "sqrt(x^2+y^2)"
bump = '''
  exp(-r^2)
'''

[mesh]
box = [[-1, -2], [1.5, 2]]
cells = [3, 4]
refine = 2

[model]
kind = "membrane"
element = "Q2"
stiffness = [2, "0.1*x", "3+A"]
velocity = [1, "y"]
reaction = "bump"
load = -1

[[material]]
region = "domain"
stiffness = 4
reaction = "A"

[boundary]
top = { flux = 1, spring = "2*A" }
left = "free"
right = { value = 2 }
bottom = { spring = 3 }
all = "A*x"

[[constraint]]
lower = "bump - 3"
upper = 7

[[constraint]]
upper = 8
on = "top"
quadrature = "gauss(2)"

[method]
formulation = "mixed"
epsilon = 1e-3
tolerance = 1e-6
solver = "direct"
max_iterations = 17

[exact]
u = "x"
pressure = 0

[output]
probes = [[0, 0], [0.25, 1]]

[[expect]]
quantity = "solution.energy"
value = 1.5
rtol = 1e-3
atol = 1e-9

[[expect]]
quantity = "constraint.1.n_active"
min = 0
max = 1e9
)toml";

  const char *const small_case = "[mesh]\nbox = [[0, 0], [1, 1]]\n[model]\nkind = \"membrane\"\n[constraint]\nlower = 0\n";

  Case parse(const std::string &text, const std::vector<Override> &overrides = {})
  {
    Diagnostics diagnostics;
    return parse_case(text, "/cases/membrane.toml", overrides, diagnostics);
  }

  std::string error_of(const std::string &text, const std::vector<Override> &overrides = {})
  {
    try
    {
      parse(text, overrides);
    }
    catch (const InputError &e)
    {
      return e.what();
    }
    return "";
  }
} // namespace

TEST(CaseFile, ReadsEverythingAMembraneCanSay)
{
  const Case c = parse(full_case);
  EXPECT_EQ(c.path, "/cases/membrane.toml");
  EXPECT_EQ(c.name, "membrane");
  EXPECT_EQ(c.title, "Everything \"at once\"");
  EXPECT_EQ(c.sha256, sha256(full_case));
  EXPECT_EQ(c.dimension, 2u);

  ASSERT_EQ(c.parameters.size(), 3u);
  EXPECT_EQ(c.parameters[0].name, "A"); // the order of the file
  EXPECT_EQ(c.parameters[0].value.value, 0.5);
  EXPECT_EQ(c.parameters[2].value.text, "  exp(-r^2)\n");

  EXPECT_EQ(c.mesh.source, MeshSpec::Source::box);
  EXPECT_EQ(c.mesh.box_lower, (std::vector<double>{-1, -2}));
  EXPECT_EQ(c.mesh.box_upper, (std::vector<double>{1.5, 2}));
  EXPECT_EQ(c.mesh.cells, (std::vector<unsigned>{3, 4}));
  EXPECT_EQ(c.mesh.refine, 2u);
  EXPECT_EQ(c.mesh.where.line, 12u);

  EXPECT_EQ(c.model.element.name(), "Q2");
  ASSERT_TRUE(c.model.coefficients.stiffness);
  ASSERT_EQ(c.model.coefficients.stiffness->size(), 3u);
  EXPECT_EQ((*c.model.coefficients.stiffness)[0].value, 2);
  EXPECT_EQ((*c.model.coefficients.stiffness)[1].text, "0.1*x");
  EXPECT_EQ(c.model.coefficients.velocity->size(), 2u);
  EXPECT_EQ(c.model.coefficients.reaction->text, "bump");
  EXPECT_EQ(c.model.coefficients.load->at(0).value, -1);

  ASSERT_EQ(c.materials.size(), 1u);
  EXPECT_EQ(c.materials[0].region, "domain");
  EXPECT_EQ(c.materials[0].coefficients.stiffness->at(0).value, 4);
  EXPECT_FALSE(c.materials[0].coefficients.load);
  EXPECT_EQ(c.materials[0].coefficients.reaction->text, "A");

  ASSERT_EQ(c.boundary.size(), 5u);
  EXPECT_EQ(c.boundary[0].part, "top");
  EXPECT_EQ(c.boundary[0].flux->value, 1);
  EXPECT_EQ(c.boundary[0].spring->text, "2*A");
  EXPECT_FALSE(c.boundary[0].value);
  EXPECT_FALSE(c.boundary[1].value || c.boundary[1].flux || c.boundary[1].spring);
  EXPECT_EQ(c.boundary[2].value->value, 2);
  EXPECT_FALSE(c.boundary[3].flux);
  EXPECT_EQ(c.boundary[4].part, "all");
  EXPECT_EQ(c.boundary[4].value->text, "A*x");

  ASSERT_EQ(c.constraints.size(), 2u);
  EXPECT_TRUE(c.constraints[0].lower && c.constraints[0].upper);
  EXPECT_EQ(c.constraints[0].on, "");
  EXPECT_FALSE(c.constraints[1].lower);
  EXPECT_EQ(c.constraints[1].on, "top");
  EXPECT_EQ(c.constraints[1].quadrature.value().name(), "gauss(2)");

  EXPECT_EQ(c.method.formulation, Method::Formulation::mixed);
  EXPECT_EQ(c.method.epsilon, 1e-3);
  EXPECT_EQ(c.method.tolerance, 1e-6);
  EXPECT_EQ(c.method.solver, Method::Solver::direct);
  EXPECT_EQ(c.method.max_iterations, 17u);
  EXPECT_EQ(c.exact.u.at(0).text, "x");
  EXPECT_EQ(c.exact.pressure->value, 0);
  EXPECT_EQ(c.output.probes, (std::vector<std::vector<double>>{{0, 0}, {0.25, 1}}));

  ASSERT_EQ(c.expect.size(), 2u);
  EXPECT_EQ(c.expect[0].value, 1.5);
  EXPECT_EQ(c.expect[0].rtol, 1e-3);
  EXPECT_EQ(c.expect[0].atol, 1e-9);
  EXPECT_EQ(c.expect[1].max, 1e9);
}

TEST(CaseFile, FillsDefaults)
{
  const Case c = parse(small_case);
  EXPECT_EQ(c.mesh.cells, (std::vector<unsigned>{1, 1}));
  EXPECT_EQ(c.model.element.name(), "Q1");
  EXPECT_EQ(c.method.formulation, Method::Formulation::penalty);
  EXPECT_FALSE(c.method.epsilon);
  EXPECT_EQ(c.method.tolerance, 1e-8);
  EXPECT_EQ(c.method.solver, Method::Solver::automatic);
}

TEST(CaseFile, ReadsTheOtherMeshes)
{
  const std::string rest = "[model]\nkind = \"membrane\"\n[constraint]\nlower = 0\n";
  Case              c = parse("[mesh]\nball = { center = [1, 2, 3], radius = 2 }\nrefine = 1\n" + rest);
  EXPECT_EQ(c.mesh.source, MeshSpec::Source::ball);
  EXPECT_EQ(c.dimension, 3u);
  EXPECT_EQ(c.mesh.radius, 2);
  c = parse("[mesh]\nshell = { center = [1, 2], inner = 2, outer = 2.5 }\n" + rest);
  EXPECT_EQ(c.mesh.source, MeshSpec::Source::shell);
  EXPECT_EQ(c.mesh.outer, 2.5);
  c = parse("[mesh]\nbox = [[0], [1]]\ncells = 7\n[output]\nprobes = [0.5, [0.25]]\n[boundary]\nleft = 0\n" + rest,
            {{"model.element", "P6"}, {"model.velocity", "2"}});
  EXPECT_EQ(c.dimension, 1u);
  EXPECT_EQ(c.model.element.name(), "P6");
  EXPECT_EQ(c.model.coefficients.velocity->size(), 1u);
  EXPECT_EQ(c.output.probes.size(), 2u);
}

TEST(CaseFile, ExpandedCaseReadsBackTheSame)
{
  for (const std::string text :
       {full_case, small_case,
        "[mesh]\nshell = { center = [0, 0, 0], inner = 0.1 }\n[model]\nkind = \"membrane\"\n"
        "[boundary]\nouter = \"if(x > 0 && y > 0, 1, 0)\"\n"
        "[constraint]\nlower = 0.1\non = \"inner\"\n",
        "[mesh]\nbox = [[0], [1e-300]]\n[model]\nkind = \"membrane\"\nload = 1e22\nreaction = -0.0\n[constraint]\nupper = 0\n"
        "on = \"left\"\n"})
  {
    const std::string once = expand(parse(text));
    EXPECT_EQ(expand(parse(once)), once);
    EXPECT_NE(once.find("tolerance = "), std::string::npos);
  }
}

TEST(CaseFile, ExpandedCaseHasResultantsRigidAndPeriodicParts)
{
  const std::string body = "[model]\nkind = \"elasticity\"\nyoung = 1\npoisson = 0.3\n[parameters]\nM = 5\n";
  const std::string plane =
    expand(parse("[mesh]\nbox = [[0, 0], [1, 1]]\n" + body +
                 "[boundary]\ntop = { rigid = true, x = 0, rotation = 0.1, force = [1, 2], moment = \"M\", about = [3, 4] }\n"
                 "bottom = { rigid = \"translation\" }\n[[periodic]]\nparts = [\"left\", \"right\"]\njump = [0.5, 0]\n"));
  EXPECT_EQ(expand(parse(plane)), plane);
  for (const std::string piece : {"moment = \"M\"", "about = [3, 4]", "rigid = true", "rotation = 0.1", "x = 0", "force = [1, 2]",
                                  "bottom = { rigid = true, rotation = 0 }", "parts = [\"left\", \"right\"]", "jump = [0.5, 0]"})
    EXPECT_NE(plane.find(piece), std::string::npos) << piece << "\n" << plane;
  const std::string space = expand(parse("[mesh]\nbox = [[0, 0, 0], [1, 1, 1]]\n" + body +
                                         "[boundary]\nback = { rigid = true, rotation = { z = 0.1 }, moment = [1, 2, 3] }\n"));
  EXPECT_EQ(expand(parse(space)), space);
  EXPECT_NE(space.find("moment = [1, 2, 3], rigid = true, rotation = { z = 0.1 }"), std::string::npos) << space;
}

TEST(CaseFile, ExpandedCaseHasEveryDefault)
{
  const auto expanded = [](const std::string &text) { return expand(parse(text)); };
  const auto has = [](const std::string &text, const std::string &part) { return text.find(part) != std::string::npos; };
  EXPECT_TRUE(has(expanded(small_case), "quadrature = \"nodal\""));
  EXPECT_TRUE(has(expanded(small_case), "[boundary]\nall = \"free\""));
  const std::string tetrahedra =
    "[mesh]\nbox = [[0, 0, 0], [1, 1, 1]]\n[model]\nkind = \"membrane\"\nelement = \"P3\"\n[constraint]\nlower = 0\n";
  EXPECT_TRUE(has(expanded(tetrahedra), "quadrature = \"edges\""));
  EXPECT_TRUE(has(expanded(tetrahedra + "on = \"top\"\n"), "quadrature = \"nodal\"")); // P3 on the triangles of a face
  const std::string material = expanded(std::string(small_case) + "[[material]]\nregion = \"domain\"\nload = 3\n");
  EXPECT_TRUE(has(material, "region = \"domain\"\nstiffness = 1\nvelocity = [0, 0]\nreaction = 0\nload = 3\n")) << material;
}

TEST(CaseFile, ReportsEverythingAtOnceInTheOrderOfTheText)
{
  const std::string errors =
    error_of("[parameters]\na = \"foo\"\n[mesh]\nbox = [[0, 0], [1, 1]]\nrefine = -1\n[model]\nkind = \"membrane\"\n"
             "load = \"sinn(x)\"\n[method]\nepsilon = 0\nx = 1\n");
  EXPECT_EQ(errors, "/cases/membrane.toml:2:6: error: unknown name 'foo' in expression; known: x, y, pi, e, a [unknown-name]\n"
                    "/cases/membrane.toml:5:10: error: 'refine' must lie between 0 and 20, it is -1 [out-of-range]\n"
                    "/cases/membrane.toml:8:9: error: unknown function 'sinn' in expression; did you mean 'sin'? [unknown-function]\n"
                    "/cases/membrane.toml:10:11: error: 'epsilon' must be positive, it is 0; \"auto\" chooses it [out-of-range]\n"
                    "/cases/membrane.toml:11:1: error: unknown key 'x' in [method]; known: formulation, epsilon, penalty_tolerance, "
                    "tolerance, solver, max_iterations [unknown-key]");
}

TEST(CaseFile, TheFileMustExistAndBeAFile)
{
  Diagnostics diagnostics;
  EXPECT_THROW(read_case("/nowhere/case.toml", {}, diagnostics), InputError);
  EXPECT_THROW(read_case("/", {}, diagnostics), InputError);
}

TEST(CaseFile, PathsStartFromTheFolderOfTheCase)
{
  const auto folder = std::filesystem::temp_directory_path() / ("unilateral_case_file_" + std::to_string(::getpid()));
  std::filesystem::create_directories(folder / "profiles");
  std::ofstream(folder / "profiles" / "road.csv") << "x, height\n0, 1\n1, 3\n";
  std::ofstream(folder / "road.toml") << "[mesh]\nbox = [[0], [1]]\n[model]\nkind = \"membrane\"\n[constraint]\nlower = "
                                         "{ profile = \"profiles/../profiles/road.csv\", scale = 2, offset = 1 }\n";
  Diagnostics diagnostics;
  const Case  c = read_case((folder / "road.toml").string(), {}, diagnostics);
  ASSERT_TRUE(c.constraints.at(0).lower);
  EXPECT_EQ(c.constraints[0].lower->file, (folder / "profiles" / "road.csv").string());
  EXPECT_NEAR(compile_field(*c.constraints[0].lower, {}).value(dealii::Point<1>(0.25)), 4, 1e-14);
  EXPECT_EQ(expand(parse(expand(c))), expand(c));
  std::filesystem::remove_all(folder);
}

TEST(CaseFile, TheDimensionOfAMeshFileIsThatOfItsCells)
{
  const auto folder = std::filesystem::temp_directory_path() / ("unilateral_mesh_file_" + std::to_string(::getpid()));
  std::filesystem::create_directories(folder);
  std::ofstream(folder / "square.msh") << "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Nodes\n4\n1 0 0 0\n2 1 0 0\n3 1 1 0\n4 0 1 0\n$EndNodes\n"
                                          "$Elements\n1\n1 3 2 1 1 1 2 3 4\n$EndElements\n";
  std::ofstream(folder / "empty.msh") << "nothing\n";
  const std::string rest = "\n[model]\nkind = \"membrane\"\nload = \"y\"\n[boundary]\nboundary = 0\n";
  Diagnostics       diagnostics;
  const Case        c = parse_case("[mesh]\nfile = \"square.msh\"" + rest, (folder / "case.toml").string(), {}, diagnostics);
  EXPECT_EQ(c.dimension, 2u);
  EXPECT_EQ(c.mesh.file, (folder / "square.msh").string());
  EXPECT_EQ(expand(parse(expand(c))), expand(c));
  try
  {
    parse_case("[mesh]\nfile = \"empty.msh\"" + rest, (folder / "case.toml").string(), {}, diagnostics);
    FAIL();
  }
  catch (const InputError &e)
  {
    EXPECT_EQ(e.diagnostics.at(0).where.line, 2u);
    EXPECT_EQ(e.diagnostics.at(0).where.column, 8u);
  }
  std::filesystem::remove_all(folder);
}

TEST(Overrides, SetValuesOfEveryType)
{
  const Case c = parse(full_case, {{"mesh.refine", "3"},
                                   {"mesh.cells", "[1, 2]"},
                                   {"constraint.0.lower", "x^2 - 1"}, // no TOML, a string
                                   {"constraint.1.quadrature", "\"nodal\""},
                                   {"model.load", "\"2*x\""},
                                   {"method.epsilon", "auto"},
                                   {"output.probes.1", "[1, 1]"},
                                   {"boundary.left", "{ flux = 2 }"}});
  EXPECT_EQ(c.mesh.refine, 3u);
  EXPECT_EQ(c.mesh.cells, (std::vector<unsigned>{1, 2}));
  EXPECT_EQ(c.constraints[0].lower->text, "x^2 - 1");
  EXPECT_EQ(c.constraints[1].quadrature.value().name(), "nodal");
  EXPECT_EQ(c.model.coefficients.load->at(0).text, "2*x");
  EXPECT_FALSE(c.method.epsilon);
  EXPECT_EQ(c.output.probes[1], (std::vector<double>{1, 1}));
  EXPECT_EQ(c.boundary[1].flux->value, 2);
}

TEST(Overrides, CreateWhatIsMissing)
{
  const Case c = parse(small_case, {{"constraint.0.upper", "4"}, // a single [constraint] is number 0
                                    {"parameters.A", "3"},
                                    {"boundary.\"x+\"", "0.25"}, // as TOML has it
                                    {"method.solver", "direct"},
                                    {"expect.0.quantity", "solution.min"},
                                    {"expect.0.min", "0"},
                                    {"expect.1.quantity", "solution.max"},
                                    {"expect.1.max", "0"}});
  EXPECT_EQ(c.constraints.at(0).upper->value, 4);
  EXPECT_EQ(c.parameters.at(0).value.value, 3);
  EXPECT_EQ(c.boundary.at(0).part, "right");
  EXPECT_EQ(c.method.solver, Method::Solver::direct);
  ASSERT_EQ(c.expect.size(), 2u);
  EXPECT_EQ(c.expect[1].max, 0);
}

TEST(Overrides, ErrorsNameTheKey)
{
  EXPECT_EQ(error_of(small_case, {{"mesh.refine", "99"}}),
            "--set mesh.refine: error: 'refine' must lie between 0 and 20, it is 99 [out-of-range]");
  EXPECT_NE(error_of(small_case, {{"mesh.refin", "1"}}).find("--set mesh.refin: error: unknown key 'refin'"), std::string::npos);
  EXPECT_NE(error_of(small_case, {{"constraint.0.lower", "sin(x"}}).find("--set constraint.0.lower: error: '(' without ')'"),
            std::string::npos);
  EXPECT_NE(error_of(full_case, {{"constraint.7.lower", "0"}}).find("a list of 2"), std::string::npos);
  EXPECT_NE(error_of(full_case, {{"constraint.first.lower", "0"}}).find("numbered from 0"), std::string::npos);
  EXPECT_NE(error_of(small_case, {{"boundary.\"a.b\".value", "1"}}).find("the boundary has no part 'a.b'"), std::string::npos);
  EXPECT_NE(error_of(small_case, {{"mesh..refine", "1"}}).find("--set: error: 'mesh..refine'"), std::string::npos);
  EXPECT_NE(error_of(small_case, {{"model.kind.x", "1"}}).find("is a string"), std::string::npos);
}

TEST(Diagnostics, SuggestWhatIsNear)
{
  const std::vector<std::string> names = {"obstacle", "lower", "upper", "sin", "sinh", "sign"};
  EXPECT_EQ(did_you_mean("obstcle", names), "obstacle");
  EXPECT_EQ(did_you_mean("lowre", names), "lower"); // a swap is one slip
  EXPECT_EQ(did_you_mean("LOWER", names), "lower");
  EXPECT_EQ(did_you_mean("sinn", names), "sin");
  EXPECT_EQ(did_you_mean("x", {"y"}), "");
  EXPECT_EQ(did_you_mean("banana", names), "");
  EXPECT_EQ(suggestion("banana", {"a1", "b1"}), "; known: a1, b1");
  EXPECT_EQ(suggestion("banana", {}), "");
}

TEST(Diagnostics, PrintWhatIsKnownOfThePlace)
{
  EXPECT_EQ(to_string({{"a.toml", 3, 4}, Severity::error, "m"}), "a.toml:3:4: error: m");
  EXPECT_EQ(to_string({{"a.toml", 3, 0}, Severity::warning, "m"}), "a.toml:3: warning: m");
  EXPECT_EQ(to_string({{"a.toml", 0, 0}, Severity::note, "m"}), "a.toml: note: m");
  EXPECT_EQ(to_string({{}, Severity::error, "m"}), "error: m");
}

// FIPS 180-4, examples of one block, none, and two blocks.
TEST(Sha256, AgreesWithTheStandard)
{
  EXPECT_EQ(sha256("abc"), "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad");
  EXPECT_EQ(sha256(""), "e3b0c44298fc1c149afbf4c8996fb92427ae41e4649b934ca495991b7852b855");
  EXPECT_EQ(sha256("abcdbcdecdefdefgefghfghighijhijkijkljklmklmnlmnomnopnopq"),
            "248d6a61d20638b8e5c026930c3e6039a33ce45964ff2167f6ecedd419db06c1");
}

TEST(ReadCase, knows_the_sides_of_a_box_by_their_direction)
{
  const auto with = [](const std::string &boundary)
  { return parse("[mesh]\nbox = [[0, 0], [1, 1]]\n[model]\nkind = \"membrane\"\n[boundary]\n" + boundary + "[constraint]\nupper = 1\n"); };
  const auto request = with("\"x-\" = 0\n\"y+\" = 0.5\n");
  ASSERT_EQ(request.boundary.size(), 2u);
  EXPECT_EQ(request.boundary[0].part, "left");
  EXPECT_EQ(request.boundary[1].part, "top");
  EXPECT_THROW(with("\"x-\" = 0\nleft = 1\n"), InputError); // twice the same side
  EXPECT_THROW(with("\"z+\" = 0\n"), InputError);           // there is none in the plane
  const auto periodic = with("bottom = 0\n[[periodic]]\nparts = [\"x-\", \"x+\"]\n");
  EXPECT_EQ(periodic.periodic.at(0).first, "left");
  EXPECT_EQ(periodic.periodic.at(0).second, "right");
}

TEST(GivenFunctions, StandOnlyWhereAFunctionMay)
{
  // Names of the user are no functions of a program.
  const std::string text =
    "mesh.box = [[0], [1]]\nmodel.kind = \"membrane\"\nparameters.given = 3\nmodel.load = \"given\"\nboundary.all = 0\n";
  EXPECT_EQ(error_of(text, {}), "");
  EXPECT_NE(error_of(text, {{"model.load", "{ given = 0 }"}}).find("given-by-program"), std::string::npos);
  EXPECT_NE(error_of("mesh.given = 0\nmodel.kind = \"membrane\"\n", {}).find("no file holds it"), std::string::npos);
}

namespace
{
  std::vector<std::string> mistakes_in(const std::string &text, const std::vector<unilateral::Override> &overrides)
  {
    std::vector<std::string> messages;
    try
    {
      unilateral::Diagnostics diagnostics;
      unilateral::parse_case(text, "case.toml", overrides, diagnostics);
    }
    catch (const unilateral::InputError &e)
    {
      for (const auto &diagnostic : e.diagnostics)
        messages.push_back(diagnostic.message);
    }
    return messages;
  }
} // namespace

TEST(ReadCase, a_misspelt_kind_is_one_mistake)
{
  const auto messages =
    mistakes_in("[mesh]\nbox = [[0, 0], [1, 1]]\n[model]\nkind = \"elasticty\"\nyoung = 1\npoisson = 0.3\nload = [0, -1]\n"
                "[boundary]\ntop = \"symmetry\"\nleft = [0, 0]\n[constraint]\non = \"bottom\"\ngap = 0\n",
                {});
  ASSERT_EQ(messages.size(), 1u) << testing::PrintToString(messages);
  EXPECT_NE(messages[0].find("did you mean 'elasticity'?"), std::string::npos);
}

TEST(ReadCase, a_modulus_that_is_no_number_is_not_missing_too)
{
  const auto messages = mistakes_in("[mesh]\nbox = [[0, 0], [1, 1]]\n[model]\nkind = \"elasticity\"\nyoung = nan\npoisson = 0.3\n"
                                    "[boundary]\ntop = [0, -0.1]\n[constraint]\non = \"bottom\"\ngap = 0\n",
                                    {});
  EXPECT_EQ(messages, std::vector<std::string>{"'young' must be a finite number"});
}

TEST(ReadCase, parameters_from_outside_that_nothing_uses_are_warned_of)
{
  const auto warnings = [](const std::vector<unilateral::Override> &overrides)
  {
    unilateral::Diagnostics diagnostics;
    unilateral::parse_case(
      "[parameters]\nload = 2\n[mesh]\nbox = [[0], [1]]\n[model]\nkind = \"membrane\"\nload = \"load\"\n[boundary]\nall = 0\n", "case.toml",
      overrides, diagnostics);
    return diagnostics.all();
  };
  EXPECT_TRUE(warnings({{"parameters.load", "3"}}).empty());
  EXPECT_TRUE(warnings({{"parameters.q", "3"}, {"model.load", "2*q"}}).empty());
  EXPECT_EQ(warnings({{"parameters.lo", "3"}}).size(), 1u) << "a part of a name is not that name";
  const auto messages = warnings({{"parameters.laod", "3"}});
  ASSERT_EQ(messages.size(), 1u);
  EXPECT_EQ(messages[0].message, "[parameters] has no 'laod', and nothing uses it; did you mean 'load'?");
}

TEST(ReadCase, parameters_that_nothing_uses_are_warned_of)
{
  const auto warnings = [](const std::string &parameters, const std::string &load)
  {
    unilateral::Diagnostics diagnostics;
    unilateral::parse_case("[parameters]\n" + parameters + "[mesh]\nbox = [[0], [1]]\n[model]\nkind = \"membrane\"\nload = \"" + load +
                             "\"\n[boundary]\nall = 0\n",
                           "case.toml", {}, diagnostics);
    return diagnostics.all();
  };
  EXPECT_TRUE(warnings("q = 2\n", "q*x").empty());
  EXPECT_EQ(warnings("q = 2\n", "1").size(), 1u);
  const auto messages = warnings("q = 2\nqq = 3\n", "qq*x");
  ASSERT_EQ(messages.size(), 1u) << "a part of a name is not that name";
  EXPECT_EQ(messages[0].message, "nothing in the case uses the parameter 'q'");
  EXPECT_EQ(messages[0].where.line, 2u);
}

TEST(ReadCase, expressions_beside_the_case_use_its_parameters)
{
  const auto n_warnings = [](const std::vector<unilateral::Override> &overrides, const std::vector<std::string> &expressions)
  {
    unilateral::Diagnostics diagnostics;
    unilateral::parse_case("[parameters]\nq = 2\n[mesh]\nbox = [[0], [1]]\n[model]\nkind = \"membrane\"\n", "case.toml", overrides,
                           diagnostics, {.expressions = expressions});
    return diagnostics.all().size();
  };
  EXPECT_EQ(n_warnings({}, {}), 1u);
  EXPECT_EQ(n_warnings({}, {"x < qq"}), 1u);
  EXPECT_EQ(n_warnings({}, {"x < q"}), 0u);
  EXPECT_EQ(n_warnings({{"parameters.p", "1"}}, {"x < q"}), 1u);
  EXPECT_EQ(n_warnings({{"parameters.p", "1"}}, {"x < q*p"}), 0u);
}

TEST(Overrides, of_a_parameter_by_its_bare_name_are_mistakes_with_a_remedy)
{
  unilateral::Diagnostics diagnostics;
  try
  {
    unilateral::parse_case(
      "[parameters]\nq = 2\n[mesh]\nbox = [[0], [1]]\n[model]\nkind = \"membrane\"\nload = \"q\"\n[boundary]\nall = 0\n", "case.toml",
      {{"q", "3"}}, diagnostics);
    FAIL();
  }
  catch (const unilateral::InputError &e)
  {
    ASSERT_EQ(e.diagnostics.size(), 1u);
    EXPECT_EQ(e.diagnostics[0].message, "the case has no key 'q', but a parameter of this name: write parameters.q");
  }
}

TEST(ReadCase, quantities_that_a_run_does_not_give_are_mistakes)
{
  unilateral::Diagnostics diagnostics;
  const auto              request = unilateral::parse_case(
                 "[mesh]\nbox = [[0], [1]]\n[model]\nkind = \"membrane\"\n[boundary]\nall = 0\n[constraint]\nupper = 1\n", "case.toml", {}, diagnostics);
  unilateral::check_quantities(request, {"solution.energy", "constraint.0.max_contact_pressure"}, diagnostics);
  EXPECT_FALSE(diagnostics.has_errors());
  unilateral::check_quantities(request, {"solution.energie", "constraint"}, diagnostics);
  EXPECT_EQ(diagnostics.all().size(), 2u);
}
