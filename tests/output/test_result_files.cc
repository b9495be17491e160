// Files of results: whole or not at all, those of one run together, never through links.
#include "unilateral/output/result_files.h"
#include "unilateral/output/solution_files.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <set>
#include <sstream>
#include <stdexcept>

#include <sys/wait.h>
#include <unistd.h>

namespace
{
  using namespace unilateral;
  namespace fs = std::filesystem;

  std::string read(const fs::path &path)
  {
    std::ifstream      file(path);
    std::ostringstream text;
    text << file.rdbuf();
    return text.str();
  }

  class ResultFilesTest : public ::testing::Test
  {
  protected:
    void SetUp() override
    {
      std::string name = (fs::temp_directory_path() / "unilateral-test-XXXXXX").string();
      ASSERT_NE(mkdtemp(name.data()), nullptr);
      folder = name;
      results = (folder / "results").string();
    }
    void TearDown() override { fs::remove_all(folder); }

    std::set<std::string> names() const
    {
      std::set<std::string> found;
      for (const auto &entry : fs::directory_iterator(results))
        found.insert(entry.path().filename().string());
      return found;
    }

    void write_all(ResultFiles &files, const std::string &content) const
    {
      for (const std::string name : {"case.toml", "results.json", "solution.vtu"})
        write_file_atomically(files.path_of(name), content);
    }

    fs::path    folder;
    std::string results;
  };
} // namespace

TEST_F(ResultFilesTest, appear_together)
{
  {
    ResultFiles files(results);
    write_all(files, "old");
    EXPECT_FALSE(fs::exists(results + "/case.toml"));
    files.publish("case.toml");
  }
  EXPECT_EQ(names(), (std::set<std::string>{"case.toml", "results.json", "solution.vtu"}));
  {
    ResultFiles files(results);
    write_all(files, "new");
    EXPECT_EQ(read(results + "/case.toml"), "old");
  } // an exception before the end
  for (const std::string name : {"case.toml", "results.json", "solution.vtu"})
    EXPECT_EQ(read(results + "/" + name), "old");
  EXPECT_EQ(names().size(), 3u);
  {
    std::ofstream(results + "/solution.part0.vtu") << "of two processes";
    std::ofstream(results + "/notes.txt") << "of the user";
    ResultFiles files(results);
    write_all(files, "new");
    files.publish("case.toml", [](const std::string &name) { return name == "solution.part0.vtu"; });
  }
  EXPECT_EQ(names(), (std::set<std::string>{"case.toml", "results.json", "solution.vtu", "notes.txt"}));
  EXPECT_EQ(read(results + "/results.json"), "new");
}

TEST_F(ResultFilesTest, of_a_killed_run_go_when_the_next_one_comes)
{
  const pid_t child = fork();
  if (child == 0)
  {
    ResultFiles files(results);
    write_all(files, "half");
    std::ofstream(results + "/.results.json." + std::to_string(getpid()) + ".part") << "half";
    std::ofstream(results + "/.results.json." + std::to_string(getpid()) + ".0123456789abcdef.part") << "half";
    _exit(0);
  }
  int status = 0;
  waitpid(child, &status, 0);
  ASSERT_EQ(names().size(), 3u);
  std::ofstream(results + "/.results.json." + std::to_string(getpid()) + ".part") << "of a process that lives";
  std::ofstream(results + "/.mine.part") << "of the user";
  ResultFiles first(results), second(results); // at work at the same time: neither takes the other's folder away
  write_all(first, "first");
  write_all(second, "second");
  second.publish("case.toml");
  EXPECT_EQ(read(results + "/case.toml"), "second");
  first.publish("case.toml");
  EXPECT_EQ(read(results + "/case.toml"), "first");
  EXPECT_EQ(names(), (std::set<std::string>{"case.toml", "results.json", "solution.vtu", ".mine.part",
                                            ".results.json." + std::to_string(getpid()) + ".part"}));
}

TEST_F(ResultFilesTest, are_not_written_through_links)
{
  fs::create_directories(results);
  const fs::path victim = folder / "victim";
  std::ofstream(victim) << "precious";
  fs::create_symlink(victim, results + "/results.json");
  // The name that a former release took for its temporary file.
  fs::create_symlink(victim, results + "/.results.json." + std::to_string(getpid()) + ".part");
  write_file_atomically(results + "/results.json", "new");
  EXPECT_EQ(read(victim), "precious");
  EXPECT_FALSE(fs::is_symlink(results + "/results.json"));
  EXPECT_EQ(read(results + "/results.json"), "new");

  fs::create_directories(folder / "elsewhere");
  std::ofstream(folder / "elsewhere" / "file") << "precious";
  fs::create_symlink(folder / "elsewhere", results + "/.unilateral.part-abcdef");
  fs::remove(results + "/results.json");
  fs::create_symlink(victim, results + "/results.json");
  ResultFiles files(results);
  write_all(files, "newer");
  files.publish("case.toml");
  EXPECT_EQ(read(victim), "precious");
  EXPECT_EQ(read(results + "/results.json"), "newer");
  EXPECT_EQ(read(folder / "elsewhere" / "file"), "precious");
}

TEST_F(ResultFilesTest, change_nothing_when_they_cannot_be_placed)
{
  {
    ResultFiles files(results);
    write_all(files, "old");
    files.publish("case.toml");
  }
  fs::remove(results + "/solution.vtu");
  fs::create_directories(results + "/solution.vtu/in-the-way");
  {
    ResultFiles files(results);
    write_all(files, "new");
    EXPECT_THROW(files.publish("case.toml"), std::runtime_error);
  }
  EXPECT_EQ(read(results + "/case.toml"), "old");
  EXPECT_EQ(read(results + "/results.json"), "old");
  EXPECT_EQ(names(), (std::set<std::string>{"case.toml", "results.json", "solution.vtu"}));
}

TEST(SolutionFiles, are_known_by_their_names)
{
  for (const std::string name : {"solution.vtu", "solution.3.vtu", "solution.part1.vtu", "solution.3.part12.vtu", "solution.3.pvtu",
                                 "solution.pvd", "solution.0.vtu", "constraint-points.part0.csv", "constraint-points.csv"})
    EXPECT_TRUE(is_solution_file(name)) << name;
  for (const std::string name :
       {"solution.txt", "solution.part.vtu", "solution.partx.vtu", "solution.3.4.5.vtu", "results.json", "solution."})
    EXPECT_FALSE(is_solution_file(name)) << name;
}
