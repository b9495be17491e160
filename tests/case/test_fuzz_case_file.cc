// Whatever the bytes, a case is read or refused with messages: no crash, no other exception, no hang, no large allocation.

#include "unilateral/case/read_case.h"
#include "unilateral/case/write_case.h"

#include <gtest/gtest.h>

#include <sys/resource.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <random>
#include <sstream>

using namespace unilateral;

namespace
{
  const char *const dense_case = R"toml(title = "A \u00e9 b"
[parameters]
A = 0.68
r = "sqrt(x^2+y^2)"
[mesh]
box = [[-2, -2], [2, 2]]
cells = [8, 4]
refine = 5
[model]
kind = "membrane"
element = "Q2"
stiffness = [2, "0.1*x", '''3 +
  A''']
load = """if(x > 1/3 && y < 2/3, \
   -1, A)"""
[[material]]
region = "a"
reaction = 1
[boundary]
all = "A*log(2/r)"
left = { flux = 1, spring = 2 }
[[constraint]]
lower = "x > 0 ? min(x, y, 1) : -1"
on = "top"
quadrature = "gauss(2)"
[[constraint]]
upper = 9.5
[method]
epsilon = 1e-3
solver = "amg"
[output]
probes = [[0.75, 0]]
[[expect]]
quantity = "solution.energy"
value = 4.27
rtol = 1e-3
)toml";

  /// The examples and a text that uses every kind of value.
  std::vector<std::string> seeds()
  {
    // Files that do not exist: refused before and after most mutations.
    const std::string        files = "[exact]\nu = { raster = \"relief.tif\", scale = 1e-3, extent = [[0,0],[1,1]], nodata = 0 }\n"
                                     "pressure = { profile = 'a.csv' }\n";
    std::vector<std::string> texts = {dense_case, dense_case + files};
    std::vector<std::filesystem::path> paths;
    const std::filesystem::path        examples = std::filesystem::path(PROJECT_DIR) / "examples";
    if (std::filesystem::is_directory(examples))
      for (const auto &entry : std::filesystem::directory_iterator(examples))
        if (entry.path().extension() == ".toml")
          paths.push_back(entry.path());
    std::sort(paths.begin(), paths.end());
    for (const auto &path : paths)
    {
      std::ostringstream text;
      text << std::ifstream(path).rdbuf();
      texts.push_back(text.str());
    }
    return texts;
  }

  using Random = std::mt19937_64;

  /// std::uniform_int_distribution differs between libraries.
  std::size_t below(Random &random, const std::size_t n)
  {
    return static_cast<std::size_t>(random() % n);
  }

  std::string mutate(std::string text, Random &random)
  {
    static const std::vector<std::string> pieces = {"\"",
                                                    "'''",
                                                    "\"\"\"",
                                                    "[",
                                                    "]",
                                                    "[[",
                                                    "]]",
                                                    "{",
                                                    "}",
                                                    "=",
                                                    "\n",
                                                    "\r\n",
                                                    ".",
                                                    ",",
                                                    "#",
                                                    "\\",
                                                    "-",
                                                    "1e9",
                                                    "inf",
                                                    "nan",
                                                    "0x7",
                                                    "99999999999999999999",
                                                    "(",
                                                    ")",
                                                    "((((",
                                                    "?",
                                                    ":",
                                                    "&&",
                                                    "if(",
                                                    "max(",
                                                    "x",
                                                    "\t",
                                                    "\xc3\xa9",
                                                    "\xff",
                                                    "1e-400",
                                                    "..",
                                                    "refine = 20\n",
                                                    "cells = 100000\n",
                                                    "\\u0000",
                                                    "<",
                                                    ">=",
                                                    "^",
                                                    "*"};
    const std::size_t                     n_changes = 1 + below(random, 3);
    for (std::size_t change = 0; change < n_changes; ++change)
    {
      const std::size_t at = below(random, text.size() + 1);
      switch (below(random, 8))
      {
      case 0: // another byte
        if (at < text.size())
          text[at] = static_cast<char>(random());
        break;
      case 1: // a bit
        if (at < text.size())
          text[at] ^= static_cast<char>(1u << below(random, 8));
        break;
      case 2: // something that means something
        text.insert(at, pieces[below(random, pieces.size())]);
        break;
      case 3: // a hole
        text.erase(at, 1 + below(random, 20));
        break;
      case 4: // a copy from elsewhere
        text.insert(at, text.substr(below(random, text.size() + 1), 1 + below(random, 60)));
        break;
      case 5: // the same again
        text.insert(at, std::string(1 + below(random, 40), at < text.size() ? text[at] : '('));
        break;
      }
    }
    return text;
  }

  /// True when the text is a case, false when it is refused.
  bool read_or_refuse(const std::string &text)
  {
    Diagnostics diagnostics;
    try
    {
      const Case request = parse_case(text, "/cases/fuzz.toml", {}, diagnostics);
      // What can be read can be written and read again.
      const std::string expanded = expand(request);
      EXPECT_EQ(expand(parse_case(expanded, "/cases/fuzz.toml", {}, diagnostics)), expanded);
      return true;
    }
    catch (const InputError &e)
    {
      EXPECT_FALSE(e.diagnostics.empty());
      return false;
    }
  }
} // namespace

TEST(FuzzCaseFile, TenThousandMutationsAreReadOrRefused)
{
  Random             random(20240229);
  const auto         texts = seeds();
  unsigned           n_read = 0;
  constexpr unsigned n_mutations = 10000;
  for (unsigned i = 0; i < n_mutations; ++i)
  {
    const std::string text = mutate(texts[i % texts.size()], random);
    SCOPED_TRACE(text);
    ASSERT_NO_THROW(n_read += read_or_refuse(text)) << text;
  }
  // Neither all nor nothing, or the mutations would test little.
  EXPECT_LT(n_read, n_mutations);
  EXPECT_GT(n_read, n_mutations / 100);

  rusage usage;
  getrusage(RUSAGE_SELF, &usage);
  EXPECT_LT(usage.ru_maxrss, 2 * 1024 * 1024) << "kB at the peak";
}

TEST(FuzzCaseFile, HostileTextsAreRefused)
{
  const std::string rest = "\n[mesh]\nbox = [[0, 0], [1, 1]]\n[model]\nkind = \"membrane\"\n[exact]\nu = ";
  const auto        repeat = [](const std::string &piece, const unsigned n)
  {
    std::string text;
    for (unsigned i = 0; i < n; ++i)
      text += piece;
    return text;
  };
  for (const std::string &text :
       {std::string(), std::string("\0", 1), repeat("[", 100000), "a = " + repeat("[", 100000), "a = " + repeat("{a=", 100000),
        repeat("a.", 100000) + "a = 1", "[" + repeat("a.", 100000) + "a]", repeat("\"a\" . ", 100000) + "a = 1",
        rest + "\"" + repeat("(", 5000) + "\"", rest + "\"" + repeat("(", 100000) + "\"", rest + "\"" + repeat("-", 5000) + "x\"",
        rest + "\"" + repeat("sin(", 2000) + "\"", rest + "\"" + repeat("x?", 2000) + "\"", rest + "\"" + std::string(200, 'a') + "\"",
        rest + "\"" + std::string(5000, '9') + "\""})
    EXPECT_FALSE(read_or_refuse(text)) << text.substr(0, 60);

  // Deep but sound.
  for (const std::string &expression :
       {repeat("(", 2000) + "x" + repeat(")", 2000), repeat("sin(", 1000) + "x" + repeat(")", 1000), repeat("x>0?1:", 1000) + "0",
        "x" + repeat("+x", 4000), "x" + repeat("^x", 1000), "max(x" + repeat(",x", 1000) + ")"})
    EXPECT_TRUE(read_or_refuse(rest + "\"" + expression + "\"")) << expression.substr(0, 60);
}
