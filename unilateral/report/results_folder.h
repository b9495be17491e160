// What a command has left in a folder, read back: all that a report or a picture is made of.
#pragma once

#include "unilateral/output/vtu_file.h"

#include <nlohmann/json.hpp>

#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace unilateral
{
  struct ResultsFolder
  {
    using Json = nlohmann::ordered_json;

    std::string         name;                                                                ///< of the folder
    std::optional<Json> results, sweep, study_epsilon, study_mesh, study_quadrature, infsup; ///< what there is
    std::string         log;                                                                 ///< run.log
    VtuGrid             solution, points;                 ///< solution.vtu, constraint-points.vtu; empty where there is no file
    std::vector<std::pair<std::string, std::string>> csv; ///< tables as CSV: name of the file, content

    /// Its name, and the studies that lie in @p directory, if it exists, become those of this folder.
    void take_studies_of(const std::string &directory);

    std::string title() const; ///< of the case, or the name of the folder
  };

  /// @p with_fields: also the VTU files, which may be large.
  /// Throws InputError when @p directory holds no results, or a file in it is damaged.
  ResultsFolder read_results(const std::string &directory, bool with_fields = true);
} // namespace unilateral
