// Every mistake is reported where it was made, in words that help. One row a mistake.

#include "unilateral/case/read_case.h"

#include <gtest/gtest.h>

#include <unistd.h>

#include <filesystem>
#include <fstream>

using namespace unilateral;

namespace
{
  struct Mistake
  {
    const char *text;    ///< of a case; @ marks the place of the message; missing [mesh] and [model] are added at the end
    const char *message; ///< a part of it
  };

  void PrintTo(const Mistake &mistake, std::ostream *out)
  {
    *out << mistake.text;
  }

  std::filesystem::path folder()
  {
    static const std::filesystem::path path = []
    {
      const auto temporary = std::filesystem::temp_directory_path() / ("unilateral_bad_input_" + std::to_string(::getpid()));
      std::filesystem::create_directories(temporary);
      std::ofstream(temporary / "text.tif") << "no pixels here\n";
      std::ofstream(temporary / "good.csv") << "x,height\n0,1\n1,2\n";
      std::ofstream(temporary / "short.csv") << "x,height\n0,1\n";
      std::ofstream(temporary / "words.csv") << "0,1\n0.5,one\n1,2\n";
      std::ofstream(temporary / "back.csv") << "0;1\n2;2\n1;2\n";
      std::ofstream(temporary / "three.csv") << "0 1 2\n1 2 3\n";
      std::ofstream(temporary / "table.txt") << "not a mesh\n";
      const std::string mesh = "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$PhysicalNames\n2\n1 1 \"foot\"\n2 2 \"plate\"\n$EndPhysicalNames\n"
                               "$Nodes\n4\n1 0 0 0\n2 1 0 0\n3 1 1 0\n4 0 1 0\n$EndNodes\n"
                               "$Elements\n3\n1 1 2 1 1 1 2\n2 2 2 2 1 1 2 3\n3 2 2 2 1 1 3 4\n$EndElements\n";
      std::ofstream(temporary / "square.msh") << mesh;
      std::ofstream(temporary / "cut.msh") << mesh.substr(0, mesh.find("4 0 1"));
      return temporary;
    }();
    return path;
  }

  std::string complete(std::string text)
  {
    const auto has = [&](const std::string &header) { return text.find("[" + header) != std::string::npos; };
    if (!has("mesh") && text.find("no mesh") == std::string::npos)
      text += "\n[mesh]\nbox = [[0, 0], [1, 1]]\n";
    if (!has("model"))
      text += "\n[model]\nkind = \"membrane\"\n";
    return text;
  }
} // namespace

class BadInput : public testing::TestWithParam<Mistake>
{
};

TEST_P(BadInput, IsReportedOnceAtItsPlace)
{
  std::string       text = complete(GetParam().text);
  const std::size_t mark = text.find('@');
  ASSERT_NE(mark, std::string::npos);
  unsigned line = 1, column = 1;
  for (std::size_t i = 0; i < mark; ++i)
    if (text[i] == '\n')
    {
      ++line;
      column = 1;
    }
    else if ((static_cast<unsigned char>(text[i]) & 0xc0) != 0x80)
      ++column;
  text.erase(mark, 1);

  Diagnostics diagnostics;
  try
  {
    parse_case(text, (folder() / "case.toml").string(), {}, diagnostics);
    FAIL() << "nothing is reported";
  }
  catch (const InputError &e)
  {
    ASSERT_EQ(e.diagnostics.size(), 1u) << e.what();
    EXPECT_EQ(e.diagnostics[0].where.line, line) << e.what();
    EXPECT_EQ(e.diagnostics[0].where.column, column) << e.what();
    EXPECT_EQ(e.diagnostics[0].where.file, (folder() / "case.toml").string());
    EXPECT_NE(e.diagnostics[0].message.find(GetParam().message), std::string::npos) << e.what();
  }
}

// The text itself.
INSTANTIATE_TEST_SUITE_P(Syntax,
                         BadInput,
                         testing::Values(Mistake{"title = @\"a\n", "not closed before the line ends; add \""},
                                         Mistake{"# it's\n[model]\nkind = @'membrane\n", "add ' at its end"},
                                         Mistake{"title = \"ä\"\nconstraint = { lower = @\"\\\"-1 }\n", "is not closed before"},
                                         Mistake{"title = @\"\"\"a\nb\n", "never closed; add \"\"\""},
                                         Mistake{"title = \"\"\"a\"\"\"\"\"\n[parameters]\nb = @\"1\n", "is not closed before"},
                                         Mistake{"title = 3 # and more is wrong below\n\n@[[[mesh]]]\n", "malformed line"},
                                         Mistake{"[mesh]\nbox = [[0, 0], [1, 1]]\nrefine = 1\nrefine = @2\n", "refine"},
                                         Mistake{"title @\"a\"\n", "'='"},
                                         Mistake{"@mesh_ = 1\n[mesh]\nbox = [[0], [1]]\n[model]\nkind = \"membrane\"\n",
                                                 "did you mean 'mesh'"}));

INSTANTIATE_TEST_SUITE_P(Keys,
                         BadInput,
                         testing::Values(Mistake{"@titel = \"a\"\n", "unknown key 'titel' in the case file; did you mean 'title'?"},
                                         Mistake{"[@bondary]\nall = 0\n", "did you mean 'boundary'?"},
                                         Mistake{"title = @3\n", "'title' must be a string, not a number"},
                                         Mistake{"[constraint]\nlower = 0\n@uper = 1\n",
                                                 "unknown key 'uper' in [constraint]; did you mean 'upper'?"},
                                         Mistake{"[constraint]\nlower = 0\n@obstacle_function = 1\n", "known: lower, upper"},
                                         // What is misspelt is not missing as well.
                                         Mistake{"[constraint]\n@uper = 1\n", "did you mean 'upper'?"},
                                         Mistake{"[mesh]\n@bx = [[0, 0], [1, 1]]\n", "did you mean 'box'?"},
                                         Mistake{"[@mehs]\nbox = [[0, 0], [1, 1]]\n# no mesh\n", "did you mean 'mesh'?"},
                                         Mistake{"[model]\n@kidn = \"membrane\"\n", "did you mean 'kind'?"},
                                         Mistake{"[[material]]\n@regoin = \"domain\"\n", "did you mean 'region'?"},
                                         Mistake{"[[expect]]\n@quantty = \"solution.energy\"\nmin = 0\n", "did you mean 'quantity'?"},
                                         Mistake{"[[expect]]\nquantity = \"solution.energy\"\n@vlaue = 0\n", "did you mean 'value'?"},
                                         Mistake{"[method]\n@epsilom = 1\n", "did you mean 'epsilon'?"},
                                         Mistake{"[output]\n@probe = [[0, 0]]\n", "did you mean 'probes'?"},
                                         Mistake{"[exact]\n@v = 0\n", "unknown key 'v' in [exact]"},
                                         Mistake{"method = @3\n", "must be a table [method]"},
                                         Mistake{"@[[method]]\nepsilon = 1\n", "only once"},
                                         Mistake{"constraint = @3\n", "must be a table [constraint]"},
                                         Mistake{"constraint = [@3]\n", "must be a table"}));

INSTANTIATE_TEST_SUITE_P(Mesh,
                         BadInput,
                         testing::Values(Mistake{"@[mesh]\nrefine = 1\n", "no source"},
                                         Mistake{"[mesh]\nbox = [[0], [1]]\n@ball = { center = [0, 0] }\n", "two sources"},
                                         Mistake{"[mesh]\nbox = @3\n", "must be a list"},
                                         Mistake{"[mesh]\nbox = @[[0, 0]]\n", "1 entries"},
                                         Mistake{"[mesh]\nbox = @[[0, 0], [1]]\n", "a corner of 2 and one of 1"},
                                         Mistake{"[mesh]\nbox = @[[0, 0, 0, 0], [1, 1, 1, 1]]\n", "4 coordinates"},
                                         Mistake{"[mesh]\nbox = @[[0, 0], [1, 0]]\n", "wrong order: 0 >= 0 in y"},
                                         Mistake{"[mesh]\nbox = [[0, @\"a\"], [1, 1]]\n", "must be a number, not a string"},
                                         Mistake{"[mesh]\nbox = [[0, 0], [1, @inf]]\n", "finite"},
                                         Mistake{"[mesh]\nbox = [[0, 0], [1, 1]]\ncells = @0\n", "between 1 and"},
                                         Mistake{"[mesh]\nbox = [[0, 0], [1, 1]]\ncells = @2.5\n", "whole number"},
                                         Mistake{"[mesh]\nbox = [[0, 0], [1, 1]]\ncells = @[1, 2, 3]\n", "2 numbers in 2-D, 3 here"},
                                         Mistake{"[mesh]\nbox = [[0, 0], [1, 1]]\ncells = [1, @-2]\n", "between 1 and"},
                                         Mistake{"[mesh]\nbox = [[0, 0], [1, 1]]\ncells = @1000000000000\n", "between 1 and"},
                                         Mistake{"[mesh]\nbox = [[0, 0], [1, 1]]\nrefine = @-1\n", "between 0 and 20"},
                                         Mistake{"[mesh]\nbox = [[0, 0], [1, 1]]\nrefine = @21\n", "between 0 and 20"},
                                         Mistake{"[mesh]\nbox = [[0, 0], [1, 1]]\ncells = 1000\nrefine = @6\n", "lower refine or cells"},
                                         Mistake{"[mesh]\nbox = [[0, 0], [1, 1]]\n@size = 0.1\n", ".geo or .step"},
                                         Mistake{"[mesh]\nball = { center = [0, 0], radius = @0 }\n", "'radius' must be positive"},
                                         Mistake{"[mesh]\nball = @{ radius = 1 }\n", "'center' is missing"},
                                         Mistake{"[mesh]\nball = { center = [0, 0], @radios = 1 }\n", "did you mean 'radius'?"},
                                         Mistake{"[mesh]\nball = { center = [0, 0] }\n@cells = 3\n", "'cells' divides a box"},
                                         Mistake{"[mesh]\nball = { center = @[] }\n", "1 to 3 coordinates"},
                                         Mistake{"[mesh]\nshell = { center = [0, 0], inner = @2, outer = 1 }\n",
                                                 "'inner' = 2 must be less than 'outer' = 1"},
                                         Mistake{"[mesh]\nshell = { center = @[0] }\n", "2 to 3 coordinates"},
                                         Mistake{"[mesh]\nshell = @1\n", "{ center = [0, 0], inner = 1, outer = 2 }"},
                                         Mistake{"[mesh]\nfile = @\"nowhere.msh\"\n", "does not exist"},
                                         Mistake{"[mesh]\nfile = \"square.msh\"\n@size = 0.1\n", "has its cells already"},
                                         Mistake{"[mesh]\nfile = @\"cut.msh\"\n", "incomplete or damaged"},
                                         Mistake{"[mesh]\nfile = @\"table.txt\"\n", "must end in .msh"},
                                         Mistake{"@title = \"no mesh\"\n", "section [mesh] is missing"}));

INSTANTIATE_TEST_SUITE_P(
  Model,
  BadInput,
  testing::Values(Mistake{"@[model]\nelement = \"Q2\"\n", "'kind' is missing"},
                  Mistake{"[model]\nkind = @\"membran\"\n", "did you mean 'membrane'?"},
                  Mistake{"[model]\nkind = @\"shell\"\n", "unknown kind 'shell'; known: membrane, elasticity, projection, beam, plate"},
                  Mistake{"[model]\nkind = @\"plat\"\n", "did you mean 'plate'?"},
                  Mistake{"[model]\nkind = @\"beam\"\n", "a beam needs a 1-D mesh"},
                  Mistake{"[model]\nkind = \"plate\"\n@stiffness = 1\n[boundary]\nall = \"clamped\"\n", "belongs to kind = \"membrane\""},
                  Mistake{"[model]\nkind = \"plate\"\nelement = @\"Q2\"\n[boundary]\nall = \"clamped\"\n", "is not for kind = \"plate\""},
                  Mistake{"[model]\nkind = \"plate\"\n[boundary]\nall = @\"clampd\"\n", "is not a condition of beams and plates"},
                  Mistake{"[model]\nkind = \"projection\"\n[boundary]\n@left = 0\n", "has no boundary conditions"},
                  Mistake{"[model]\nkind = @1\n", "must be a string"},
                  Mistake{"[model]\nkind = \"membrane\"\nelement = @\"Q9\"\n", "unknown element 'Q9'"},
                  Mistake{"[model]\nkind = \"membrane\"\nelement = @\"P4\"\n", "no element 'P4' on triangles"},
                  Mistake{"[model]\nkind = \"membrane\"\nelement = @\"hermite\"\n", "plates and beams"},
                  Mistake{"[model]\nkind = \"membrane\"\nelement = @\"c0ip2\"\n", "is for plates and beams"},
                  Mistake{"[model]\nkind = \"membrane\"\n@young = 3\n", "belongs to kind = \"elasticity\""},
                  Mistake{"[model]\nkind = \"membrane\"\nstiffness = @0\n", "must be positive"},
                  Mistake{"[model]\nkind = \"membrane\"\nstiffness = @[1, 2]\n", "3 entries in 2-D, xx, xy, yy"},
                  Mistake{"[model]\nkind = \"membrane\"\nstiffness = [@1, 2, 1]\n", "positive definite"},
                  Mistake{"[model]\nkind = \"membrane\"\nstiffness = [1, @true, 1]\n", "not true or false"},
                  Mistake{"[model]\nkind = \"membrane\"\nvelocity = @1\n", "list of 2"},
                  Mistake{"[model]\nkind = \"membrane\"\nvelocity = @[1]\n", "2 entries in 2-D, 1 here"},
                  Mistake{"[model]\nkind = \"membrane\"\nload = @[0, 1]\n", "one number or expression"},
                  Mistake{"[model]\nkind = \"membrane\"\nload = @1979-05-27\n", "not a date"},
                  Mistake{"@[[material]]\nstiffness = 2\n", "'region' is missing"},
                  Mistake{"[[material]]\nregion = \"domain\"\n@x = 2\n", "unknown key 'x' in [[material]]"},
                  Mistake{"[[material]]\nregion = @\"domian\"\n", "did you mean 'domain'? Regions: domain"},
                  Mistake{
                    "[mesh]\nfile = \"square.msh\"\n[model]\nkind = \"membrane\"\nelement = \"P1\"\n[[material]]\nregion = @\"steel\"\n",
                    "the mesh has no region 'steel'; regions: plate, domain"},
                  Mistake{"[[material]]\nregion = \"domain\"\n[[material]]\nregion = @\"domain\"\n", "already, in line 2"}));

INSTANTIATE_TEST_SUITE_P(
  Boundary,
  BadInput,
  testing::Values(Mistake{"[boundary]\n@lef = 0\n", "no part 'lef'; did you mean 'left'? Parts: left, right, bottom, top, all"},
                  Mistake{"[mesh]\nbox = [[0], [1]]\n[boundary]\n@top = 0\n", "parts: left, right, all"},
                  Mistake{"[mesh]\nball = { center = [0, 0] }\n[boundary]\n@left = 0\n", "parts: surface, all"},
                  Mistake{"[mesh]\nshell = { center = [0, 0] }\n[boundary]\n@iner = 0\n", "did you mean 'inner'?"},
                  Mistake{"[mesh]\nfile = \"square.msh\"\n[boundary]\n@fot = 0\n", "did you mean 'foot'? Parts: foot, boundary, all"},
                  Mistake{"[boundary]\nall = @\"clamped\"\n", "not a condition of a membrane"},
                  Mistake{"[boundary]\nall = @[0, 1]\n", "not a list"},
                  Mistake{"[boundary]\nall = @true\n", "not true or false"},
                  Mistake{"[boundary]\nall = @{}\n", "no condition"},
                  Mistake{"[boundary]\nall = { @fluks = 1 }\n", "did you mean 'flux'?"},
                  Mistake{"[boundary]\nall = @{ value = 1, flux = 1 }\n", "'value' fixes u"},
                  Mistake{"[boundary]\nall = { spring = @-1 }\n", "must not be negative"},
                  Mistake{"[mesh]\nbox = [[0], [1]]\n[model]\nkind = \"beam\"\n[boundary]\nall = 0\n[[support]]\nat = 0.5\nspring = @-1\n",
                          "'spring' must not be negative"},
                  Mistake{"[mesh]\nbox = [[0], [1]]\n[model]\nkind = \"beam\"\nrigidity = @0\n", "'rigidity' must be positive"},
                  Mistake{"[model]\nkind = \"plate\"\nelement = @\"c0ip5\"\n", "known: hermite, c0ip2, c0ip3"},
                  Mistake{"[boundary]\nall = { @traction = [0, 1] }\n", "elasticity"}));

INSTANTIATE_TEST_SUITE_P(Constraint,
                         BadInput,
                         testing::Values(Mistake{"@[constraint]\nquadrature = \"nodal\"\n", "give lower or upper"},
                                         Mistake{"[constraint]\nlower = @1\nupper = 0\n", "'lower' = 1 is above 'upper' = 0"},
                                         Mistake{"[constraint]\nlower = \"@2*pi\"\nupper = \"pi\"\n", "is above"},
                                         Mistake{"[constraint]\nlower = 0\non = @\"tip\"\n", "did you mean 'top'?"},
                                         Mistake{"[constraint]\nlower = 0\non = @\"all\"\n", "no part 'all'"},
                                         Mistake{"[boundary]\nall = 0\n[constraint]\nlower = 0\non = @\"tip\"\n", "did you mean 'top'?"},
                                         Mistake{"[constraint]\nlower = 0\non = @\"\"\n", "leave it out"},
                                         Mistake{"[constraint]\nlower = 0\nquadrature = @\"gaus(2)\"\n", "unknown quadrature 'gaus(2)'"},
                                         Mistake{"[constraint]\nlower = 0\nquadrature = @\"gauss(0)\"\n", "between 1 and 20"},
                                         Mistake{"[constraint]\nlower = 0\nquadrature = @\"gauss(21)\"\n", "between 1 and 20"},
                                         Mistake{"[constraint]\nlower = 0\nquadrature = @\"lobatto(1)\"\n", "between 2 and 20"},
                                         Mistake{"[constraint]\nlower = 0\nquadrature = @\"edges\"\n", "triangles and tetrahedra only"},
                                         Mistake{"[boundary]\nall = \"free\"\nleft = 0\n[constraint]\nlower = 0\non = @\"left\"\n",
                                                 "could never act"},
                                         Mistake{"[constraint]\n@gap = 0\n", "elasticity"},
                                         Mistake{"[[constraint]]\nlower = 0\n[[constraint]]\nupper = @[1]\n", "not a list"}));

INSTANTIATE_TEST_SUITE_P(Method,
                         BadInput,
                         testing::Values(Mistake{"[method]\nformulation = @\"penalti\"\n", "did you mean 'penalty'?"},
                                         Mistake{"[method]\nepsilon = @0\n", "must be positive"},
                                         Mistake{"[method]\nepsilon = @\"small\"\n", "\"auto\""},
                                         Mistake{"[method]\ntolerance = @1\n", "between 0 and 1"},
                                         Mistake{"[method]\ntolerance = @nan\n", "finite"},
                                         Mistake{"[method]\nsolver = @\"gauss\"\n", "known: auto, direct, amg, multigrid"},
                                         Mistake{"[method]\nmax_iterations = @0\n", "between 1"}));

INSTANTIATE_TEST_SUITE_P(
  Output,
  BadInput,
  testing::Values(Mistake{"[output]\nprobes = @3\n", "list of points"},
                  Mistake{"[output]\nprobes = [[0, 0], @[0, 0, 0]]\n", "2 coordinates on a 2-D mesh, 3 here"},
                  Mistake{"[output]\nprobes = [@0.5, [0, 0]]\n", "list of points"},
                  Mistake{"@[[expect]]\nvalue = 1\n", "'quantity' is missing"},
                  Mistake{"@[[expect]]\nquantity = \"solution.energy\"\n", "give value, min or max"},
                  Mistake{"[[expect]]\nquantity = @\"solutions.energy\"\nmin = 0\n", "did you mean 'solution'?"},
                  Mistake{"[[expect]]\nquantity = @\"solution.enrgy\"\nmin = 0\n", "did you mean 'energy'?"},
                  Mistake{"[[expect]]\nquantity = @\"\"\nmin = 0\n", "must be a path"},
                  Mistake{"[constraint]\nlower = 0\nupper = 1\n[[expect]]\nquantity = @\"constraint.2.n_active\"\nmin = 0\n",
                          "entries 0 to 1"},
                  Mistake{"[[expect]]\nquantity = @\"errors.L2\"\nmax = 1\n", "without an [exact] solution"},
                  Mistake{"[[expect]]\nquantity = @\"solution.probes.0.value\"\nmax = 1\n", "is empty"},
                  Mistake{"[[expect]]\nquantity = @\"solver\"\nmax = 1\n", "not a number; it holds outer_iterations"},
                  Mistake{"[[expect]]\nquantity = @\"method.solver\"\nmax = 1\n", "not a number"},
                  Mistake{"[[expect]]\nquantity = \"solution.min\"\nvalue = 1\nrtol = @-1\n", "negative"},
                  Mistake{"[[expect]]\nquantity = \"solution.min\"\nmin = 1\nrtol = @1\n", "'value', which is missing"},
                  Mistake{"[[expect]]\nquantity = \"solution.min\"\nmin = @1\nmax = 0\n", "is above"}));

// Inside the quotes.
INSTANTIATE_TEST_SUITE_P(
  Expressions,
  BadInput,
  testing::Values(Mistake{"[exact]\nu = \"x + @sinn(x)\"\n", "unknown function 'sinn' in expression; did you mean 'sin'?"},
                  Mistake{"[exact]\nu = '@quux(x)'\n", "unknown function 'quux' in expression; known: abs"},
                  Mistake{"[exact]\nu = \"\"\"\n  x +\n   @radius\"\"\"\n", "unknown name 'radius'"},
                  Mistake{"[exact]\nu = '''x +\n   @radius'''\n", "unknown name 'radius'"},
                  Mistake{"[exact]\nu = \"\"\"x + \\\n      @radius\"\"\"\n", "unknown name 'radius'"},
                  Mistake{"[exact]\nu = \"\\t\\u0020x + @foo\"\n", "unknown name 'foo'"},
                  Mistake{"[boundary]\nall = { flux = \"\"\"1\"\"\", spring = \"x*@foo\" } # \u00e9\n", "unknown name 'foo'"},
                  Mistake{"[mesh]\nbox = [[0], [1]]\n[exact]\nu = \"x + @y\"\n", "a 1-D mesh has only x"},
                  Mistake{"[exact]\nu = \"x + @z\"\n", "a 2-D mesh has only x and y"},
                  Mistake{"[exact]\nu = \"@\"\n", "empty expression"},
                  Mistake{"[exact]\nu = \"1 + @)\"\n", "')' after '+'"},
                  Mistake{"[exact]\nu = \"1 + @(2 * x\"\n", "'(' without ')'"},
                  Mistake{"[exact]\nu = \"1 + x@)\"\n", "')' without '('"},
                  Mistake{"[exact]\nu = \"1 + @\"\n", "the end of the expression after '+'"},
                  Mistake{"[exact]\nu = \"2@x\"\n", "operator missing between '2' and 'x'"},
                  Mistake{"[exact]\nu = \"@x (y)\"\n", "to multiply"},
                  Mistake{"[exact]\nu = \"@sin + 1\"\n", "'sin' is a function; write sin(...)"},
                  Mistake{"[exact]\nu = \"@atan2(x)\"\n", "'atan2' takes 2 arguments, not 1"},
                  Mistake{"[exact]\nu = \"@if(x, y)\"\n", "'if' takes 3 arguments, not 2"},
                  Mistake{"[exact]\nu = \"@max()\"\n", "at least 1 argument, not 0"},
                  Mistake{"[exact]\nu = \"x @= 1\"\n", "to compare, write =="},
                  Mistake{"[exact]\nu = \"x@**2\"\n", "a^b"},
                  Mistake{"[exact]\nu = \"x @% 2\"\n", "mod(a, b)"},
                  Mistake{"[exact]\nu = \"x @& y\"\n", "write &&"},
                  Mistake{"[exact]\nu = \"@!x\"\n", "unexpected '!'"},
                  Mistake{"[exact]\nu = \"x@, y\"\n", "decimal point"},
                  Mistake{"[exact]\nu = \"2 * @[x]\"\n", "group with ( and )"},
                  Mistake{"[exact]\nu = \"x @\u00b7 y\"\n", "unexpected '\u00b7'"},
                  Mistake{"[exact]\nu = \"0 < x @< 1\"\n", "a < b && b < c"},
                  Mistake{"[exact]\nu = \"x > 0 @? 1\"\n", "without its ':'"},
                  Mistake{"[exact]\nu = \"x @: 0\"\n", "':' without '?'"},
                  Mistake{"[exact]\nu = \"-@-x\"\n", "two signs in a row"},
                  Mistake{"[exact]\nu = \"@1/0\"\n", "not finite"},
                  Mistake{"[exact]\nu = \"@1e999\"\n", "out of range"}));

INSTANTIATE_TEST_SUITE_P(Parameters,
                         BadInput,
                         testing::Values(Mistake{"[parameters]\n@x = 1\n", "hide the coordinate"},
                                         Mistake{"[parameters]\n@pi = 3\n", "hide the constant"},
                                         Mistake{"[parameters]\n@sin = 3\n", "hide the function"},
                                         Mistake{"[parameters]\n@a-b = 3\n", "letters, digits and _"},
                                         Mistake{"[parameters]\na = @[1]\n", "a number, an expression in quotes, or a table"},
                                         Mistake{"[parameters]\n@a = \"b\"\nb = \"2*c\"\nc = \"a+1\"\n[exact]\nu = \"a\"\n",
                                                 "a -> b -> c -> a"},
                                         Mistake{"[parameters]\n@a = \"a\"\n", "depends on itself: a -> a"},
                                         Mistake{"[parameters]\na = \"2*@bb\"\n[exact]\nu = \"a+a\"\n", "unknown name 'bb'"},
                                         Mistake{"[parameters]\nradius = 1\n[exact]\nu = \"@radus\"\n", "did you mean 'radius'?"}));

INSTANTIATE_TEST_SUITE_P(
  Files,
  BadInput,
  testing::Values(Mistake{"[exact]\nu = { raster = @\"nowhere.tif\" }\n", "does not exist"},
                  Mistake{"[exact]\nu = { raster = @\".\" }\n", "is not a file"},
                  Mistake{"[exact]\nu = { raster = @\"text.tif\" }\n", "is not a raster"},
                  Mistake{"[exact]\nu = @{ scale = 2 }\n", "one of raster = \"file\", profile = \"file\""},
                  Mistake{"[exact]\nu = { raster = @\"\" }\n", "name of a file"},
                  Mistake{"[mesh]\nbox = [[0], [1]]\n[exact]\nu = { profile = \"good.csv\", @scal = 2 }\n", "did you mean 'scale'?"},
                  Mistake{"[exact]\nu = { @sphere = { center = [0, 0], radius = 1 } }\n", "only the gap of an elastic body"},
                  Mistake{"[exact]\nu = { profile = @\"good.csv\" }\n", "a 1-D mesh"},
                  Mistake{"[mesh]\nbox = [[0], [1]]\n[exact]\nu = { raster = @\"text.tif\" }\n", "profile"},
                  Mistake{"[mesh]\nbox = [[0], [1]]\n[exact]\nu = { profile = @\"short.csv\" }\n", "two rows"},
                  Mistake{"[mesh]\nbox = [[0], [1]]\n[exact]\nu = { profile = @\"words.csv\" }\n", "line 2: 'one' is not a number"},
                  Mistake{"[mesh]\nbox = [[0], [1]]\n[exact]\nu = { profile = @\"back.csv\" }\n", "line 3: x must increase"},
                  Mistake{"[mesh]\nbox = [[0], [1]]\n[exact]\nu = { profile = @\"three.csv\" }\n", "two columns expected"},
                  Mistake{"[mesh]\nbox = [[0], [1]]\n[exact]\nu = { profile = \"good.csv\", @nodata = 0 }\n", "only rasters"}));

TEST(BadInput, WhatIsWrongWithTheMeshAndTheRestIsOneList)
{
  const std::string text =
    "[mesh]\nfile = \"square.msh\"\n[model]\nkind = \"membrane\"\nelement = \"P1\"\n[boundary]\nfot = 0\n"
    "[[material]]\nregion = \"steel\"\n[constraint]\nlower = 0\nuper = 1\n[[expect]]\nquantity = \"solution.enrgy\"\nmin = 0\n";
  Diagnostics diagnostics;
  try
  {
    parse_case(text, (folder() / "case.toml").string(), {}, diagnostics);
    FAIL() << "nothing is reported";
  }
  catch (const InputError &e)
  {
    std::vector<unsigned> lines;
    for (const Diagnostic &diagnostic : e.diagnostics)
      lines.push_back(diagnostic.where.line);
    EXPECT_EQ(lines, (std::vector<unsigned>{7, 9, 12, 14})) << e.what();
  }
}

TEST(BadInput, SyntaxErrorsSayWhatToDo)
{
  for (const char *const text : {"title = \"a\n", "a = 1\na = 2\n", "title \"a\"\n", "box = [1, 2\n", "a = { b = 1\n", "[mesh\n"})
    try
    {
      Diagnostics diagnostics;
      parse_case(text, "case.toml", {}, diagnostics);
      FAIL() << text;
    }
    catch (const InputError &e)
    {
      EXPECT_NE(std::string(e.what()).find("; "), std::string::npos) << e.what();
    }
}

TEST(BadInput, MistakesElsewhereDoNotMakeExpectationsWrong)
{
  const std::string text = "[mesh]\nbox = [[0, 0], [1, 1]]\n[model]\nkind = \"membrane\"\n[constraint]\nlower = [1]\n[exact]\nu = [2]\n"
                           "[[expect]]\nquantity = \"constraint.0.n_active\"\nmin = 0\n[[expect]]\nquantity = \"errors.L2\"\nmin = 0\n";
  Diagnostics       diagnostics;
  try
  {
    parse_case(text, "case.toml", {}, diagnostics);
    FAIL() << "nothing is reported";
  }
  catch (const InputError &e)
  {
    EXPECT_EQ(e.diagnostics.size(), 2u) << e.what();
  }
}

// Loads by their resultants, rigid and periodic parts.
#define BODY "[model]\nkind = \"elasticity\"\nyoung = 1\npoisson = 0.3\n[boundary]\nbottom = \"clamped\"\n"
#define SIDES "[[periodic]]\nparts = [\"left\", \"right\"]\n"
INSTANTIATE_TEST_SUITE_P(
  Couplings,
  BadInput,
  testing::Values(Mistake{BODY "top = { moment = @[1, 2, 3] }\n", "one number in 2-D"},
                  Mistake{BODY "top = { traction = [0, 1], moment = @1 }\n", "'moment'"},
                  Mistake{BODY "top = { moment = 1, about = @[1] }\n", "2 coordinates"},
                  Mistake{BODY "top = { pressure = 1, about = @[1, 1] }\n", "none of them is given"},
                  Mistake{BODY "top = { rigid = @\"rotation\" }\n", "\"translation\""},
                  Mistake{BODY "top = { rigid = \"translation\", rotation = @1 }\n", "does not turn"},
                  Mistake{BODY "top = { force = [0, 1], rotation = @0.1 }\n", "add rigid = true"},
                  Mistake{BODY "top = { rigid = true, x = \"@y\" }\n", "must be constant"},
                  Mistake{BODY "top = { rigid = true }\n[constraint]\non = @\"top\"\ngap = 0\n", "cannot touch"},
                  Mistake{BODY "@all = { rigid = true }\n", "'all' cannot be rigid"},
                  Mistake{"[mesh]\nbox = [[0, 0, 0], [1, 1, 1]]\n" BODY "top = { moment = @[1, 2] }\n", "[Mx, My, Mz]"},
                  Mistake{"[mesh]\nbox = [[0, 0, 0], [1, 1, 1]]\n" BODY "top = { rigid = true, rotation = @[1, 2] }\n", "three angles"},
                  Mistake{"@[[periodic]]\njump = 1\n", "'parts' is missing"},
                  Mistake{"[[periodic]]\nparts = @\"left\"\n", "a list of two names"},
                  Mistake{"[[periodic]]\nparts = [\"left\", @\"rigth\"]\n", "did you mean 'right'?"},
                  Mistake{"[[periodic]]\nparts = [\"left\", @\"left\"]\n", "with itself"},
                  Mistake{SIDES "[[periodic]]\nparts = [\"top\", @\"right\"]\n", "two periodic pairs"},
                  Mistake{SIDES "[boundary]\n@left = 0\n", "leave it out of [boundary]"},
                  Mistake{SIDES "[constraint]\non = @\"right\"\nlower = 0\n", "no constraint acts there"},
                  Mistake{SIDES "jump = \"@x\"\n", "must be constant"},
                  Mistake{"@" SIDES "[model]\nkind = \"plate\"\n", "membranes and elastic bodies"},
                  Mistake{"@" SIDES "[mesh]\nbox = [[0, 0], [1, 1]]\nadapt = { tolerance = 0.1 }\n", "mesh.adapt"}));
#undef BODY
#undef SIDES
