// The two programs: what the small one does by itself, and what it hands to the one that computes.
#include "program_in_folder.h"

#include <gtest/gtest.h>

#include <cstdlib>

namespace
{
  using program_in_folder::Outcome;
  using program_in_folder::read;
  namespace fs = std::filesystem;

  const std::string examples = PROJECT_DIR "/examples/";

  bool contains(const std::string &text, const std::string &part)
  {
    return text.find(part) != std::string::npos;
  }

  class Launcher : public program_in_folder::ProgramInFolder
  {
  protected:
    /// What a copy of the small program says that has no other beside it.
    Outcome run_alone(const std::string &arguments) const
    {
      if (!fs::exists(folder / "alone"))
        fs::copy_file(PROGRAM, folder / "alone");
      const int status = std::system(("cd '" + work().string() + "' && ../alone " + arguments + " >../alone.out 2>../alone.err").c_str());
      return {WIFEXITED(status) ? WEXITSTATUS(status) : -1, read(folder / "alone.out"), read(folder / "alone.err")};
    }

    /// Beside that copy.
    void take_file_readers() const
    {
      for (const std::string name : {"unilateral-gmsh.so", "unilateral-gdal.so"})
        fs::copy_file(fs::path(PROGRAM).parent_path() / name, folder / name);
    }

    /// The same words, numbers and exit code with the other program and without it.
    void expect_same_alone(const std::string &command, const std::string &file, const std::string &options = "") const
    {
      std::vector<std::string> arguments = {command, file};
      if (!options.empty())
        arguments.push_back(options);
      const Outcome alone = run_alone(command + " '" + file + "' " + options), whole = run(arguments);
      EXPECT_EQ(alone.exit_code, whole.exit_code) << file << alone.err;
      EXPECT_EQ(alone.out, whole.out) << file;
      EXPECT_EQ(alone.err, whole.err) << file;
    }
  };

  const std::string no_core = "unilateral-core is not beside it";
} // namespace

TEST_F(Launcher, it_loads_none_of_the_large_libraries)
{
  const int status = std::system(("LD_TRACE_LOADED_OBJECTS=1 " PROGRAM " >'" + (folder / "libraries").string() + "'").c_str());
  ASSERT_EQ(status, 0);
  const std::string libraries = read(folder / "libraries");
  EXPECT_TRUE(contains(libraries, "libstdc++")) << libraries;
  for (const std::string name : {"libdeal", "libgdal", "libgmsh", "libpetsc", "libvtk"})
    EXPECT_FALSE(contains(libraries, name)) << libraries;
}

TEST_F(Launcher, cases_are_expanded_without_the_program_that_computes)
{
  take_file_readers();
  unsigned n = 0;
  for (const auto &entry : fs::directory_iterator(examples))
    if (entry.path().extension() == ".toml")
    {
      const Outcome outcome = run_alone("expand '" + entry.path().string() + "'");
      EXPECT_EQ(outcome.exit_code, 0) << entry.path() << outcome.err;
      EXPECT_TRUE(contains(outcome.out, "[mesh]")) << outcome.out;
      ++n;
    }
  EXPECT_GT(n, 30u);
}

TEST_F(Launcher, without_the_module_for_a_file_the_program_that_computes_reads_it)
{
  for (const std::string name : {"bracket-on-plane", "membrane-over-terrain"})
    EXPECT_TRUE(contains(run_alone("expand '" + examples + name + ".toml'").err, no_core)) << name;
}

TEST_F(Launcher, mistakes_in_files_are_told_alike_with_and_without_the_other_program)
{
  take_file_readers();
  const std::string model = "[model]\nkind = \"membrane\"\n";
  write("cut.msh", "$MeshFormat\n4.1 0 8\n$EndMeshFormat\n$Nodes\n1 4 1 4\n");
  write("damaged.toml", "[mesh]\nfile = \"cut.msh\"\n" + model);
  write("absent.toml", "[mesh]\nfile = \"absent.msh\"\n" + model);
  write("square.geo", "SetFactory(\"OpenCASCADE\");\nRectangle(1) = {0, 0, 0, 1, 1};\nPhysical Curve(\"rim\") = {1, 2, 3, 4};\n");
  write("name.toml", "[mesh]\nfile = \"square.geo\"\n" + model + "[boundary]\nrimm = 0\n");
  write("command.geo", "SystemCall \"touch caught\";\n");
  write("command.toml", "[mesh]\nfile = \"command.geo\"\n" + model);
  write("relief.tif", "no raster");
  write("raster.toml", "[mesh]\nbox = [[0, 0], [1, 1]]\n" + model + "[constraint]\nlower = { raster = \"relief.tif\" }\n");
  for (const std::string name : {"damaged", "absent", "name", "command", "raster"})
  {
    EXPECT_EQ(run_alone("expand " + name + ".toml").exit_code, 2) << name;
    expect_same_alone("expand", name + ".toml");
  }
  EXPECT_FALSE(fs::exists(work() / "caught"));
}

TEST_F(Launcher, cases_are_expanded_alike_with_and_without_the_other_program)
{
  for (const std::string name : {"hertz-line", "membrane-over-ball"})
    for (const std::string options : {"", "--json", "-v"})
      expect_same_alone("expand", examples + name + ".toml", options);
}

TEST_F(Launcher, mistakes_are_told_alike_with_and_without_the_other_program)
{
  const std::string mesh = "[mesh]\nbox = [[0, 0], [1, 1]]\n", model = "[model]\nkind = \"membrane\"\n";
  write("key.toml", mesh + model + "lod = 1\n");
  write("expression.toml", mesh + model + "load = \"sinn(x)\"\n");
  write("part.toml", mesh + model + "[boundary]\nabove = 0\n");
  write("rule.toml", mesh + model + "element = \"P2\"\n[constraint]\nlower = 0\nquadrature = \"nodal\"\n");
  write("quantity.toml", mesh + model + "[[expect]]\nquantity = \"solution.enrgy\"\nvalue = 1\n");
  write("unused.toml", "[parameters]\na = 1\n" + mesh + model);
  write("syntax.toml", mesh + "cells = [1,\n");
  for (const std::string name : {"key", "expression", "part", "rule", "quantity", "unused", "syntax", "missing"})
    expect_same_alone("expand", name + ".toml");
  EXPECT_EQ(run_alone("expand key.toml").exit_code, 2);
  EXPECT_TRUE(contains(run_alone("expand rule.toml").err, "zero weights")) << run_alone("expand rule.toml").err;
  EXPECT_TRUE(contains(run_alone("expand unused.toml").err, "warning")) << run_alone("expand unused.toml").err;
}

TEST_F(Launcher, names_that_the_mesh_does_not_have_are_told_as_by_check)
{
  const std::string head = "[mesh]\nbox = [[0, 0], [1, 1]]\n[model]\nkind = \"membrane\"\n",
                    functional = "[boundary]\nall = 0\n[[functional]]\nname = \"a\"\nintegrand = \"u\"\n";
  for (const std::string &text :
       {functional + "on = \"lid\"\n", functional + "on = \"all\"\n", functional + "region = \"core\"\n",
        functional + "on = \"left\"\nregion = \"domain\"\n", std::string("[boundary]\ntop = 0\n[[periodic]]\nparts = [\"x-\", \"z+\"]\n"),
        std::string("[boundary]\nall = 0\n[[part]]\nname = \"domain\"\nwhere = \"x < 0.1\"\n")})
  {
    write("case.toml", head + text);
    const Outcome expanded = run_alone("expand case.toml"), checked = run({"check", "case.toml"});
    EXPECT_EQ(expanded.exit_code, 2) << text << expanded.err;
    EXPECT_EQ(expanded.err, checked.err) << text;
  }
}

TEST_F(Launcher, what_needs_other_libraries_is_expanded_too)
{
  const std::string case_with_raster = examples + "membrane-over-terrain.toml";
  EXPECT_TRUE(contains(run({"expand", case_with_raster}).out, "raster = "));
  EXPECT_TRUE(contains(run({"expand", examples + "plate-with-hole.toml"}).out, "file = "));
  // Both programs write a log; only one of them writes into this.
  const Outcome logged = run({"expand", case_with_raster, "--log", "/dev/stderr"});
  EXPECT_EQ(logged.exit_code, 0) << logged.err;
  EXPECT_EQ(logged.err.find("unilateral "), logged.err.rfind("unilateral ")) << logged.err;
  EXPECT_TRUE(contains(logged.err, "deal.II")) << logged.err;
}

TEST_F(Launcher, the_log_of_the_small_program_is_that_of_the_other)
{
  const Outcome outcome = run_alone("expand '" + examples + "hertz-line.toml' --log log");
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_TRUE(contains(read(work() / "log"), "deal.II")) << read(work() / "log");
  EXPECT_EQ(run_alone("expand '" + examples + "hertz-line.toml' --log nowhere/log").exit_code, 2);
}

TEST_F(Launcher, what_computes_is_for_the_other_program)
{
  const Outcome outcome = run_alone("check '" + examples + "hertz-line.toml'");
  EXPECT_EQ(outcome.exit_code, 1);
  EXPECT_TRUE(contains(outcome.err, no_core)) << outcome.err;

  // Nor is the program that computes without GDAL's module, where a case has a raster.
  fs::copy_file(fs::path(PROGRAM).parent_path() / "unilateral-core", folder / "unilateral-core");
  const Outcome without_raster = run_alone("check '" + examples + "membrane-over-terrain.toml'");
  EXPECT_EQ(without_raster.exit_code, 1);
  EXPECT_TRUE(contains(without_raster.err, "unilateral-gdal.so cannot be loaded: it is not beside the program")) << without_raster.err;
}
