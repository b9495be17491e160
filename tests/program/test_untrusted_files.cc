// Files that somebody else has written: what they try must not happen, and the message must say what it was.
#include "program_in_folder.h"

#include <nlohmann/json.hpp>

#include <chrono>
#include <csignal>
#include <cstddef>
#include <thread>

#include <linux/filter.h>
#include <linux/seccomp.h>
#include <sys/prctl.h>
#include <sys/stat.h>
#include <sys/syscall.h>

namespace
{
  using program_in_folder::Outcome;
  namespace fs = std::filesystem;

  const std::string square = "Point(1) = {0, 0, 0, 0.5}; Point(2) = {1, 0, 0, 0.5}; Point(3) = {1, 1, 0, 0.5}; Point(4) = {0, 1, 0, 0.5};\n"
                             "Line(1) = {1, 2}; Line(2) = {2, 3}; Line(3) = {3, 4}; Line(4) = {4, 1};\n"
                             "Curve Loop(1) = {1, 2, 3, 4}; Plane Surface(1) = {1};\n";

  const std::string mesh = "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Nodes\n4\n1 0 0 0\n2 1 0 0\n3 1 1 0\n4 0 1 0\n$EndNodes\n"
                           "$Elements\n2\n1 2 2 1 1 1 2 3\n2 2 2 1 1 1 3 4\n$EndElements\n";

  const std::vector<std::string> all_commands = {"expand", "check", "run"};

  bool contains(const std::string &text, const std::string &part)
  {
    return text.find(part) != std::string::npos;
  }

  bool has_landlock()
  {
    return syscall(444, nullptr, 0, 1) >= 1;
  }

  class UntrustedFiles : public program_in_folder::ProgramInFolder
  {
  protected:
    void write_case(const std::string &mesh_file, const std::string &element = "P1") const
    {
      write("case.toml", "[mesh]\nfile = \"" + mesh_file + "\"\nrefine = 2\n[model]\nkind = \"membrane\"\nelement = \"" + element +
                           "\"\nload = -1\n[boundary]\nall = 0\n[constraint]\nlower = -0.01\n");
    }

    void write_raster_case(const std::string &raster) const
    {
      write("case.toml", "[mesh]\nbox = [[0, 0], [1, 1]]\ncells = [4, 4]\n[model]\nkind = \"projection\"\nload = { raster = \"" + raster +
                           "\" }\n[constraint]\nlower = 0\n");
    }

    /// Each of @p commands ends with exit code 2 and a message at @p place that has @p word, and leaves nothing behind.
    void expect_refused(const std::string              &word,
                        const std::vector<std::string> &commands = {"expand"},
                        const std::string              &place = "case.toml:2:8: error: ") const
    {
      const auto before = files();
      for (const std::string &command : commands)
      {
        SCOPED_TRACE(command);
        const Outcome outcome = run({command, "case.toml"});
        EXPECT_EQ(outcome.exit_code, 2) << outcome.err;
        EXPECT_EQ(outcome.out, "");
        EXPECT_TRUE(contains(outcome.err, place)) << outcome.err;
        EXPECT_TRUE(contains(outcome.err, word)) << outcome.err;
        EXPECT_FALSE(contains(outcome.err, "internal error")) << outcome.err;
        EXPECT_EQ(files(), before);
      }
    }
  };
} // namespace

TEST_F(UntrustedFiles, scripts_start_no_commands_and_write_no_files)
{
  if (!has_landlock())
    GTEST_SKIP() << "no Landlock";
  write_case("part.geo");
  for (const auto &[command, word] : {std::pair<std::string, std::string>("SystemCall \"touch stolen\";", "command"),
                                      {"NonBlockingSystemCall \"touch stolen\";", "command"},
                                      {"Printf(\"hello\") > \"stolen\";", "write"},
                                      {"Printf(\"hello\") >> \"stolen\";", "write"},
                                      {"Mesh 2; Save \"stolen.msh\";", "write"},
                                      {"Mesh 2; Save \"/tmp/stolen.msh\";", "write"}})
  {
    SCOPED_TRACE(command);
    write("part.geo", square + command + "\n");
    expect_refused(word, command.starts_with("System") ? all_commands : std::vector<std::string>{"expand"});
  }
}

TEST_F(UntrustedFiles, scripts_read_what_lies_in_their_folder_only)
{
  if (!has_landlock())
    GTEST_SKIP() << "no Landlock";
  write_case("part.geo");
  fs::create_directory(folder / "work" / "below");
  write("below/more.geo", square);
  write("part.geo", "Include \"below/more.geo\";\n");
  EXPECT_EQ(run({"check", "case.toml"}).exit_code, 0);
  for (const std::string outside : {"/etc/passwd", "../secret.geo", "link.geo"})
  {
    SCOPED_TRACE(outside);
    std::ofstream(folder / "secret.geo") << "Physical Curve(\"the secret\") = {1};\n";
    std::error_code error;
    fs::create_symlink(folder / "secret.geo", folder / "work" / "link.geo", error);
    for (const std::string command : {"Include", "Merge"})
    {
      write("part.geo", square + command + " \"" + outside + "\";\n");
      const Outcome outcome = run({"expand", "case.toml"});
      EXPECT_EQ(outcome.exit_code, 2) << outcome.err;
      EXPECT_FALSE(contains(outcome.out + outcome.err, "the secret"));
      EXPECT_FALSE(contains(outcome.out + outcome.err, "root:"));
      EXPECT_FALSE(contains(outcome.out + outcome.err, "syntax error")) << "it was read: " << outcome.err;
    }
  }
}

TEST_F(UntrustedFiles, a_script_that_ends_gmsh_does_not_end_the_program)
{
  write_case("part.geo");
  for (const std::string &script : {"Printf(\"a\"); Exit;\n" + square, "If (1) Exit; EndIf\n" + square, square + "Exit;\n"})
  {
    write("part.geo", script);
    expect_refused("Exit");
  }
}

TEST_F(UntrustedFiles, an_endless_script_stops_within_a_second_of_a_signal)
{
  write_case("part.geo");
  write("part.geo", "For i In {1:2:0.0000000001}\nEndFor\n" + square);
  for (const int signal : {SIGINT, SIGTERM})
  {
    const pid_t program = start({"check", "case.toml"});
    std::this_thread::sleep_for(std::chrono::seconds(4)); // it starts in a fraction of this
    const auto begin = std::chrono::steady_clock::now();
    kill(program, signal);
    const Outcome outcome = finish(program);
    EXPECT_LT(std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count(), 1.5);
    EXPECT_EQ(outcome.exit_code, 130) << outcome.err;
  }
}

TEST_F(UntrustedFiles, what_a_script_says_does_not_mix_with_results)
{
  write_case("part.geo");
  write("part.geo", "General.Terminal = 1; General.Verbosity = 99;\n" + square + "Printf(\"chatter\");\n");
  const Outcome outcome = run({"run", "case.toml", "--json", "-q"});
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_NO_THROW(nlohmann::json::parse(outcome.out)) << outcome.out.substr(0, 200);
}

TEST_F(UntrustedFiles, a_mesh_is_opened_as_a_mesh_only)
{
  write_case("part.msh");
  for (const std::string &script : {"SystemCall \"touch stolen\"; // $MeshFormat 2.2 0 8\n" + square, "\n" + mesh, " " + mesh})
  {
    write("part.msh", script);
    expect_refused("$MeshFormat");
  }
}

TEST_F(UntrustedFiles, options_beside_a_file_are_not_read)
{
  write("part.msh", mesh);
  write("part.msh.opt", "SystemCall \"touch stolen\"; Error(\"read\");\n");
  write("part.geo", square);
  write("part.geo.opt", "SystemCall \"touch stolen\"; Error(\"read\");\n");
  for (const std::string name : {"part.msh", "part.geo"})
  {
    if (!has_landlock())
      continue;
    write_case(name);
    const Outcome outcome = run({"check", "case.toml"});
    EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
    EXPECT_FALSE(fs::exists(folder / "work" / "stolen"));
  }
}

TEST_F(UntrustedFiles, without_a_sandbox_a_script_needs_permission)
{
  // A system that knows neither Landlock nor ...
  const auto without_landlock = []
  {
    sock_filter code[] = {BPF_STMT(BPF_LD | BPF_W | BPF_ABS, offsetof(seccomp_data, nr)), BPF_JUMP(BPF_JMP | BPF_JEQ | BPF_K, 444, 0, 1),
                          BPF_STMT(BPF_RET | BPF_K, SECCOMP_RET_ERRNO | ENOSYS), BPF_STMT(BPF_RET | BPF_K, SECCOMP_RET_ALLOW)};
    const sock_fprog program = {4, code};
    if (prctl(PR_SET_NO_NEW_PRIVS, 1, 0, 0, 0) != 0 || prctl(PR_SET_SECCOMP, SECCOMP_MODE_FILTER, &program, 0, 0) != 0)
      _exit(97);
  };
  write("part.geo", square);
  write_case("part.geo");
  for (const std::string command : {"expand", "check"})
  {
    const Outcome refused = run({command, "case.toml"}, without_landlock);
    EXPECT_EQ(refused.exit_code, 2) << refused.err;
    EXPECT_TRUE(contains(refused.err, "--allow-scripts")) << refused.err;
    EXPECT_EQ(run({command, "case.toml", "--allow-scripts"}, without_landlock).exit_code, 0);
  }
  // What is no script is read there as ever, but for options that Gmsh would obey.
  write("part.msh", mesh);
  write_case("part.msh");
  EXPECT_EQ(run({"check", "case.toml"}, without_landlock).exit_code, 0);
  write("part.msh.opt", "General.Terminal = 1;\n");
  EXPECT_EQ(run({"check", "case.toml"}, without_landlock).exit_code, 2);
}

TEST_F(UntrustedFiles, damaged_meshes_end_with_a_message)
{
  for (const auto &[name, element] : {std::pair<std::string, std::string>("damaged-quadrilaterals.msh", "Q1"),
                                      {"damaged-tetrahedra.msh", "P1"},
                                      {"damaged-face.step", "Q1"}})
  {
    SCOPED_TRACE(name);
    write_copy(PROJECT_DIR "/tests/data/" + name, name);
    write_case(name, element);
    const Outcome outcome = run({"check", "case.toml"});
    EXPECT_EQ(outcome.exit_code, 2) << outcome.err;
    EXPECT_TRUE(contains(outcome.err, name)) << outcome.err;
  }
}

TEST_F(UntrustedFiles, rasters_name_no_other_files_and_no_addresses)
{
  write("secret.txt", std::string(64, 's'));
  write("raw.vrt", "<VRTDataset rasterXSize=\"8\" rasterYSize=\"8\"><GeoTransform>0,0.125,0,1,0,-0.125</GeoTransform><VRTRasterBand "
                   "dataType=\"Byte\" band=\"1\" subClass=\"VRTRawRasterBand\"><SourceFilename relativetoVRT=\"1\">secret.txt"
                   "</SourceFilename><ImageOffset>0</ImageOffset><PixelOffset>1</PixelOffset><LineOffset>8</LineOffset>"
                   "</VRTRasterBand></VRTDataset>");
  fs::copy_file(folder / "work" / "raw.vrt", folder / "work" / "raw.tif");
  write("map.tif", "<GDAL_WMS><Service name=\"WMS\"><ServerUrl>http://127.0.0.1:9/wms?</ServerUrl></Service></GDAL_WMS>");
  for (const std::string name : {"raw.vrt", "raw.tif", "map.tif"})
  {
    write_raster_case(name);
    expect_refused("is not a raster", {"expand"}, "case.toml:6:19: error: ");
  }
  // A grid is read; what GDAL would add to it from files beside it is not.
  write("grid.asc", "ncols 2\nnrows 2\nxllcorner 0\nyllcorner 0\ncellsize 0.5\n1 1\n1 1\n");
  write("grid.asc.aux.xml", "<PAMDataset><PAMRasterBand band=\"1\"><ColorInterp>Palette</ColorInterp><ColorTable><Entry c1=\"1\" c2=\"1\" "
                            "c3=\"1\" c4=\"1\"/></ColorTable></PAMRasterBand></PAMDataset>");
  write_raster_case("grid.asc");
  EXPECT_EQ(run({"check", "case.toml"}).exit_code, 0);
}

TEST_F(UntrustedFiles, pipes_are_not_waited_for)
{
  ASSERT_EQ(mkfifo((folder / "work" / "pipe.msh").c_str(), 0600), 0);
  for (const std::string name : {"pipe.tif", "pipe.toml", "pipe.csv", "pipe.geo"})
    fs::create_symlink("pipe.msh", folder / "work" / name);
  for (const std::string name : {"pipe.msh", "pipe.geo"})
  {
    write_case(name);
    EXPECT_TRUE(contains(run({"check", "case.toml"}).err, "ordinary file"));
  }
  write_raster_case("pipe.tif");
  EXPECT_EQ(run({"check", "case.toml"}).exit_code, 2);
  const Outcome outcome = run({"check", "pipe.toml"});
  EXPECT_EQ(outcome.exit_code, 2);
  EXPECT_TRUE(contains(outcome.err, "pipe.toml: error: ")) << outcome.err;
}

TEST_F(UntrustedFiles, names_do_not_command_the_terminal_nor_forge_lines)
{
  write("case.toml", "title = \"\\u001b]0;t\\u0007\"\n[mesh]\nbox = [[0], [1]]\n\"x\\ncase.toml:9:9: error: forged\\u0085\\u202e\" = 1\n"
                     "[model]\nkind = \"membrane\"\n[boundary]\n\"\\u001b[31mleft\" = 0\n[constraint]\nlower = 0\non = \"\\u009b31m\"\n");
  const Outcome outcome = run({"check", "case.toml"});
  EXPECT_EQ(outcome.exit_code, 2);
  for (const std::string piece : {"\033", "\a", "\ncase.toml:9:9", "\xc2\x85", "\xc2\x9b", "\xe2\x80\xae"})
    EXPECT_FALSE(contains(outcome.err, piece)) << outcome.err;
  EXPECT_TRUE(contains(outcome.err, "\\x1b[31mleft")) << outcome.err;

  // The same from a mesh file, in what is printed and kept of a run that succeeds.
  std::string named = mesh;
  named.insert(named.find("$Nodes"), "$PhysicalNames\n1\n2 1 \"in\033[31mner\"\n$EndPhysicalNames\n");
  write("part.msh", named);
  write_case("part.msh");
  const Outcome solved = run({"run", "case.toml", "-o", "results"}), checked = run({"check", "case.toml"});
  EXPECT_EQ(solved.exit_code, 0) << solved.err;
  EXPECT_EQ(checked.exit_code, 0) << checked.err;
  for (const std::string &text :
       {solved.out, solved.err, checked.out, checked.err, program_in_folder::read(folder / "work/results/run.log")})
    EXPECT_FALSE(contains(text, "\033"));
}
