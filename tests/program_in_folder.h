// The program in a folder of its own for each test, as a user starts it.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <functional>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

#include <fcntl.h>
#include <sys/wait.h>
#include <unistd.h>

namespace program_in_folder
{
  namespace fs = std::filesystem;

  inline std::string read(const fs::path &path)
  {
    std::ifstream      file(path);
    std::ostringstream text;
    text << file.rdbuf();
    return text.str();
  }

  struct Outcome
  {
    int         exit_code = -1;
    std::string out, err;
  };

  class ProgramInFolder : public ::testing::Test
  {
  protected:
    void SetUp() override
    {
      std::string name = (fs::temp_directory_path() / "unilateral-test-XXXXXX").string();
      ASSERT_NE(mkdtemp(name.data()), nullptr);
      folder = name;
      fs::create_directory(work());
    }
    void TearDown() override { fs::remove_all(folder); }

    /// Where the program runs.
    fs::path work() const { return folder / "work"; }

    void write(const std::string &name, const std::string &text) const { std::ofstream(work() / name, std::ios::binary) << text; }
    void write_copy(const std::string &from, const std::string &name) const { fs::copy_file(from, work() / name); }

    /// Starts the program in the folder `work`, its streams in the files `out` and `err` beside that. @p before is called in its process.
    pid_t start(std::vector<std::string> arguments, const std::function<void()> &before = {}) const
    {
      const pid_t child = fork();
      if (child < 0)
        throw std::runtime_error("no process can be started"); // a signal to -1 would go to everybody
      if (child != 0)
        return child;
      arguments.insert(arguments.begin(), PROGRAM);
      std::vector<char *> argv;
      for (std::string &argument : arguments)
        argv.push_back(argument.data());
      argv.push_back(nullptr);
      if (chdir(work().c_str()) != 0 || dup2(open("../out", O_WRONLY | O_CREAT | O_TRUNC, 0600), 1) < 0 ||
          dup2(open("../err", O_WRONLY | O_CREAT | O_TRUNC, 0600), 2) < 0)
        _exit(99);
      if (before)
        before();
      execv(argv[0], argv.data());
      _exit(98);
    }

    Outcome finish(const pid_t child) const
    {
      int status = 0;
      waitpid(child, &status, 0);
      return {WIFEXITED(status) ? WEXITSTATUS(status) : -1, read(folder / "out"), read(folder / "err")};
    }

    Outcome run(const std::vector<std::string> &arguments, const std::function<void()> &before = {}) const
    {
      return finish(start(arguments, before));
    }

    std::vector<std::string> files(const std::string &directory = ".") const
    {
      std::vector<std::string> names;
      for (const auto &entry : fs::directory_iterator(work() / directory))
        names.push_back(entry.path().filename());
      std::sort(names.begin(), names.end());
      return names;
    }

    fs::path folder;
  };
} // namespace program_in_folder
