// Texts of cases changed at random, read in this process: each is a case or refused with messages.
#pragma once

#include "mutation.h"

#include "unilateral/case/read_case.h"
#include "unilateral/case/write_case.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>
#include <vector>

#include <sys/resource.h>

namespace unilateral
{
  inline const char *const dense_case = R"toml(title = "A \u00e9 b"
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
  inline std::vector<std::string> case_texts()
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

  /// True when the text is a case, false when it is refused.
  inline bool read_or_refuse(const std::string &text)
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

  /// @p n_mutations of the texts in turn: no other exception, no crash, no large allocation.
  inline void expect_mutations_to_be_read_or_refused(const unsigned n_mutations, const unsigned seed)
  {
    mutation::Random random(seed);
    const auto       texts = case_texts();
    unsigned         n_read = 0;
    for (unsigned i = 0; i < n_mutations; ++i)
    {
      const std::string text = mutation::mutate(texts[i % texts.size()], random, mutation::pieces_of_cases());
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
} // namespace unilateral
