// Cases on one process and on several: the numbers do not know how many there were.
#pragma once

#include "run_program.h"

#include <algorithm>
#include <cmath>
#include <regex>
#include <set>
#include <string>
#include <vector>

#include <unistd.h>

namespace several_processes
{
  using verification::Json;
  namespace fs = std::filesystem;

  /// results.json of a case under mpirun, and what lies in the folder of the results.
  struct ProgramRun
  {
    Json                  results;
    std::set<std::string> files;
    std::string           log, run_log, pvd; ///< what it prints; run.log and solution.pvd
    int                   exit_code = -1;
  };

  /// Before a command: a clean environment, since a test is itself a process of MPI, and mpirun would take its settings over.
  inline const std::string clean_environment =
    "env -i PATH=\"$PATH\" HOME=\"${HOME:-/}\" OMPI_ALLOW_RUN_AS_ROOT=1 OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1 "
    "OMPI_MCA_rmaps_base_oversubscribe=1 OMPI_MCA_btl_vader_single_copy_mechanism=none timeout 120 ";

  /// By mpirun; @p by_program: by the program's own option.
  inline ProgramRun run(const unsigned     n_processes,
                        const std::string &case_file,
                        const std::string &options = "",
                        const bool         by_program = false,
                        const std::string &subcommand = "run")
  {
    std::string folder = (fs::temp_directory_path() / "unilateral-processes-XXXXXX").string();
    EXPECT_NE(mkdtemp(folder.data()), nullptr);
    const std::string command = clean_environment + (by_program ? "" : "mpirun -n " + std::to_string(n_processes)) + " '" PROGRAM "' " +
                                subcommand + " '" + case_file + "' " + (by_program ? "-n " + std::to_string(n_processes) + " " : "") +
                                options + " -o '" + folder + "' > '" + folder + ".log' 2>&1";
    const int   status = std::system(command.c_str());
    ProgramRun  result;
    std::string text;
    std::getline(std::ifstream(folder + ".log"), result.log, '\0');
    result.exit_code = WIFEXITED(status) ? WEXITSTATUS(status) : -1;
    for (const auto &entry : fs::directory_iterator(folder))
      result.files.insert(entry.path().filename().string());
    for (const std::string file : {"results.json", "study_mesh.json", "study_epsilon.json", "study_quadrature.json"})
      if (result.files.count(file))
        result.results = Json::parse(std::ifstream(folder + "/" + file));
    std::getline(std::ifstream(folder + "/run.log"), result.run_log, '\0');
    std::getline(std::ifstream(folder + "/solution.pvd"), result.pvd, '\0');
    fs::remove_all(folder);
    fs::remove(folder + ".log");
    return result;
  }

  /// A case in a file that goes with it.
  struct CaseFile
  {
    explicit CaseFile(const std::string &text) : name((fs::temp_directory_path() / "unilateral-processes-XXXXXX.toml").string())
    {
      const int file = mkstemps(name.data(), 5);
      EXPECT_GE(file, 0);
      close(file);
      std::ofstream(name) << text;
    }
    ~CaseFile() { fs::remove(name); }

    std::string name;
  };

  /// Numbers equal to a part @p tolerance of their size; other things equal; @p skip: names of entries that may differ.
  inline void
  expect_same(const Json &a, const Json &b, const double tolerance, const std::set<std::string> &skip, const std::string &place = "")
  {
    ASSERT_EQ(a.type_name(), std::string(b.type_name())) << place;
    if (a.is_object())
    {
      for (const auto &[key, value] : a.items())
        if (skip.count(key) == 0)
        {
          ASSERT_TRUE(b.contains(key)) << place << "/" << key;
          expect_same(value, b[key], tolerance, skip, place + "/" + key);
        }
    }
    else if (a.is_array())
    {
      ASSERT_EQ(a.size(), b.size()) << place;
      for (std::size_t k = 0; k < a.size(); ++k)
        expect_same(a[k], b[k], tolerance, skip, place + "/" + std::to_string(k));
    }
    else if (a.is_number_float() || b.is_number_float())
      EXPECT_NEAR(a.get<double>(), b.get<double>(), tolerance * std::max(1e-3, std::abs(a.get<double>()))) << place;
    else
      EXPECT_EQ(a, b) << place;
  }

  /// What tells of the way, not of the solution, and what is round-off.
  inline const std::set<std::string> the_way = {"timing",         "memory",          "program",     "case",     "solver",
                                                "certificate",    "max_penetration", "penetration", "residual", "complementarity",
                                                "epsilon_reason", "method",          "estimate"};

  /// The bound of the total error, or the estimate in its place.
  inline void expect_same_bound(const Json &of_one, const Json &of_several, const double tolerance = 0.05)
  {
    if (!of_several.contains("estimate"))
      return;
    const auto &several = of_several["estimate"], &one = of_one["estimate"];
    EXPECT_GT(several["total"].get<double>(), 0);
    if (several["guaranteed"].get<bool>())
    {
      ASSERT_TRUE(one["guaranteed"].get<bool>());
      EXPECT_NEAR(several["total"].get<double>(), one["total"].get<double>(), tolerance * one["total"].get<double>());
    }
    else
      EXPECT_FALSE(one["guaranteed"].get<bool>()) << several;
  }

  /// Interfaces cost no steps, or next to none.
  inline void expect_as_many_steps(const Json &of_one, const Json &of_several)
  {
    const double one = of_one["solver"]["levels"].back()["linear_iterations"].get<double>(),
                 several = of_several["solver"]["levels"].back()["linear_iterations"].get<double>();
    EXPECT_LE(several, std::max(one + 1, 1.2 * one));
  }

  inline void expect_independence(const std::string          &case_file,
                                  const std::string          &options,
                                  const double                tolerance,
                                  const std::vector<unsigned> numbers = {2, 3},
                                  const double                bound_tolerance = 0.05)
  {
    const ProgramRun alone = run(1, case_file, options);
    ASSERT_TRUE(alone.exit_code == 0 || alone.exit_code == 4) << alone.log;
    for (const unsigned n : numbers)
    {
      SCOPED_TRACE(case_file + " on " + std::to_string(n) + " processes");
      const ProgramRun several = run(n, case_file, options);
      ASSERT_EQ(several.exit_code, alone.exit_code) << several.log;
      EXPECT_EQ(several.results["program"]["mpi_ranks"], n);
      // The work was shared, not repeated.
      EXPECT_EQ(several.files.count("solution.pvtu"), 1u);
      EXPECT_EQ(several.files.count("solution.vtu"), 0u);
      expect_same(alone.results, several.results, tolerance, the_way);
      const auto &certificate = several.results["certificate"], &of_one = alone.results["certificate"];
      ASSERT_EQ(certificate["penalty_error_bound"].is_number(), of_one["penalty_error_bound"].is_number());
      if (of_one["penalty_error_bound"].is_number())
      {
        EXPECT_NEAR(certificate["penalty_error_bound"].get<double>(), of_one["penalty_error_bound"].get<double>(),
                    0.05 * of_one["penalty_error_bound"].get<double>() + 1e-8 * of_one["energy_norm"].get<double>()); // the solver's part
      }
      expect_same_bound(alone.results, several.results, bound_tolerance);
      expect_as_many_steps(alone.results, several.results);
    }
  }

  inline double number(const Json &results, const std::string &pointer)
  {
    return results.at(Json::json_pointer(pointer)).get<double>();
  }

  /// The largest part over the mean, on each level that is divided.
  inline std::vector<double> largest_parts(const ProgramRun &run)
  {
    std::vector<double> largest;
    for (const Json &level : run.results["solver"]["levels"])
      if (level.contains("largest_part"))
        largest.push_back(level["largest_part"]);
    return largest;
  }

  /// On a mesh that is refined in places: several processes refine some more cells, so that numbers agree as far as the mesh goes.
  inline void expect_shared_in_places(const CaseFile             &file,
                                      const double                tolerance,
                                      const std::vector<unsigned> numbers = {2, 3},
                                      const double                further_unknowns = 0.03)
  {
    const ProgramRun alone = run(1, file.name);
    ASSERT_EQ(alone.exit_code, 0) << alone.log;
    for (const unsigned n : numbers)
    {
      SCOPED_TRACE(std::to_string(n) + " processes");
      const ProgramRun several = run(n, file.name);
      ASSERT_EQ(several.exit_code, 0) << several.log;
      EXPECT_NE(several.run_log.find("processes share the mesh"), std::string::npos) << several.run_log;
      const std::regex file_of_mesh("file=\"([^\"]*)\"");
      for (std::sregex_iterator entry(several.pvd.begin(), several.pvd.end(), file_of_mesh), end; entry != end; ++entry)
        EXPECT_EQ(several.files.count((*entry)[1]), 1u) << (*entry)[1];
      EXPECT_EQ(several.files.count("solution.pvtu"), 1u);
      for (const std::string pointer : {"/solution/energy", "/constraint/0/total_contact_force", "/constraint/0/pressure_L2"})
        EXPECT_NEAR(number(several.results, pointer), number(alone.results, pointer), tolerance * std::abs(number(alone.results, pointer)))
          << pointer;
      EXPECT_NEAR(number(several.results, "/space/n_dofs"), number(alone.results, "/space/n_dofs"),
                  further_unknowns * number(alone.results, "/space/n_dofs"));
      expect_same_bound(alone.results, several.results);
      expect_as_many_steps(alone.results, several.results);
    }
  }

  inline std::string example(const std::string &name)
  {
    return PROJECT_DIR "/examples/" + name + ".toml";
  }
} // namespace several_processes
