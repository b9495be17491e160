// A file that goes with the object that made it.
#pragma once

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <string>

#include <stdlib.h>
#include <unistd.h>

struct TextFile
{
  TextFile(const std::string &ending, const std::string &text)
    : name((std::filesystem::temp_directory_path() / ("unilateral-test-XXXXXX" + ending)).string())
  {
    const int file = mkstemps(name.data(), int(ending.size()));
    EXPECT_GE(file, 0);
    close(file);
    std::ofstream(name, std::ios::binary) << text;
  }
  ~TextFile() { std::filesystem::remove(name); }
  TextFile(const TextFile &) = delete;
  TextFile &operator=(const TextFile &) = delete;

  std::string name;
};
