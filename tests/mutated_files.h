// Files of every kind that a case can name, and cases, changed at random and given to the program. Whatever is in them, it ends in time
// with an exit code of the contract, bad input has a place, and the files of a run are there as a whole or not at all.
#pragma once

#include "mutation.h"
#include "program_in_folder.h"

#include <fmt/format.h>
#include <gdal.h>
#include <nlohmann/json.hpp>

#include <array>
#include <bit>
#include <chrono>
#include <csignal>
#include <cstdint>
#include <limits>
#include <map>
#include <thread>

namespace mutation
{
  namespace fs = std::filesystem;

  /// What may stand in place of a number, and words of the formats.
  inline const std::vector<std::string> &pieces_of_data()
  {
    static const std::vector<std::string> pieces = {"nan",
                                                    "inf",
                                                    "-1",
                                                    "0",
                                                    "1",
                                                    "1e308",
                                                    "-1e308",
                                                    "1e-320",
                                                    "2.5",
                                                    "7",
                                                    "65536",
                                                    "2147483647",
                                                    "4294967296",
                                                    "99999999999999999999",
                                                    "-2147483648",
                                                    " ",
                                                    "\n",
                                                    "\n\n",
                                                    ",",
                                                    ";",
                                                    "(",
                                                    ")",
                                                    "{",
                                                    "\"",
                                                    "#",
                                                    "\t",
                                                    "\r",
                                                    "\xff",
                                                    "$End",
                                                    "$Nodes\n",
                                                    "$Elements\n",
                                                    "$EndNodes\n",
                                                    "$EndElements\n",
                                                    "endfacet\n",
                                                    "facet normal 0 0 1\n",
                                                    "vertex 0 0 0\n",
                                                    "endsolid\n",
                                                    "ncols 3\n",
                                                    "cellsize 0\n",
                                                    "NODATA_value 1\n",
                                                    "#1=",
                                                    "Physical Surface(\"a\") = {1};\n",
                                                    "Mesh 3;\n",
                                                    "'\xc3\xa9'"};
    return pieces;
  }

  /// As mutate(), and what damages data: other numbers in text and in memory's form, lines lost, doubled and exchanged, an early end.
  inline std::string mutate_data(std::string text, Random &random)
  {
    if (below(random, 2) == 0)
      return mutate(std::move(text), random, pieces_of_data(), 2);
    const std::size_t n_changes = 1 + below(random, 2);
    for (std::size_t change = 0; change < n_changes && !text.empty(); ++change)
    {
      const std::size_t at = below(random, text.size());
      const std::size_t line = text.rfind('\n', at) + 1, next = std::min(text.find('\n', at), text.size() - 1) + 1; // npos + 1 = 0
      switch (below(random, 7))
      {
      case 0:
      case 1: // another number
        if (const std::size_t begin = text.find_first_of("0123456789", at); begin != std::string::npos)
          text.replace(begin, std::min(text.find_first_not_of("0123456789.eE+-", begin), text.size()) - begin,
                       pieces_of_data()[below(random, 15)]);
        break;
      case 2: // a line less
        text.erase(line, next - line);
        break;
      case 3: // a line more
        text.insert(line, text.substr(line, next - line));
        break;
      case 4: // a line elsewhere
      {
        const std::string moved = text.substr(line, next - line);
        text.erase(line, moved.size());
        text.insert(text.rfind('\n', below(random, text.size() + 1)) + 1, moved);
        break;
      }
      case 5: // an end before the end
        text.resize(at);
        break;
      default: // four or eight bytes that are a number
      {
        const std::array<std::uint64_t, 8> numbers = {
          0, 1, 0xffffffffu, 0x7fffffffu, 0x80000000u, 0x7ff8000000000000u, 0x7ff0000000000000u, std::bit_cast<std::uint64_t>(-1e300)};
        std::uint64_t     number = numbers[below(random, numbers.size())];
        const std::size_t size = below(random, 2) ? 4 : 8;
        for (std::size_t k = 0; k < size && at / 4 * 4 + k < text.size(); ++k, number >>= 8)
          text[at / 4 * 4 + k] = static_cast<char>(number);
      }
      }
    }
    return text;
  }

  /// A file and a case that uses it.
  struct Original
  {
    std::string name; ///< of the file in the folder of the case
    std::string content;
    std::string case_text = {};
    double      seconds = 30;                  ///< that a run may take
    bool        is_case = false;               ///< it may ask for much, but it must obey an interrupt
    std::string beside_name = {}, beside = {}; ///< another file that the reader wants to see
  };

  inline std::string bytes_of(const std::string &file)
  {
    const std::string content = program_in_folder::read(file);
    EXPECT_FALSE(content.empty()) << file;
    return content;
  }

  inline std::vector<Original> meshes()
  {
    std::vector<Original> originals;
    const auto            add = [&](const std::string &file, const std::string &element, const double seconds)
    {
      Original mesh{.name = "mesh" + fs::path(file).extension().string(), .content = bytes_of(PROJECT_DIR "/tests/data/" + file)};
      mesh.seconds = seconds;
      mesh.case_text = fmt::format("[mesh]\nfile = \"{}\"\n[model]\nkind = \"membrane\"\nelement = \"{}\"\nload = -1\n[boundary]\nall = 0\n"
                                   "[constraint]\nlower = -0.01\n",
                                   mesh.name, element);
      originals.push_back(mesh);
    };
    // The limits that doc/security.md names: 20 s of the processor for a mesh, 30 s and 120 s for drawings and scripts; and the rest.
    for (const char *const version : {"22", "41"})
    {
      add(fmt::format("segments-{}.msh", version), "Q1", 60);
      add(fmt::format("triangles-{}.msh", version), "P1", 60);
      add(fmt::format("triangles-{}-binary.msh", version), "P1", 60);
      add(fmt::format("quadrilaterals-{}.msh", version), "Q1", 60);
      add(fmt::format("tetrahedra-{}.msh", version), "P1", 60);
      add(fmt::format("hexahedra-{}.msh", version), "Q1", 60);
    }
    add("triangles-order-2.msh", "P2", 60);
    add("segment.geo", "Q1", 240);
    add("square.geo", "P1", 240);
    add("cube.geo", "P1", 240);
    add("disk.step", "P1", 240);
    return originals;
  }

  /// A relief of 8 by 6 pixels over [0, 1]^2 in every format of rasters that GDAL writes here.
  inline std::vector<Original> rasters()
  {
    GDALAllRegister();
    std::array<double, 48> heights;
    for (unsigned k = 0; k < heights.size(); ++k)
      heights[k] = 0.125 * (7 * k % 11);
    std::array<double, 6> transform = {0, 0.125, 0, 1, 0, -1. / 6};
    std::string           folder = (fs::temp_directory_path() / "unilateral-rasters-XXXXXX").string();
    EXPECT_NE(mkdtemp(folder.data()), nullptr);

    std::vector<Original> originals;
    const auto            add = [&](const std::string &name, const std::string &content)
    {
      originals.push_back({.name = name, .content = content});
      originals.back().case_text =
        fmt::format("[mesh]\nbox = [[0.2, 0.2], [0.8, 0.8]]\ncells = 3\n[model]\nkind = \"membrane\"\n[boundary]\n"
                    "all = 2\n[constraint]\nlower = {{ raster = \"{}\", extent = [[0, 0], [1, 1]] }}\n",
                    name);
    };
    for (const auto &[driver, name, type] : {std::tuple("GTiff", "relief.tif", GDT_Float32), std::tuple("PNG", "relief.png", GDT_Byte),
                                             std::tuple("EHdr", "relief.bil", GDT_Float32), std::tuple("GSBG", "relief.grd", GDT_Float32),
                                             std::tuple("GSAG", "relief.grd", GDT_Float64), std::tuple("XYZ", "relief.xyz", GDT_Float32)})
    {
      const GDALDatasetH memory = GDALCreate(GDALGetDriverByName("MEM"), "", 8, 6, 1, type, nullptr);
      GDALSetGeoTransform(memory, transform.data());
      EXPECT_EQ(GDALRasterIO(GDALGetRasterBand(memory, 1), GF_Write, 0, 0, 8, 6, heights.data(), 8, 6, GDT_Float64, 0, 0), CE_None);
      const std::string file = folder + "/" + name;
      if (const GDALDriverH found = GDALGetDriverByName(driver))
        if (const GDALDatasetH written = GDALCreateCopy(found, file.c_str(), memory, 0, nullptr, nullptr, nullptr))
        {
          GDALClose(written);
          add(name, bytes_of(file));
          if (const std::string header = folder + "/relief.hdr"; driver == std::string("EHdr"))
          {
            // Of the two files each is changed in turn.
            originals.back().beside_name = "relief.hdr";
            originals.back().beside = bytes_of(header);
            originals.push_back(originals.back());
            std::swap(originals.back().name, originals.back().beside_name);
            std::swap(originals.back().content, originals.back().beside);
          }
        }
      GDALClose(memory);
    }
    fs::remove_all(folder);
    std::string text = "ncols 8\nnrows 6\nxllcorner 0\nyllcorner 0\ncellsize 0.125\nNODATA_value -9999\n";
    for (unsigned k = 0; k < heights.size(); ++k)
      text += fmt::format("{}{}", heights[k], k % 8 == 7 ? '\n' : ' ');
    add("relief.asc", text);
    return originals;
  }

  inline std::vector<Original> profiles()
  {
    const std::string text =
      "[mesh]\nbox = [[0], [10]]\ncells = 12\n[model]\nkind = \"beam\"\nload = -1\n[boundary]\nall = \"simply supported\"\n"
      "[constraint]\nlower = { profile = \"bed.csv\" }\n";
    std::vector<Original> originals = {
      {.name = "bed.csv", .content = "# a sea bed\nx, height\n-1, -0.5\n2, -0.25\n4.5, -1.0e-1\n5, -3\n11, -2\n"},
      {.name = "bed.csv", .content = "-1;-0.5\n2;-0.25\n11;-1\n"},
      {.name = "bed.csv", .content = "-1 -0.5\n3\t-0.2\n12 -1\n"}};
    for (Original &original : originals)
      original.case_text = text;
    return originals;
  }

  /// A roof of four triangles below a block, as text and in memory's form.
  inline std::vector<Original> surfaces()
  {
    using Corner = std::array<float, 3>;
    const Corner a = {-1, -1, -0.2f}, b = {3, -1, -0.2f}, c = {3, 2, -0.2f}, d = {-1, 2, -0.2f}, top = {1, 0.5f, -0.01f};
    const std::vector<std::array<Corner, 3>> triangles = {{a, b, top}, {b, c, top}, {c, d, top}, {d, a, top}};
    std::string                              text = "solid roof\n", binary(80, ' ');
    const auto                               put = [&](const auto value)
    {
      const auto bytes = std::bit_cast<std::array<char, sizeof(value)>>(value);
      binary.append(bytes.data(), bytes.size());
    };
    put(std::uint32_t(triangles.size()));
    for (const auto &triangle : triangles)
    {
      text += "facet normal 0 0 1\nouter loop\n";
      for (unsigned k = 0; k < 3; ++k)
        put(k == 2 ? 1.f : 0.f);
      for (const Corner &corner : triangle)
      {
        text += fmt::format("vertex {} {} {}\n", corner[0], corner[1], corner[2]);
        for (const float coordinate : corner)
          put(coordinate);
      }
      text += "endloop\nendfacet\n";
      put(std::uint16_t(0));
    }
    text += "endsolid roof\n";
    const std::string case_text =
      "[mesh]\nbox = [[0, 0, 0], [2, 1, 1]]\ncells = [4, 2, 2]\n[model]\nkind = \"elasticity\"\nyoung = 100\npoisson = 0.3\n"
      "load = [0, 0, -1]\n[boundary]\nback = { x = 0, y = 0 }\n[constraint]\non = \"front\"\ngap = { stl = \"roof.stl\" }\n";
    return {{.name = "roof.stl", .content = text, .case_text = case_text}, {.name = "roof.stl", .content = binary, .case_text = case_text}};
  }

  inline std::vector<Original> cases()
  {
    std::vector<Original> originals;
    for (const std::string name : {"string-under-ceiling", "two-sided-box", "block-patch", "beam-clamped", "plate-over-paraboloid",
                                   "penalty-beam", "american-put", "hertz-line", "pointwise-projection", "smooth-contact-3d"})
      originals.push_back(
        {.name = "case.toml", .content = bytes_of(PROJECT_DIR "/examples/" + name + ".toml"), .seconds = 10, .is_case = true});
    return originals;
  }

  class MutatedFiles : public program_in_folder::ProgramInFolder
  {
  protected:
    /// @p n of @p originals in turn, changed: each is given to `run`, some to `check` and `expand` instead.
    void expect_orderly_ends(const std::vector<Original> &originals, const unsigned n, const unsigned seed)
    {
      std::map<int, unsigned> endings;
      for (unsigned i = 0; i < n; ++i)
      {
        Random            random(seed * 1000000ul + i);
        const Original   &original = originals[i % originals.size()];
        const std::string content =
          original.is_case ? mutate(original.content, random, pieces_of_cases()) : mutate_data(original.content, random);
        SCOPED_TRACE(fmt::format("{} of seed {}, number {}", original.name, seed, i));
        fs::remove_all(folder / "work");
        fs::create_directory(folder / "work");
        if (!original.is_case)
          write("case.toml", original.case_text);
        if (!original.beside_name.empty())
          write(original.beside_name, original.beside);
        write(original.name, content);
        const std::size_t choice = below(random, 8);
        ++endings[expect_orderly_end(original, choice < 6 ? "run" : choice == 6 ? "check" : "expand")];
        if (HasFailure() && keep_failures())
          fs::copy(folder / "work", fs::path(std::getenv("UNILATERAL_KEEP")) / fmt::format("{}-{}-{}", original.name, seed, i),
                   fs::copy_options::recursive | fs::copy_options::overwrite_existing);
      }
      for (const auto &[code, count] : endings)
        fmt::print("exit code {}: {}\n", code, count);
      EXPECT_GE(endings[0], n / 20) << "mutations that are all refused test little";
      EXPECT_GE(endings[2], n / 20);
    }

  private:
    static bool keep_failures() { return std::getenv("UNILATERAL_KEEP") != nullptr; }

    /// Waits until @p child ends, @p seconds at most: false when it does not.
    static bool ends_within(const pid_t child, const double seconds, int &status)
    {
      const auto begin = std::chrono::steady_clock::now();
      while (waitpid(child, &status, WNOHANG) == 0)
      {
        if (std::chrono::steady_clock::now() - begin > std::chrono::duration<double>(seconds))
          return false;
        std::this_thread::sleep_for(std::chrono::milliseconds(2));
      }
      return true;
    }

    int expect_orderly_end(const Original &original, const std::string &command)
    {
      std::vector<std::string> arguments = {command, "case.toml"};
      if (command == "run")
        arguments.insert(arguments.end(), {"-o", "results"});
      const auto  before = files();
      const pid_t child = start(arguments);
      int         status = 0;
      bool        interrupted = false;
      if (!ends_within(child, original.seconds, status))
      {
        interrupted = true;
        kill(child, SIGINT);
        const bool obeys = ends_within(child, 5, status);
        EXPECT_TRUE(obeys) << "it does not end when interrupted";
        EXPECT_TRUE(original.is_case) << "it takes more than " << original.seconds << " s";
        if (!obeys)
        {
          kill(child, SIGKILL);
          waitpid(child, &status, 0);
          return -1;
        }
      }
      const int         code = WIFEXITED(status) ? WEXITSTATUS(status) : -1;
      const std::string out = program_in_folder::read(folder / "out"), err = program_in_folder::read(folder / "err");
      EXPECT_TRUE(code == 0 || code == 2 || code == 3 || code == 4 || (interrupted && code == 130))
        << command << " ended with " << code << (WIFSIGNALED(status) ? fmt::format(", signal {}", WTERMSIG(status)) : "") << "\n"
        << err;
      EXPECT_EQ(err.find("internal error"), std::string::npos) << err;
      EXPECT_EQ((out + err).find('\033'), std::string::npos);
      if (code == 2)
        expect_places(err);

      // All files of a run or none, and nothing beside them.
      auto after = files();
      std::erase(after, "results");
      EXPECT_EQ(after, before);
      const auto results = fs::exists(folder / "work/results") ? files("results") : std::vector<std::string>();
      if (command != "run" || code == 2 || code == 130)
        EXPECT_EQ(results, std::vector<std::string>());
      else
        EXPECT_EQ(results, (std::vector<std::string>{"case.toml", "constraint-points.vtu", "report.html", "results.json", "run.log",
                                                     "solution.vtu"}));
      if (!results.empty())
      {
        const auto json = nlohmann::json::parse(program_in_folder::read(folder / "work/results/results.json"), nullptr, false);
        EXPECT_TRUE(json.is_object());
        EXPECT_TRUE(code != 0 || (json.contains("solution") && json["solution"]["energy"].is_number()))
          << "solved, and the energy is no number";
      }
      return code;
    }

    /// Every line of an error, but those that go on with indentation, names the file and what is wrong there.
    static void expect_places(const std::string &err)
    {
      unsigned           n_errors = 0;
      std::istringstream lines(err);
      for (std::string line; std::getline(lines, line);)
        if (const auto at = line.find(": error: "); at != std::string::npos)
        {
          ++n_errors;
          EXPECT_TRUE(line.starts_with("case.toml") || line.starts_with("results")) << line;
          EXPECT_GT(line.size(), at + 20) << line;
          if (std::getenv("UNILATERAL_SHOW"))
            fmt::print("{}\n", line);
        }
      EXPECT_GT(n_errors, 0u) << err;
    }
  };
} // namespace mutation
