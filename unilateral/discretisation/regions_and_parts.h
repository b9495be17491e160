// What a problem states of each region and each boundary part of a mesh.
#pragma once

#include "unilateral/discretisation/problem_statement.h"
#include "unilateral/spaces/periodic_nodes.h"

#include <string>
#include <vector>

namespace unilateral
{
  /// Index of @p name, or nothing.
  std::optional<unsigned> find_name(const std::vector<std::string> &names, const std::string &name);

  /// By material_id: what the region's material gives, the rest from the model. Unknown regions are errors.
  std::vector<Coefficients>
  coefficients_by_region(const ProblemStatement &statement, const std::vector<std::string> &region_names, Diagnostics &diagnostics);

  /// By boundary_id. Unknown parts are errors. `all` does not stand for periodic parts.
  std::vector<PartCondition>
  conditions_by_part(const ProblemStatement &statement, const std::vector<std::string> &part_names, Diagnostics &diagnostics);

  /// Unknown parts are errors.
  std::vector<PeriodicPair>
  periodic_pairs(const ProblemStatement &statement, const std::vector<std::string> &part_names, Diagnostics &diagnostics);

  /// Why a functional's @p on and @p region name nothing that the mesh has; empty: they do. `on` is "domain" or a part.
  std::string why_no_such_place(const std::string              &on,
                                const std::string              &region,
                                const std::vector<std::string> &part_names,
                                const std::vector<std::string> &region_names);

  /// What periodic and rigid parts cannot be combined with.
  void check_couplings(const ProblemStatement &statement, Diagnostics &diagnostics);
} // namespace unilateral
